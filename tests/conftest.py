"""What holds for every test: Ctrl-C works, and processes start fast, whatever started pytest."""

import gc
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path

import pytest
from missing_here import skip_where_files_cannot_be_made

# Of the files that one line skips, such as an import that they share, pytest-xdist tells only one.
FILES_LEFT_OUT = []


def pytest_configure(config):
    # A shell starts its background jobs with SIGINT ignored, and their children inherit that: the
    # tests that interrupt a frame or a command would wait for its end.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    skip_where_files_cannot_be_made()
    # The options of whoever runs the tests are none of the tests'.
    os.environ["XDG_CONFIG_HOME"] = os.devnull
    # Without those of Windows, XDG's count there, too.
    for name in ("APPDATA", "LOCALAPPDATA"):
        os.environ.pop(name, None)
    # Nor is their language: this list comes before the locale.
    os.environ["LANGUAGE"] = "en"
    if os.environ.pop("PYTHONDONTWRITEBYTECODE", ""):
        _keep_bytecode(config)
    # Taken away from runs of pytest that tests start.
    config.list_of_skipped = os.environ.pop("ENGINE3D_SKIPPED", None)
    # pytest-xdist would begin with the files that hold the most tests.
    config.option.loadscopereorder = False


def pytest_collectreport(report):
    if report.skipped:
        FILES_LEFT_OUT.append(report.nodeid)


def pytest_sessionfinish(session):
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["files left out"] = FILES_LEFT_OUT


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    FILES_LEFT_OUT.extend(getattr(node, "workeroutput", {}).get("files left out", ()))


def pytest_terminal_summary(terminalreporter, config):
    """List the tests that were skipped, for .ci/run: with more installed, it runs them again."""
    if config.list_of_skipped:
        reports = terminalreporter.stats.get("skipped", [])
        names = dict.fromkeys([*(report.nodeid for report in reports), *FILES_LEFT_OUT])
        Path(config.list_of_skipped).write_text("".join(f"{name}\n" for name in names), "utf-8")


def _keep_bytecode(config):
    """Let Python write bytecode, which it may not, outside the tree: into the cache of pytest.

    Else each process that pytest-xdist starts would rewrite the asserts of all tests anew, and each
    of the hundreds that tests start compile the package.
    """
    if hasattr(config, "cache"):
        folder = str(config.cache.mkdir("bytecode"))
    else:
        folder = tempfile.mkdtemp(prefix="engine3d-bytecode-")
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix = folder
    sys.dont_write_bytecode = False


def pytest_collection_modifyitems(items):
    # What waits for windows takes the longest, so it begins first: others compute meanwhile. Of
    # three processes, the one that has the few tests of the first file takes the fourth, too: were
    # two of them waiting, a processor would have nothing to do.
    first = ("test_real_editor.py", "test_backends.py", "test_build.py", "test_real_window.py")
    places = {name: place for place, name in enumerate(first)}
    items.sort(key=lambda item: places.get(item.path.name, len(places)))


def pytest_collection_finish():
    # Thousands of tests stay until the end: what looks for garbage need not go through them each
    # time, which takes a third of a second.
    gc.collect()
    gc.freeze()
