"""The pytest plugin: the fixture ``golden``, its options, and the report at the end of a run.

In:  tests that ask for ``golden``. Out: lines in the summary, properties for JUnit, a report and
     JSON where they are asked for. Each process of pytest-xdist sends its results along with the
     reports of its tests; the one that they go to writes the files. Nothing of engine3d but its
     errors is imported before a test asks for the fixture, or there is a report to write.
"""

from __future__ import annotations

import os
from collections import Counter
from typing import TYPE_CHECKING

import pytest

from .runs import RESULTS, Run, file_of, folder_of

if TYPE_CHECKING:
    from .checking import Golden

UPDATES = ("failed", "missing", "all")
UNUSED = ("report", "fail", "delete")
_OFF = ("", "0", "false", "no", "off")

_RUN = pytest.StashKey[Run]()
_CHECKER = pytest.StashKey["Golden"]()


def pytest_addoption(parser: pytest.Parser, pluginmanager: pytest.PytestPluginManager) -> None:
    _import_as_it_is(pluginmanager)
    group = parser.getgroup("golden", "golden images (engine3d)")
    group.addoption(
        "--golden-update",
        nargs="?",
        const="all",
        metavar="|".join(UPDATES),
        help="write golden pictures: of tests that fail, those that are missing, or (without a "
        "value) both; refused where the variable CI is set",
    )
    group.addoption(
        "--golden-report", metavar="FILE", help="write what came of all pictures as one HTML file"
    )
    group.addoption("--golden-json", metavar="FILE", help="write the same as JSON")
    group.addoption(
        "--golden-unused",
        choices=UNUSED,
        default="report",
        help="what to do about golden pictures that no test has asked for: report them (default), "
        "fail, or delete them",
    )


def _import_as_it_is(pluginmanager: pytest.PytestPluginManager) -> None:
    """Make pytest import engine3d without rewriting assertions.

    pytest rewrites the assertions of every module of a distribution that brings a plugin, which
    makes importing engine3d half as slow again where no bytecode is kept. It has no switch for
    that; where it keeps its list elsewhere, modules are rewritten, and work.
    """
    hook = getattr(pluginmanager, "rewrite_hook", None)
    for name in ("_must_rewrite", "_marked_for_rewrite_cache"):
        marked = getattr(hook, name, None)
        if isinstance(marked, set):
            marked.discard("engine3d")
        elif isinstance(marked, dict):
            marked.clear()


def pytest_load_initial_conftests(args: list[str]) -> None:
    """Give ``--golden-update`` its default value; it would take the next argument otherwise."""
    args[:] = ["--golden-update=all" if one == "--golden-update" else one for one in args]


def pytest_configure(config: pytest.Config) -> None:
    update = config.option.golden_update
    if update not in (None, *UPDATES):
        raise pytest.UsageError(f"--golden-update is {', '.join(UPDATES)}, not {update!r}")
    writes = update is not None or config.option.golden_unused == "delete"
    if writes and os.environ.get("CI", "").strip().lower() not in _OFF:
        raise pytest.UsageError(
            "golden pictures are not written where the variable CI is set: update them on your "
            "machine, look at them, and commit them"
        )

    config.stash[_RUN] = run = Run()
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Reports(run), "engine3d-golden-reports")


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Golden:
    """Compare a picture with the golden one: ``golden(frame)``; see docs/golden.md of engine3d."""
    from .checking import Golden, Place

    item, config = request.node, request.config
    place = Place(
        folder=str(folder_of(item.path)),
        module=item.nodeid.partition("::")[0].removesuffix(".py"),
        classes=[node.name for node in item.listchain() if isinstance(node, pytest.Class)],
        test=item.name,
        node=item.nodeid,
    )
    temporary = request.getfixturevalue("tmp_path_factory")
    item.stash[_CHECKER] = Golden(
        place,
        update=config.option.golden_update or "",
        failures=lambda: str(temporary.getbasetemp() / "golden"),
        written=config.stash[_RUN].written,
    )
    return item.stash[_CHECKER]


# The old style of wrapper: old versions of pytest must start too.
@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo):
    checker = item.stash.get(_CHECKER, None)
    results = [] if checker is None else checker.take_results()
    item.user_properties += [(f"golden {r.name}", r.message or r.status) for r in results]
    outcome = yield
    if results:
        setattr(outcome.get_result(), RESULTS, [result.as_dict() for result in results])


def pytest_deselected(items: list[pytest.Item]) -> None:
    for item in items:
        item.config.stash[_RUN].partial.add(file_of(item.nodeid))


def pytest_collection_finish(session: pytest.Session) -> None:
    run = session.config.stash[_RUN]
    run.collected = dict(Counter(file_of(item.nodeid) for item in session.items))


class _Reports:
    """Collects the tests' reports in the main process."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self._run.take(report)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node, error) -> None:
        """Take over the collected tests of a pytest-xdist process; all collect the same."""
        said = getattr(node, "workeroutput", {}).get(RESULTS)
        if said is not None:
            self._run.collected = said["collected"]
            self._run.partial.update(said["partial"])


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    run = session.config.stash[_RUN]
    if hasattr(session.config, "workeroutput"):
        said = {"collected": run.collected, "partial": sorted(run.partial)}
        session.config.workeroutput[RESULTS] = said
        return
    if not run.has_golden_pictures(session.config):
        return
    from .run_end import finish

    well = finish(run, session.config)
    if not well and session.exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter) -> None:
    run = terminalreporter.config.stash[_RUN]
    if run.lines:
        terminalreporter.section("golden pictures")
        for line in run.lines:
            terminalreporter.line(line)
