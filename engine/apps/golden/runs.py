"""The state of a test run: a few lists, which cost nothing without golden tests."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pytest

FOLDER = "golden"
RESULTS = "engine3d_golden"  # the key of results in reports, and from pytest-xdist processes


def folder_of(module: Path) -> Path:
    """Return the golden picture folder of a test's module."""
    return module.parent / FOLDER / module.stem


def file_of(node: str) -> str:
    return node.partition("::")[0]


class Run:
    """The state of a test run.

    Attributes
    ----------
    results : list of dict
        `Result.as_dict` of each picture.
    collected, passed : dict of str to int
        How many tests of a file will run, and how many have passed.
    partial : set of str
        Files of which some tests were left out, or failed in a fixture.
    written : dict of str to str
        The hashes of the golden files that this process has written, by folded path.
    lines : list of str
        What is said at the end.
    """

    def __init__(self) -> None:
        self.results: list[dict] = []
        self.collected: dict[str, int] = {}
        self.passed: Counter[str] = Counter()
        self.partial: set[str] = set()
        self.written: dict[str, str] = {}
        self.lines: list[str] = []

    def take(self, report: pytest.TestReport) -> None:
        """Take over the results of a test."""
        self.results += getattr(report, RESULTS, ())
        file = file_of(report.nodeid)
        if report.when == "call":
            self.passed[file] += report.passed
        elif report.failed:
            self.partial.add(file)

    def has_golden_pictures(self, config: pytest.Config) -> bool:
        """Return whether the end of the run has anything to do."""
        option = config.option
        if self.results or option.golden_report or option.golden_json:
            return True
        folders = {(config.rootpath / file).parent / FOLDER for file in self.collected}
        return any(folder.is_dir() for folder in folders)
