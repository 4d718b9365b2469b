"""tests/for.py names tests that there are, for files that there are."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOR = runpy.run_path(str(ROOT / "tests" / "for.py"))
RECORD = runpy.run_path(str(ROOT / "tests" / "record.py"))
TABLE = FOR["read_table"]()


def test_what_was_recorded_is_there():
    tests = {test for tests in TABLE.values() for test in tests}
    assert len(TABLE) > 400 and len(tests) > 100
    gone = [source for source in TABLE if not (ROOT / source).is_file()]
    gone += [test for test in tests if not (ROOT / "tests" / f"{test}.py").is_file()]
    assert gone == [], "moved or gone: respell them in tests/covered.txt, or run tests/record.py"


@pytest.mark.parametrize(
    ("stem", "test"),
    [
        ("light.inl", "kernels/test_light"),
        ("ply.py", "loaders/test_ply"),
        ("keymap.py", "viewer/test_keymap"),
        ("e3d_light.h", "kernels/test_layouts"),
    ],
)
def test_the_best_test_of_a_file(stem, test):
    paths = [path for name in ("engine", "csrc") for path in (ROOT / name).rglob(stem)]
    assert any(test in FOR["tests_of"](path, TABLE) for path in paths)


@pytest.mark.parametrize(
    ("file", "test"),
    [
        ("engine/apps/scenes/__init__.py", "docs/test_readme"),
        ("benchmarks/ratios.py", "benchmarks/test_benchmarks"),
        ("docs/make_map.py", "docs/test_inside"),
        ("README.md", "docs/test_readme"),
    ],
)
def test_files_that_were_not_recorded_are_found_by_name(file, test):
    assert file not in TABLE
    assert test in FOR["tests_of"](ROOT / file, TABLE)


def test_a_command_is_printed(capsys):
    assert FOR["main"]([__file__]) == 0
    assert capsys.readouterr().out.endswith(" tests/packaging/test_chosen_tests.py\n")
    assert FOR["main"](["nothing.py"]) == 2
    assert capsys.readouterr().err == "tests/for.py: nothing.py: no file of this project\n"


def test_busy_tests_come_first_within_the_time():
    tests = [(0.5, "far/test_a", 30.0), (0.4, "near/test_b", 20.0), (0.1, "near/test_c", 5.0)]
    assert RECORD["chosen"](tests) == ["far/test_a", "near/test_c"]
    assert RECORD["is_near"]("kernels/test_light", "csrc/kernels/generic/shade/light.inl")
    assert not RECORD["is_near"]("viewer/test_panels", "csrc/kernels/generic/shade/light.inl")
