#!/usr/bin/python3
"""Whether two builds have the same machine code, function by function: after renaming or moving things, and nothing else, they have.

Usage: same_code.py BUILD BUILD (folders of objects; those of tests do not count). Builds without unity batches, by the same compiler and options.
Names, addresses, their order and padding do not matter. A function is its instructions, with what they refer to: constants, strings and
tables by content, other functions by their instructions in turn, and by name only what lies outside the build. Of types only what the code
does with them counts: their names, in exceptions, do not. Prints the functions that differ, or "identical: N functions"; exit code 1 if any differs.
"""
import bisect
import collections
import concurrent.futures
import hashlib
import pathlib
import re
import struct
import subprocess
import sys

ROUNDS = 4  # how far calls are followed
PC_RELATIVE = {2, 4, 9, 41, 42, 22, 19, 20}  # R_X86_64_: PC32, PLT32, GOTPCREL, GOTPCRELX, REX_GOTPCRELX, GOTTPOFF, TLSGD, TLSLD
Section = collections.namedtuple("Section", "name kind flags data entry relocations")
Symbol = collections.namedtuple("Symbol", "name kind bound section value size")
MERGED, STRINGS, CODE = 0x10, 0x20, 0x4
NOTHING = re.compile(r"(data16 |cs )*(nop|xchg +%ax,%ax)")
ADDRESS = re.compile(r"\b([0-9a-f]+) <[^>]*(?:>[^,]*)?$")


class Node:
    """A function or a piece of data: what it is without names, and what it refers to."""

    def __init__(self, name):
        self.name, self.own, self.refers = name, "", []  # refers: nodes, or names of symbols


def digest(*parts):
    return hashlib.sha1(repr(parts).encode()).hexdigest()


class Object:
    """An ELF object for x86-64: its sections, symbols and relocations."""

    def __init__(self, path):
        self.path, self.file = path, path.read_bytes()
        if self.file[:6] != b"\x7fELF\x02\x01" or struct.unpack_from("<H", self.file, 18)[0] != 62:
            sys.exit(f"{path}: is no object for x86-64")
        start, = struct.unpack_from("<Q", self.file, 40)
        size, count, names = struct.unpack_from("<HHH", self.file, 58)
        if count == 0:  # more than 65279 sections: the first one says how many
            count, = struct.unpack_from("<Q", self.file, start + 32)
        if names == 0xffff:
            names, = struct.unpack_from("<I", self.file, start + 40)
        headers = [struct.unpack_from("<IIQQQQIIQQ", self.file, start + i * size) for i in range(count)]
        content = [b"\0" * h[5] if h[1] == 8 else self.file[h[4]:h[4] + h[5]] for h in headers]
        self.sections = [Section(self.text(content[names], h[0]), h[1], h[2], data, h[9], {}) for h, data in zip(headers, content)]
        self.symbols = []
        extended = next((struct.unpack(f"<{len(content[i]) // 4}I", content[i]) for i, h in enumerate(headers) if h[1] == 18), ())
        for i, h in enumerate(headers):
            if h[1] == 2:
                for number, (name, info, _, where, value, length) in enumerate(struct.iter_unpack("<IBBHQQ", content[i])):
                    where = extended[number] if where == 0xffff else where if where < 0xff00 else 0
                    self.symbols.append(Symbol(self.text(content[h[6]], name), info & 15, info >> 4, where, value, length))
        for i, h in enumerate(headers):
            if h[1] == 4:
                self.sections[h[7]].relocations.update({at: (info & 0xffffffff, self.symbols[info >> 32], addend)
                                                        for at, info, addend in struct.iter_unpack("<QQq", content[i])})

    @staticmethod
    def text(table, at):
        return table[at:table.index(b"\0", at)].decode()

    def code(self):
        """{section: [(address, instruction)]}, as objdump prints them; sections in the order of the file."""
        done = subprocess.run(["objdump", "-d", "-w", "--no-show-raw-insn", self.path], capture_output=True, text=True, check=True)
        sections = iter([i for i, section in enumerate(self.sections) if section.flags & CODE and section.kind == 1 and section.data])
        found, lines = {}, None
        for line in done.stdout.splitlines():
            if line.startswith("Disassembly of section "):
                lines = found.setdefault(next(sections), [])
            elif line.startswith(" ") and (parts := line.split("\t", 1))[1:]:
                lines.append((int(parts[0].rstrip(": "), 16), parts[1]))
        return found


class Reader:
    """Reads an object's functions and data into nodes."""

    def __init__(self, item, code, copies):
        self.sections, self.copies, self.pieces = item.sections, copies, {}
        self.functions, self.indices = collections.defaultdict(dict), {}  # section: {address: node}; node: {address: instruction's number}
        self.named = collections.defaultdict(list)                        # section: [(address, size, symbol)] of data
        sizes = {}
        for symbol in item.symbols:
            if not symbol.section or symbol.kind not in (0, 1, 2, 6, 10):
                continue
            if symbol.kind in (2, 10):
                node = self.functions[symbol.section].setdefault(symbol.value, Node(symbol.name))
                sizes[node] = symbol.size
                if symbol.bound:
                    copies[symbol.name].append(node)
            elif symbol.size:
                self.named[symbol.section].append((symbol.value, symbol.size, symbol))
        self.starts = {section: sorted(nodes) for section, nodes in self.functions.items()}
        self.borders = {section: {address for address, _, _ in symbols} for section, symbols in self.named.items()}
        wanted = []  # (node, [(section, address)] or other references)
        for section, starts in self.starts.items():
            lines = code.get(section, [])
            addresses = [address for address, _ in lines] + [len(self.sections[section].data)]
            relocations = sorted(self.sections[section].relocations)
            for start in starts:
                node = self.functions[section][start]
                end = start + sizes[node]
                first, last = bisect.bisect_left(addresses, start), bisect.bisect_left(addresses, end)
                wanted.append((node, self.read(node, section, lines[first:last], addresses[first:last + 1], relocations)))
        for node, references in wanted:
            for reference in references:
                if isinstance(reference, tuple):
                    self.borders.setdefault(reference[0], set()).add(reference[1])
        self.borders = {section: sorted(borders) for section, borders in self.borders.items()}
        for node, references in wanted:
            node.refers = [self.piece(*r) if isinstance(r, tuple) else r for r in references]
        for section, symbols in self.named.items():
            for address, size, symbol in symbols:
                if symbol.bound:
                    copies[symbol.name].append(self.piece(section, address))

    def read(self, node, section, lines, addresses, relocations):
        """Sets what a function is; returns its references."""
        kept = [not NOTHING.match(text) for _, text in lines]
        index = self.indices[node] = {}
        number = 0
        for (address, _), keep in zip(lines, kept):
            index[address] = number
            number += keep
        words, references = [], []
        for i, ((address, text), keep) in enumerate(zip(lines, kept)):
            if not keep:
                continue
            end, text = addresses[i + 1], text.rstrip()
            at = bisect.bisect_left(relocations, address)
            if at < len(relocations) and relocations[at] < end:
                text = ADDRESS.sub("", text.split(" #")[0]) if "<" in text else text
                while at < len(relocations) and relocations[at] < end:
                    kind, symbol, addend = self.sections[section].relocations[relocations[at]]
                    text += f" {kind} {self.refer(symbol, addend + (end - relocations[at] if kind in PC_RELATIVE else 0), references, node)}"
                    at += 1
            elif found := ADDRESS.search(text):
                target = int(found[1], 16)
                if target in index:
                    text = f"{text[:found.start()]}@{index[target]}"
                else:
                    text = text[:found.start()] + " " + self.refer_code(section, target, references, node)
            words.append(text)
        node.own = digest(words)
        return references

    def refer(self, symbol, offset, references, node=None):
        """Notes what an address is of; returns what it is to be known by."""
        if symbol.name.startswith(("_ZTI", "_ZTS")):
            return "type"
        if not symbol.section or (symbol.bound and symbol.kind != 3):
            references.append(symbol.name)
            return f"symbol+{offset}"
        if symbol.section in self.functions:
            return self.refer_code(symbol.section, symbol.value + offset, references, node)
        references.append((symbol.section, symbol.value + offset))
        return "data"

    def refer_code(self, section, address, references, node):
        starts = self.starts.get(section, [])
        i = bisect.bisect_right(starts, address) - 1
        if i < 0:
            return "code"
        function = self.functions[section][starts[i]]
        if address != starts[i]:
            return f"code {self.indices.get(function, {}).get(address)}"
        references.append(function)
        return "function"

    def piece(self, section, address):
        """The node of data at an address: what has a name there, an entry of a merged section, or all up to where the next piece begins."""
        if (section, address) in self.pieces:
            return self.pieces[section, address]
        part = self.sections[section]
        name, first = part.name, address
        around = [(start, size, symbol.name) for start, size, symbol in self.named.get(section, ()) if start <= address < start + size]
        if around:
            first, size, name = around[0]
            end = first + size
        elif part.flags & MERGED:
            end = part.data.find(b"\0" * max(part.entry, 1), address) if part.flags & STRINGS else address - address % part.entry + part.entry
        else:
            borders = self.borders.get(section, [])
            i = bisect.bisect_right(borders, address)
            end = borders[i] if i < len(borders) else len(part.data)
        node = self.pieces[section, address] = Node(name)
        content, words, references = bytearray(part.data[first:end]), [], []
        for at in sorted(at for at in part.relocations if first <= at < end):
            kind, symbol, addend = part.relocations[at]
            width = 4 if kind in (2, 4, 10, 11, 24) else 8
            content[at - first:at - first + width] = b"\0" * width
            words.append((at - first, kind, self.refer(symbol, addend - (at - address if kind in (2, 4) else 0), references)))
        node.own = digest(bytes(content).rstrip(b"\0"), words, address - first, part.kind)
        node.refers = [self.piece(*r) if isinstance(r, tuple) else r for r in references]
        return node

    def nodes(self):
        return [node for nodes in self.functions.values() for node in nodes.values()], list(self.pieces.values())


def values(build):
    """For each round: {what a function is, calls followed so far: names of those that are it}."""
    paths = sorted(path for path in pathlib.Path(build).rglob("*.o") if not {"tests", "fuzz"} & set(path.relative_to(build).parts))
    if not paths:
        sys.exit(f"{build}: there is no object")
    copies, functions, pieces = collections.defaultdict(list), [], []
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for item, code in pool.map(lambda path: (item := Object(path), item.code()), paths):
            for known, found in zip((functions, pieces), Reader(item, code, copies).nodes()):
                known += found
    shared = {id(node) for nodes in copies.values() for node in nodes}
    value = {id(node): node.own for node in functions + pieces}
    for count in range(ROUNDS + 1):
        if count:
            of_copies = {name: digest(sorted({value[id(node)] for node in nodes})) for name, nodes in copies.items()}
            value = {id(node): digest(node.own, [of_copies.get(r, r) if isinstance(r, str) else value[id(r)] for r in node.refers])
                     for node in functions + pieces}
        found = collections.defaultdict(list)
        for node in functions:
            names = found[value[id(node)]]
            if id(node) not in shared or node.name not in names:  # copies that several objects share count once
                names.append(node.name)
        yield found


def demangled(names):
    return subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout.splitlines()


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: same_code.py BUILD BUILD")
    for count, (before, now) in enumerate(zip(values(sys.argv[1]), values(sys.argv[2]))):
        differs = {sign: [name for key, names in one.items() for name in names[len(other.get(key, ())):]]
                   for sign, one, other in (("-", before, now), ("+", now, before))}
        if any(differs.values()):
            what = ["in their instructions", "in constants, tables or what they call"][count] if count < 2 else f"in what is {count} references away"
            for sign, names in differs.items():
                for name in sorted(demangled(names))[:40]:
                    print(sign, name[:300])
            print(f"{len(differs['-'])} functions of the first build are not in the second, {len(differs['+'])} of the second not in the first:"
                  f" they differ {what}")
            return 1
    print(f"identical: {sum(map(len, now.values()))} functions")
    return 0


sys.exit(main())
