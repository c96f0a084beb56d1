#!/usr/bin/python3
"""Counts lines of code, without comments and blank lines, of the tree: a row for each top folder, the largest rooms, and a total.

Usage: code_lines.py [ROOT] [--most N]
Exit code 1 where a room of src, which is a folder without those below it, holds more than 27 files, or src has more than N lines of code.
"""
import argparse
import collections
import os
import pathlib
import re
import sys

MOST_FILES = 27
LEFT_OUT = (".git", "build", "golden", "corpus", "__pycache__")
C_LIKE, HASH, MARKUP = ("//", "/*", "*/"), ("#", None, None), (None, "<!--", "-->")
LANGUAGES = {".h": C_LIKE, ".cpp": C_LIKE, ".cu": C_LIKE, ".js": C_LIKE, ".css": (None, "/*", "*/"), ".html": MARKUP, ".py": HASH, ".sh": HASH,
             ".cmake": HASH, "CMakeLists.txt": HASH, "test": HASH, "demo": HASH}
DOCSTRING = re.compile(r'^[ \t]*[rbf]?"""', re.M)


def counted(text, language):
    """Lines of code and of comments. A line with both is code; a Python docstring is a comment."""
    line_mark, begin, end = language
    code = comments = 0
    closing = None  # what ends the comment that the line is in
    for line in map(str.strip, text.splitlines()):
        if closing:
            comments += 1
            closing = None if closing in line else closing
        elif line:
            opening = begin if begin and line.startswith(begin) else '"""' if language is HASH and DOCSTRING.match(line) else None
            if opening:
                comments += 1
                ending = end if opening == begin else opening
                closing = None if ending in line[line.index(opening) + len(opening):] else ending
            elif line_mark and line.startswith(line_mark) and not line.startswith("#!"):
                comments += 1
            else:
                code += 1
    return code, comments


def sources(root):
    """The files of the tree, relative to its root."""
    for folder, below, files in os.walk(root):
        below[:] = [name for name in below if name not in LEFT_OUT]
        yield from ((pathlib.Path(folder) / name).relative_to(root) for name in files)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--most", type=int, help="lines of code that src may have")
    options = parser.parse_args()
    totals, rooms = collections.defaultdict(lambda: [0, 0, 0]), collections.Counter()  # files, code, comments
    for name in sources(options.root):
        language = LANGUAGES.get(name.suffix) or LANGUAGES.get(name.name)
        path = options.root / name
        if not language or path.is_symlink():
            continue
        code, comments = counted(path.read_text(errors="replace"), language)
        for row in (name.parts[0] if len(name.parts) > 1 else ".", "total"):
            for k, value in enumerate((1, code, comments)):
                totals[row][k] += value
        if name.parts[0] == "src":
            rooms[str(name.parent)] += 1
    if not rooms:
        sys.exit("no source file found: nothing was checked")
    print(f"{'folder':<14}{'files':>7}{'code':>9}{'comments':>10}")
    for row in sorted(totals, key=lambda row: (row == "total", row)):
        files, code, comments = totals[row]
        print(f"{row:<14}{files:>7}{code:>9}{comments:>10}{100 * comments / max(code + comments, 1):>6.1f} %")
    print("largest rooms: " + ", ".join(f"{room} {files}" for room, files in rooms.most_common(5)))
    wrong = [f"{room} has {files} files; {MOST_FILES} at the most" for room, files in rooms.items() if files > MOST_FILES]
    if options.most is not None and totals["src"][1] > options.most:
        wrong.append(f"src has {totals['src'][1]} lines of code; {options.most} at the most")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    return 1 if wrong else 0


sys.exit(main())
