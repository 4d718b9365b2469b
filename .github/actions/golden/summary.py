"""Adds a table of the golden pictures that differ to a summary of GitHub; prints how many do.

    python summary.py golden.json summary.md

In:  what `pytest --golden-json` wrote. Out: Markdown, in which names are text. It needs nothing but
     Python itself.
"""

import json
import re
import sys

MOST = 50  # rows
LONGEST = 400  # letters of a cell
FAILURES = ("changed", "new")


def cell(text):
    """Return a text as it is in a cell of a table in Markdown.

    Every sign that Markdown or HTML may have a meaning for becomes a reference to its character,
    which neither reads as one: no image is loaded, and nothing becomes a link.
    """
    text = " ".join(text.split())
    text = text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return re.sub(r"[^\w /,()-]|_", lambda sign: f"&#{ord(sign[0])};", text)


def table(pictures):
    """Yield the lines of the summary."""
    counts = {}
    for picture in pictures:
        counts[picture["status"]] = counts.get(picture["status"], 0) + 1
    said = ", ".join(f"{count} {cell(status)}" for status, count in sorted(counts.items()))
    yield f"### Golden pictures: {said or 'none'}"
    yield ""
    others = [picture for picture in pictures if picture["status"] != "passed"]
    if not others:
        return
    yield "| Picture | | What differs | Test |"
    yield "|---|---|---|---|"
    for picture in others[:MOST]:
        columns = (picture[key] for key in ("name", "status", "message", "test"))
        yield f"| {' | '.join(map(cell, columns))} |"
    if len(others) > MOST:
        yield f"\n… and {len(others) - MOST} more."
    yield "\nThe report with the pictures is among the artifacts of this run."


def read(path):
    """Return the pictures that a file lists; end with a line if it is no such list."""
    try:
        with open(path, encoding="utf-8") as file:
            pictures = json.load(file)["pictures"]
        keys = ("name", "status", "message", "test")
        if all(isinstance(picture[key], str) for picture in pictures for key in keys):
            return pictures
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        pass
    raise SystemExit(f"golden: no results of pytest --golden-json: {path}")


def main(results, summary):
    pictures = read(results)
    with open(summary, "a", encoding="utf-8") as file:
        file.write("\n".join(table(pictures)) + "\n")
    print(sum(picture["status"] in FAILURES for picture in pictures))


if __name__ == "__main__":
    main(*sys.argv[1:])
