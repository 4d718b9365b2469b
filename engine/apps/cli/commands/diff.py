"""``engine3d diff``: compares two pictures or folders of pictures, with reg-cli's options."""

from __future__ import annotations

import argparse
import os
from collections import Counter

from ....base.files.making_folders import make_folder_of
from ....base.system import usable_processors
from ....errors import printable
from ...golden import compared_folders
from ...golden.html_report import Report
from ...golden.result_files import read_json, write_json, write_junit
from ...golden.results import CHANGED, DELETED, FAILED, NEW, PASSED, Result
from ..outputs import STANDARD_OUTPUT, with_progress
from ..usage import UsageError

_SIGNS = {PASSED: "=", CHANGED: "!", NEW: "+", DELETED: "-", FAILED: "?"}
_ORDER = (PASSED, NEW, DELETED, CHANGED, FAILED)


def diff(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if STANDARD_OUTPUT in (args.report, args.json, args.junit):
        raise UsageError("standard output takes the list of pictures: name a file, not -")
    if args.from_json is not None:
        return _report_again(args)
    if len(args.pictures) not in (2, 3):
        raise UsageError("say what to compare: engine3d diff ACTUAL EXPECTED [DIFFERENCES]")
    results = _compare(args)
    failures = (CHANGED, FAILED, *((NEW, DELETED) if args.extendedErrors else ()))
    _print(results)
    _write(args, results, failures)
    if args.update:
        return _update(args, results)
    if not any(result.status in failures for result in results):
        return 0
    if args.customDiffMessage is not None:
        print(printable(args.customDiffMessage))
    failed = any(result.status == FAILED for result in results)
    return 0 if args.ignoreChange and not failed else 1


def _update(args: argparse.Namespace, results: list[Result]) -> int:
    left = compared_folders.update(results, *args.pictures[:2])
    if left:
        print(f"what was expected is now what was drawn, but for {len(left)} that cannot be read")
        return 1
    print("what was expected is now what was drawn")
    return 0


def _compare(args: argparse.Namespace) -> list[Result]:
    rules = compared_folders.Rules(
        matching=args.matchingThreshold,
        count_antialiasing=args.enableAntialias,
        rate=args.thresholdRate,
        pixels=args.thresholdPixel,
        flip=args.flip,
    )
    found = compared_folders.pairs(*args.pictures)
    for path in filter(None, (args.report, args.json, args.junit)):
        make_folder_of(path)  # before the work, since it may fail
    threads = args.concurrency or usable_processors()
    are_folders = os.path.isdir(args.pictures[0])
    compared = compared_folders.compare_all(found, rules, threads, keep_going=are_folders)
    return list(with_progress(compared, len(found), "comparing"))


def _print(results: list[Result]) -> None:
    """Print a line for each picture, and the totals."""
    for status in _ORDER:
        for result in results:
            if result.status == status:
                message = f": {result.message}" if status in (CHANGED, FAILED) else ""
                print(printable(f"{_SIGNS[status]} {status:8}{result.name}{message}"))
    counts = Counter(result.status for result in results)
    print(", ".join(f"{counts[one]} {one}" for one in _ORDER if counts[one]) or "no pictures")


def _write(args: argparse.Namespace, results: list[Result], failures: tuple[str, ...]) -> None:
    if args.json is not None:
        places = dict(zip(("actualDir", "expectedDir", "diffDir"), args.pictures, strict=False))
        write_json(args.json, results, places)
    if args.junit is not None:
        write_junit(args.junit, results, failures)
    if args.report is not None:
        _write_report(args.report, results)


def _write_report(path: str, results: list[Result]) -> None:
    Report("Compared pictures", "expected", "actual").write(path, results)


def _report_again(args: argparse.Namespace) -> int:
    if args.report is None:
        raise UsageError("-F reads results for a report: say which file with -R FILE")
    if args.pictures:
        raise UsageError("-F compares nothing: leave out the pictures")
    results = read_json(args.from_json)
    make_folder_of(args.report)
    _write_report(args.report, results)
    return 0
