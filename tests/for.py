"""Names the tests of source files: the few to run after a change, in less than a minute.

    python tests/for.py csrc/kernels/generic/shade/light.inl    prints a command of pytest
    eval "$(python tests/for.py engine/model/scene/nodes.py)"         runs it

In: paths of engine/ and csrc/; of tests, which are their own. Out: the tests that have the file's
name, and those that tests/record.py has found to be the busiest in it; of a header without code,
those of the files that include it; of a file that was not recorded, those that import or name it.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "tests" / "covered.txt"
MOST = 6  # files of tests


def read_table() -> dict[str, list[str]]:
    lines = TABLE.read_text(encoding="utf-8").splitlines()
    rows = (line.partition(": ") for line in lines if not line.startswith("#"))
    return {source: tests.split() for source, _, tests in rows}


def named_alike(path: Path) -> tuple[list[str], list[str]]:
    """The tests that have the file's name: those in a folder of the file's, and the others."""
    stem = path.stem.strip("_")
    found = sorted((ROOT / "tests").rglob(f"test_{stem}.py"))
    near = [test_name(test) for test in found if test.parent.name in path.parts]
    return near, [name for name in map(test_name, found) if name not in near]


def naming(path: Path) -> list[str]:
    """The tests that import a module of engine/, or its package, or that name any other file."""
    tests = sorted((ROOT / "tests").rglob("test_*.py"))
    if path.suffix == ".py" and path.is_relative_to(ROOT / "engine"):
        module = path.parent if path.name == "__init__.py" else path.with_suffix("")
        packages = (at.relative_to(ROOT / "engine").parts for at in (module, module.parent))
        words = [".".join(("engine3d", *parts)) for parts in packages if parts]
    else:
        near = [test for test in tests if test.parent.name in path.parts]
        tests, words = (tests, [path.name]) if path.suffix == ".md" else (near, [path.stem])
    for word in words:
        pattern = re.compile(rf"\b{re.escape(word)}\b")
        found = [test_name(test) for test in tests if pattern.search(test.read_text("utf-8"))]
        if found:
            return found
    return []


def test_name(test: Path) -> str:
    return test.relative_to(ROOT / "tests").with_suffix("").as_posix()


def including(path: Path) -> list[Path]:
    """The files of csrc/ that include a header."""
    pattern = re.compile(rf'^#\s*include "(?:[\w/]*/)?{re.escape(path.name)}"', re.M)
    sources = [p for p in sorted((ROOT / "csrc").rglob("*")) if p.suffix in (".c", ".h", ".inl")]
    return [path for path in sources if pattern.search(path.read_text("utf-8"))]


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def tests_of_users(header: Path, table: dict[str, list[str]]) -> list[str]:
    """The best test of each file that includes a header, if need be through other headers."""
    users, seen = [header], {header}
    while users:
        users = [user for each in users for user in including(each) if user not in seen]
        seen.update(users)
        found = [test for user in users for test in table.get(name_of(user), [])[:1]]
        if found:
            return [test for test, _ in Counter(found).most_common()]
    return []


def tests_of(path: Path, table: dict[str, list[str]]) -> list[str]:
    """The tests of a file, the best first."""
    name = name_of(path)
    if name.startswith("tests/"):
        return [test_name(path)] if path.name.startswith("test_") else []
    recorded = table.get(name, [])
    if not recorded and path.suffix in (".h", ".inl"):
        recorded = tests_of_users(path, table)
    near, others = named_alike(path)
    return list(dict.fromkeys([*near, *(recorded or naming(path)), *others]))[:MOST]


def main(arguments: list[str]) -> int:
    table, chosen = read_table(), {}
    for word in arguments:
        path = Path(word).resolve()
        if not path.is_relative_to(ROOT) or not path.is_file():
            print(f"tests/for.py: {word}: no file of this project", file=sys.stderr)
            return 2
        chosen |= dict.fromkeys(tests_of(path, table))
    if not chosen:
        print("tests/for.py: no test is known: `pytest -m 'not slow'`", file=sys.stderr)
        return 1
    print('pytest -q -m "not slow"', *(f"tests/{name}.py" for name in chosen))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
