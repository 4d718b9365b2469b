"""The end of a test run: unused pictures, report, JSON, and summary lines.

In:  a `Run`. Out: the files that the command line asks for, lines for the summary, and whether all
     is well as far as the tests themselves could not tell.
"""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

from ...base.files.making_folders import make_folder_of
from ...errors import FileAccessError
from .names import SUFFIX
from .results import CHANGED, NEW, PASSED, TWO_PICTURES, UNUSED, UPDATED, Result
from .runs import Run, folder_of

if TYPE_CHECKING:
    import pytest


def finish(run: Run, config: pytest.Config) -> bool:
    """Finish the run; return False if it must fail though its tests passed."""
    results = sorted((Result(**one) for one in run.results), key=lambda r: (r.name, r.test))
    conflicts = two_pictures(results)
    run.lines += [f"{name}: {TWO_PICTURES}" for name in conflicts]
    _count(results, run, config)
    unused = {} if _is_partial(run, config) else find_unused(run, config.rootpath)
    try:
        results += _treat_unused(unused, run, config)
        _write_files(results, run, config)
    except FileAccessError as error:
        run.lines.append(f"error: {error}")
        return False
    return not conflicts and not (unused and config.option.golden_unused == "fail")


def _count(results: list[Result], run: Run, config: pytest.Config) -> None:
    """Return the counts by status, if not all pictures passed."""
    counts = Counter(result.status for result in results)
    if set(counts) - {PASSED}:
        order = (PASSED, CHANGED, NEW, UPDATED)
        run.lines.append(", ".join(f"{counts[one]} {one}" for one in order if counts[one]))
    if counts[CHANGED] and not config.option.golden_report:
        run.lines.append("side by side: pytest --golden-report=FILE.html")
    written = dict.fromkeys(r.expected for r in results if r.status == UPDATED)
    run.lines += [f"written: {_short(path, config.rootpath)}" for path in written if path]


def _treat_unused(unused: dict[Path, str], run: Run, config: pytest.Config) -> list[Result]:
    """Report or delete unused files; return results of the remaining. Raises `FileAccessError`."""
    deletes = config.option.golden_unused == "delete"
    done = "deleted, no test asks for it" if deletes else "no test asks for it"
    for path in unused:
        try:
            if deletes:
                path.unlink()
        except OSError as error:
            raise FileAccessError(f"cannot delete: {error.strerror}", path) from error
        run.lines.append(f"{done}: {_short(path, config.rootpath)}")
    if deletes:
        return []
    message = "no test asks for it"
    return [Result(name, UNUSED, message, expected=str(path)) for path, name in unused.items()]


def two_pictures(results: list[Result]) -> list[str]:
    """Return the names written with different pictures by two processes."""
    digests: dict[str, set[str]] = {}
    for result in results:
        # A picture that passed within its tolerance was compared, and may differ.
        if result.status == UPDATED or (result.status == PASSED and not result.total):
            digests.setdefault(result.name, set()).add(result.digest)
    updated = {result.name for result in results if result.status == UPDATED}
    return sorted(name for name in updated if len(digests[name]) > 1)


def _is_partial(run: Run, config: pytest.Config) -> bool:
    """Return whether tests of the files may not all have been collected."""
    for argument in config.args:
        if "::" in argument:
            run.partial.add(argument.partition("::")[0])
    return bool(config.getoption("lf", False) or config.getoption("stepwise", False))


def find_unused(run: Run, root: Path) -> dict[Path, str]:
    """Return golden files that no test used, with their names, for modules that passed.

    A failed or skipped test might have used more, so its module is not reported.
    """
    partial = {(root / file).resolve() for file in run.partial}
    modules = [
        root / file
        for file, count in run.collected.items()
        if run.passed[file] == count and (root / file).resolve() not in partial
    ]
    used = {Path(os.path.normpath(one["expected"])) for one in run.results if one["expected"]}
    folders = {folder_of(module) for module in modules}
    # For deleted modules.
    for parent in {folder.parent for folder in folders}:
        if parent.is_dir():
            gone = {path for path in parent.iterdir() if path.is_dir()} - folders
            folders |= {path for path in gone if not (parent.parent / f"{path.name}.py").exists()}
    return {
        path: _name(path, folder, root)
        for folder in sorted(folders)
        for path in _golden_files(folder, used)
        if path not in used
    }


def _golden_files(folder: Path, used: set[Path]) -> list[Path]:
    """Return the golden files below the folder of a module.

    If none is used, the folder may serve other purposes: only our own files count.
    """
    found = sorted(Path(os.path.normpath(path)) for path in folder.rglob(f"*{SUFFIX}"))
    if not found or not used.isdisjoint(found):
        return found
    from .golden_files import is_golden_file

    return [path for path in found if is_golden_file(path)]


def _name(path: Path, folder: Path, root: Path) -> str:
    """Return the fixture's name for a file in the folder of a module."""
    module = os.path.relpath(folder.parent.parent / folder.name, root)
    return (Path(module) / path.relative_to(folder).with_suffix("")).as_posix()


def _short(path: str | Path, root: Path) -> str:
    try:
        return Path(path).relative_to(root).as_posix()
    except ValueError:
        return str(path)


def _write_files(results: list[Result], run: Run, config: pytest.Config) -> None:
    html, json = config.option.golden_report, config.option.golden_json
    for path in filter(None, (html, json)):
        make_folder_of(path)
    if html:
        from .html_report import Report

        Report("Golden pictures", "golden", "drawn now").write(html, results)
        run.lines.append(f"report: {html}")
    if json:
        from .result_files import write_json

        write_json(json, results)
        run.lines.append(f"JSON: {json}")
