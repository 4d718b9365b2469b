"""Finds the functions of the reference that cite a rule of exactness.

    python docs/reference_code.py R22        print them

In: csrc/reference/; for rules that it leaves to others, the rest of csrc/ and engine/, kernels and
stages last. Out: for each rule the functions of C whose comment, or the heading above them, cites
it; where none does, the names of the files that cite it. The site shows them beside the rules.
"""

from __future__ import annotations

import re
import sys
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Folders whose code does what the reference does, in other ways.
SEVERAL_WAYS = {"check", "frame", "kernels"}
SUFFIXES = {".c", ".h", ".inl"}
# A heading of a part of a file, or a function with the comment right above it.
PART = re.compile(
    r"^(?P<heading>/\* ---- .* ---- \*/\n)"
    r"|^(?:/\*(?:(?!\*/).)*\*/\n)?^\w[^;{}#\n]*\([^;{}]*\)\s\{\n.*?^\}\n",
    re.M | re.S,
)
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*|""".*?"""|#[^\n]*', re.S)
CITED = re.compile(r"\bR(\d+)\b(?:(?:-| to | … )R(\d+)\b)?")


def rules_of(text: str) -> set[int]:
    """The rules that the comments of a text cite: R7, and each of R98-R101."""
    found = (match.groups() for match in CITED.finditer(" ".join(COMMENT.findall(text))))
    return {rule for a, b in found for rule in range(int(a), int(b or a) + 1)}


def functions_of(text: str) -> Iterator[tuple[str, set[int]]]:
    """The functions of a C file, each with the rules that it, or the heading above it, cites."""
    of_heading: set[int] = set()
    for match in PART.finditer(text):
        if match["heading"]:
            of_heading = rules_of(match[0])
        else:
            yield match[0], rules_of(match[0]) or of_heading


def ranks() -> list[list[Path]]:
    """The files that may hold a rule's code: the reference, what has no other way, all others."""
    reference, alone, others = [], [], []
    core = [path for path in (ROOT / "csrc").rglob("*") if path.suffix in SUFFIXES]
    for path in sorted([*core, *(ROOT / "engine").rglob("*.py")]):
        folders = path.relative_to(ROOT).parts[1:-1]
        if "reference" in folders:
            reference.append(path)
        else:
            (others if SEVERAL_WAYS & {*folders} else alone).append(path)
    return [reference, alone, others]


def code_in(paths: list[Path]) -> dict[int, str]:
    """What files have for each rule, as Markdown: functions, or else their names."""
    functions, files = defaultdict(list), defaultdict(list)
    for path in paths:
        text, name = path.read_text(encoding="utf-8"), path.relative_to(ROOT).as_posix()
        for rule in rules_of(text):
            files[rule].append(f"`{name}`")
        for function, rules in functions_of(text):
            for rule in rules:
                functions[rule].append(f"/* {name} */\n{function}")
    named = {rule: f"Code: {', '.join(names)}.\n" for rule, names in files.items()}
    return named | {rule: "```c\n" + "\n".join(all_) + "```\n" for rule, all_ in functions.items()}


@cache
def code_of_rules() -> dict[int, str]:
    """What the site shows beside each rule."""
    first, second, third = (code_in(paths) for paths in ranks())
    return third | second | first


def with_code(page: str) -> str:
    """A page of rules in Markdown, with their code after each."""
    return re.sub(r"^## R(\d+)\n.*?(?=^## R|\Z)", _rule_with_code, page, flags=re.M | re.S)


def _rule_with_code(match: re.Match[str]) -> str:
    return f"{match[0].rstrip()}\n\n{code_of_rules().get(int(match[1]), '')}\n"


if __name__ == "__main__":
    for word in sys.argv[1:]:
        print(code_of_rules().get(int(word.removeprefix("R")), f"no code cites {word}"))
