"""Adds a table of the golden pictures that differ to a summary of GitHub; prints how many do.

    python summary.py golden.json summary.md

In:  what `pytest --golden-json` wrote. Out: Markdown, in which names are text. It needs nothing but
     Python itself.
"""

import html
import json
import sys

MOST = 50  # rows
FAILURES = ("changed", "new")


def cell(text):
    """Return a text as it is in a cell of a table in Markdown."""
    return html.escape(" ".join(text.split())).replace("|", "&#124;").replace("`", "&#96;")


def table(pictures):
    """Yield the lines of the summary."""
    counts = {}
    for picture in pictures:
        counts[picture["status"]] = counts.get(picture["status"], 0) + 1
    said = ", ".join(f"{count} {status}" for status, count in sorted(counts.items()))
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


def main(results, summary):
    with open(results, encoding="utf-8") as file:
        pictures = json.load(file)["pictures"]
    with open(summary, "a", encoding="utf-8") as file:
        file.write("\n".join(table(pictures)) + "\n")
    print(sum(picture["status"] in FAILURES for picture in pictures))


if __name__ == "__main__":
    main(*sys.argv[1:])
