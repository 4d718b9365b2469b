"""Records which tests run which files, for tests/for.py.

    CFLAGS="--coverage -O1" LDFLAGS=--coverage python setup.py build_ext --inplace
    python tests/record.py [FOLDER_OR_FILE...]

In: the tests, a file in one process each; of a test with parameters, the first and the last set.
Out: tests/covered.txt, for each file of engine/ and csrc/ the tests that are busiest in it, those
of its own folder before others. What was recorded stays in build/recorded/, and only what is named,
or missing, runs again. C needs a build that counts (above); without it, only Python is recorded. It
takes half an hour.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections import Counter, defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "tests" / "covered.txt"
RECORDED = ROOT / "build" / "recorded"
OUTPUT = "ENGINE3D_RECORDED"
# These go through everything, or start programs: they say little of a single file.
LEFT_OUT = ("benchmarks", "docs", "lessons", "packaging", "public")
SECONDS = 40  # that all tests of a file may take together
TESTS = 3  # of a file, at most
NEAR = 10  # how much better a test is that lies in the folder of the source's tests
# Where the tests of folders of csrc/ lie that have none of their own name.
HOMES = {
    "base": {"kernels", "pipeline"},
    "data": {"kernels", "pipeline"},
    "frame": {"exactness", "images", "pipeline"},
    "images": {"files", "writers"},
    "kernels": {"exactness"},
    "reference": {"exactness", "images"},
}
CO_OPTIMIZED = 1  # functions have it; modules and classes, which run when they are imported, don't

_calls: Counter[str] = Counter()


# ---- in the process of the tests, as a plugin of pytest ----


def _note(frame, event, argument):
    if frame.f_code.co_flags & CO_OPTIMIZED:
        _calls[frame.f_code.co_filename] += 1


def pytest_collection_modifyitems(items):
    """Keep the first and the last set of parameters of each test."""
    sets = defaultdict(list)
    for item in items:
        sets[item.nodeid.partition("[")[0]].append(item)
    _calls["all"] = len(items)
    items[:] = [item for same in sets.values() for item in (same[0], same[-1])[: len(same)]]
    _calls["kept"] = len(items)


def pytest_runtestloop():
    threading.settrace(_note)
    sys.settrace(_note)


def pytest_unconfigure():
    sys.settrace(None)
    if OUTPUT in os.environ:
        Path(os.environ[OUTPUT]).write_text(json.dumps({**_calls, "seconds": time.process_time()}))


# ---- the recording ----


def recorded_file(test: Path) -> Path:
    return RECORDED / f"{'.'.join(test.relative_to(ROOT / 'tests').with_suffix('').parts)}.json"


def record(test: Path) -> None:
    """Run the tests of a file, and write how often each source file was entered."""
    counted = sorted((ROOT / "build").rglob("*.gcda"))
    for path in counted:
        path.unlink()
    output = recorded_file(test)
    environment = {**os.environ, OUTPUT: str(output), "PYTHONPATH": str(ROOT / "tests")}
    command = [sys.executable, "-m", "pytest", "-q", "-m", "not slow and not experiment"]
    subprocess.run(
        [*command, "-p", "record", str(test)],
        cwd=ROOT,
        env=environment,
        stdout=subprocess.DEVNULL,
        check=False,
    )
    if not output.exists():
        print(f"{test}: ended without a record", file=sys.stderr)
        return
    calls = Counter(json.loads(output.read_text()))
    seconds = calls.pop("seconds") * calls.pop("all", 1) / (calls.pop("kept", 1) or 1)
    entered = {source_name(path): count for path, count in calls.items() if source_name(path)}
    entered |= c_functions_entered()
    output.write_text(json.dumps({"seconds": seconds, "entered": entered}))


def source_name(path: str) -> str:
    """A file's path in the project, or nothing if it is no file of the product."""
    absolute = Path(ROOT, path)
    if not absolute.is_relative_to(ROOT) or not absolute.is_file():
        return ""
    name = absolute.relative_to(ROOT).as_posix()
    return name if name.startswith(("csrc/", "engine/")) else ""


def c_functions_entered() -> Counter[str]:
    """How often the functions of each C file were entered, as gcov has it."""
    entered: Counter[str] = Counter()
    data = [path for path in (ROOT / "build").rglob("*.gcda") if "_native" not in path.parts]
    if not data:
        return entered
    command = ["gcov", "--stdout", "--json-format", *map(str, data)]
    text = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for line in text.splitlines():
        for file in json.loads(line)["files"]:
            name = source_name(file["file"])
            if name:
                entered[name] += sum(f["execution_count"] for f in file["functions"])
    return +entered


def table() -> str:
    """The tests of each file: those first whose calls go to it for the greatest part."""
    found = defaultdict(list)
    for path in sorted(RECORDED.glob("*.json")):
        one = json.loads(path.read_text())
        total = sum(one["entered"].values())
        test = path.stem.replace(".", "/")
        for name, count in one["entered"].items():
            near = NEAR if is_near(test, name) else 1
            found[name].append((near * count / total, test, one["seconds"]))
    return "".join(f"{name}: {' '.join(chosen(tests))}\n" for name, tests in sorted(found.items()))


def is_near(test: str, source: str) -> bool:
    """Whether a test lies where those of a source file lie."""
    folders = source.split("/")[1:-1]
    return bool({*test.split("/")[:-1]} & set(folders).union(*(HOMES.get(f, ()) for f in folders)))


def chosen(tests: list[tuple[float, str, float]]) -> list[str]:
    names, left = [], SECONDS
    for _, test, seconds in sorted(tests, reverse=True):
        if len(names) < TESTS and (seconds <= left or not names):
            names.append(test)
            left -= seconds
    return names


def main(arguments: list[str]) -> None:
    RECORDED.mkdir(parents=True, exist_ok=True)
    named = [path for word in arguments for path in tests_below(Path(word).resolve())]
    rest = [p for p in tests_below(ROOT / "tests") if p.relative_to(ROOT).parts[1] not in LEFT_OUT]
    for test in named or [test for test in rest if not recorded_file(test).exists()]:
        print(test.relative_to(ROOT), flush=True)
        record(test)
    TABLE.write_text(table(), "utf-8")


def tests_below(path: Path) -> list[Path]:
    return sorted(path.rglob("test_*.py")) if path.is_dir() else [path]


if __name__ == "__main__":
    main(sys.argv[1:])
