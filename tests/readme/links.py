#!/usr/bin/env python3
"""Checks the references of all documents: relative links and their anchors, paths of the source in backticks, and the headings that comments of the code
name, as in: docs/model.md, "Pupil". Usage: links.py SOURCE_DIRECTORY"""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
FOLDERS = ("src", "tests", "python", "bench", "cmake", "fuzz")
CODE = (".h", ".cpp", ".cu", ".cuh", ".py", ".sh", ".cmake", ".toml", ".js")
faults: list[str] = []


def without_code(text):
    """The text with its blocks of code blanked, line for line: a # in them is no heading."""
    return re.sub(r"^```.*?^```", lambda block: "\n" * block[0].count("\n"), text, flags=re.DOTALL | re.MULTILINE)


def slug(heading):
    """A heading's anchor as GitHub makes it: lower case, punctuation dropped, a hyphen for each space."""
    heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def headings(path):
    return re.findall(r"^#+ +(.*?) *$", without_code(path.read_text()), re.MULTILINE)


def anchors(path):
    found: set[str] = set()
    for heading in headings(path):
        base = name = slug(heading)
        repeated = 0
        while name in found:  # a second heading of one name gets a number
            repeated += 1
            name = f"{base}-{repeated}"
        found.add(name)
    return found


def check_links(page):
    text = without_code(page.read_text())
    spans = re.sub(r"`[^`\n]*`", lambda span: " " * len(span[0]), text)
    for link in re.finditer(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)", spans):
        target = link[1]
        if re.match(r"[a-z]+:", target):
            continue
        line = f"{page.relative_to(ROOT)}:{spans.count(chr(10), 0, link.start()) + 1}"
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists():
            faults.append(f"{line}: {target}: there is no such file")
        elif anchor and file.suffix == ".md" and anchor not in anchors_of(file):
            faults.append(f"{line}: {target}: there is no such heading")


def check_paths(page):
    for number, line in enumerate(page.read_text().split("\n"), 1):
        for span in re.findall(r"`([^`]+)`", line):
            if re.fullmatch(r"(?:src|tests|bench|examples|displays|docs|cmake)/[\w./-]*", span) and not (ROOT / span).exists():
                faults.append(f"{page.relative_to(ROOT)}:{number}: `{span}`: there is no such file")


known: dict[pathlib.Path, set[str]] = {}


def anchors_of(path):
    if path not in known:
        known[path] = anchors(path)
    return known[path]


def check_code():
    """Headings named in comments. A name may go on in the next line of the comment."""
    names = {page.name: set(headings(page)) for page in (ROOT / "docs").glob("*.md")}
    count = 0
    for folder in FOLDERS:
        for file in (ROOT / folder).rglob("*"):
            if file.suffix not in CODE or file.resolve() == pathlib.Path(__file__).resolve():
                continue
            text = file.read_text(errors="replace")
            if "docs/" not in text:
                continue
            text = re.sub(r"\n\s*(?:///?|#)?\s*", " ", text)
            for name, heading in re.findall(r'docs/([\w-]+\.md),? "([^"]+)"', text):
                count += 1
                if name not in names:
                    faults.append(f"{file.relative_to(ROOT)}: docs/{name}: there is no such file")
                elif heading.rstrip(".,") not in names[name]:
                    faults.append(f'{file.relative_to(ROOT)}: docs/{name} has no heading "{heading}"')
    return count


pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
pages += [page for folder in ("tests", "examples", "bench", "python") for page in (ROOT / folder).rglob("*.md")]
for each in sorted(pages):
    check_links(each)
    check_paths(each)
references = check_code()
print(f"{len(pages)} documents, {references} headings named in the code")
if faults or not references:
    sys.exit("\n".join(faults) or "no reference found: nothing was checked")
