"""Puts the results into the documents, between markers, so that nothing there is typed by hand."""
import textwrap

from programs import ROOT

BEGIN, END = "<!-- peers:begin -->", "<!-- peers:end -->"


def wrapped(line):
    """Wraps paragraphs to the documents' width; tables, headings and pictures stay as they are."""
    return line if line.startswith(("|", "#", "!")) else textwrap.fill(line, 132, break_long_words=False, break_on_hyphens=False)


def put(name, lines):
    page = ROOT / "docs" / name
    before, begin, rest = page.read_text().partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise RuntimeError(f"docs/{name} has no {BEGIN} ... {END}")
    page.write_text("\n".join([before + BEGIN, *map(wrapped, lines), END + after]))
