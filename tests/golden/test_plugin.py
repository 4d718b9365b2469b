"""The fixture `golden` in runs of pytest of its own."""

import json
import os
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from golden.samples import changed, write_png
from missing_here import is_superuser

import engine3d as e3d
import engine3d.rendering.frame  # inner runs find it, and NumPy, imported
from engine3d.apps.golden import png_files
from engine3d.apps.golden.golden_files import encode_golden, read_golden

pytest_plugins = ["pytester"]

HEAD = """
import numpy as np
import pytest
from pathlib import Path

def picture(value=0):
    pixels = np.arange(6 * 8 * 4, dtype=np.uint8).reshape(6, 8, 4).copy()
    pixels[2, 3, 0] += value
    return pixels
"""
DRAWN = np.arange(6 * 8 * 4, dtype=np.uint8).reshape(6, 8, 4)


@pytest.fixture
def run(pytester, monkeypatch):
    """``run(code, *arguments)``: test_a.py in a run of its own; ``run(None, …)`` keeps the file."""
    monkeypatch.delenv("CI", raising=False)
    # Looking for plugins takes longer than all the rest.
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    plugins = ("-p", "engine3d.apps.golden.plugin", "-p", "no:cacheprovider")

    def run(code, *arguments):
        if code is not None:
            pytester.makepyfile(test_a=HEAD + code)
        return pytester.runpytest_inprocess(*plugins, *arguments)

    run.path = pytester.path
    run.folder = pytester.path / "golden" / "test_a"
    run.names = lambda: sorted(
        p.relative_to(run.folder).as_posix() for p in run.folder.rglob("*.png")
    )
    return run


ONE = "def test_one(golden): golden(picture({}))"


def test_a_missing_picture_fails_and_says_what_to_do(run):
    result = run(ONE.format(0))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "*AssertionError: test_a/test_one: there is no golden picture yet",
            f"*golden: *{run.folder / 'test_one.png'}",
            "*drawn now: *test_one.png",
            "*pytest --golden-update=missing",
        ]
    )
    assert not run.folder.exists()


def test_written_then_equal_then_different(run):
    run(ONE.format(0), "--golden-update=missing").assert_outcomes(passed=1)
    assert run.names() == ["test_one.png"]
    assert np.array_equal(read_golden(str(run.folder / "test_one.png")).pixels(), DRAWN)
    result = run(None)
    result.assert_outcomes(passed=1)
    result.stdout.no_fnmatch_line("*golden pictures*")
    result = run(ONE.format(5))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(
        [
            "*test_a/test_one: 1 of 48 pixels differ by up to 5, within (3, 2) to (3, 2)",
            "*difference: *test_one.difference.png",
            "*pytest --golden-update=failed",
            "1 changed",
            "side by side: pytest --golden-report=FILE.html",
        ]
    )
    line = next(line for line in result.outlines if "drawn now:" in line)
    now = read_golden(line.split("drawn now:")[1].strip())
    assert np.array_equal(now.pixels(), changed(DRAWN, by=(5, 0, 0, 0)))


def test_a_failure_says_that_another_version_wrote_the_picture(run, monkeypatch):
    monkeypatch.setattr("engine3d.apps.golden.golden_files.PICTURES", 41)
    run(ONE.format(0), "--golden-update").assert_outcomes(passed=1)
    assert read_golden(str(run.folder / "test_one.png")).pictures == 41
    run(None).assert_outcomes(passed=1)  # equal bytes pass, whoever wrote them
    now = f"{e3d.__version__} with PICTURES {e3d.PICTURES}"
    run(ONE.format(5)).stdout.fnmatch_lines([f"*PICTURES 41. *engine3d {now}: docs/versions.md*"])
    monkeypatch.setattr("engine3d.apps.golden.golden_files.PICTURES", e3d.PICTURES)
    run(ONE.format(5), "--golden-update").assert_outcomes(passed=1)
    run(ONE.format(0)).stdout.no_fnmatch_line("*docs/versions.md*")


def test_a_golden_file_may_not_say_its_version(run):
    run(ONE.format(0), "--golden-update").assert_outcomes(passed=1)
    path = run.folder / "test_one.png"
    (header, (name, text), *rest) = png_files.split_chunks(path.read_bytes())
    said = {key: value for key, value in json.loads(text).items() if key != "pictures"}
    chunks = [header, (name, json.dumps(said).encode()), *rest]
    path.write_bytes(png_files.join_chunks(chunks))
    golden = read_golden(str(path))
    assert golden.digest is not None and golden.pictures is None
    run(ONE.format(5)).stdout.no_fnmatch_line("*docs/versions.md*")


def test_a_run_without_failure_decodes_nothing(run, monkeypatch):
    run(ONE.format(0), "--golden-update")

    def decode(*arguments):
        raise AssertionError("decoded")

    monkeypatch.setattr("engine3d.apps.golden.golden_files.exact_pixels", decode)
    monkeypatch.setattr("engine3d.apps.golden.golden_files.decode_picture", decode)
    run(None).assert_outcomes(passed=1)
    run(ONE.format(1)).assert_outcomes(failed=1)  # the test of this test


@pytest.mark.parametrize(
    ("update", "passed", "written"),
    [
        ("=failed", {"test_changed"}, {"changed.png"}),
        ("=missing", {"test_missing"}, {"missing.png"}),
        ("=all", {"test_changed", "test_missing"}, {"changed.png", "missing.png"}),
        ("", {"test_changed", "test_missing"}, {"changed.png", "missing.png"}),
    ],
)
def test_what_an_update_writes(run, update, passed, written):
    code = (
        "def test_changed(golden): golden(picture(), 'changed')\n"
        "def test_missing(golden): golden(picture(), 'missing')\n"
        "def test_same(golden): golden(picture(), 'same')\n"
    )
    for name, pixels in (("changed", changed(DRAWN)), ("same", DRAWN)):
        run.folder.mkdir(parents=True, exist_ok=True)
        (run.folder / f"{name}.png").write_bytes(encode_golden(pixels))
    before = {name: (run.folder / name).stat().st_mtime_ns for name in run.names()}
    result = run(code, f"--golden-update{update}", "test_a.py")
    result.assert_outcomes(passed=1 + len(passed), failed=2 - len(passed))
    after = {
        name for name in run.names() if (run.folder / name).stat().st_mtime_ns != before.get(name)
    }
    assert after == written
    lines = [line for line in result.outlines if line.startswith("written: ")]
    assert lines == [f"written: golden/test_a/{name}" for name in sorted(written)]


def test_ci_never_writes(run, monkeypatch):
    monkeypatch.setenv("CI", "true")
    for option in ("--golden-update", "--golden-update=failed", "--golden-unused=delete"):
        result = run(ONE.format(0), option)
        assert result.ret == pytest.ExitCode.USAGE_ERROR
        result.stderr.fnmatch_lines(
            ["*golden pictures are not written where the variable CI is set*"]
        )
    run(None).assert_outcomes(failed=1)
    assert not run.folder.exists()
    monkeypatch.setenv("CI", "false")
    run(None, "--golden-update").assert_outcomes(passed=1)


def test_an_unknown_update_is_told(run):
    result = run(ONE.format(0), "--golden-update=everything")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*--golden-update is failed, missing, all, not 'everything'"])


def test_names(run):
    code = """
class TestShapes:
    @pytest.mark.parametrize("case", ["4-red", "a/b", "../../up", "b c"])
    def test_case(self, golden, case):
        golden(picture())
        golden(picture(1))
def test_given(golden):
    golden(picture(), "folder/name: 1")
"""
    run(code, "--golden-update").assert_outcomes(passed=5)
    run(None).assert_outcomes(passed=5)
    names = run.names()
    assert len(names) == 9
    assert {"TestShapes.test_case-4-red.png", "TestShapes.test_case-4-red-2.png"} <= set(names)
    assert {"TestShapes.test_case-b c.png"} <= set(names)
    assert [p.name for p in (run.path / "golden").iterdir()] == ["test_a"]


@pytest.mark.parametrize("name", ["../x", "/tmp/x", "a/../../../x", ""])
def test_no_name_leads_out(run, name):
    result = run(f"def test_out(golden): golden(picture(), {name!r})", "--golden-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*InvalidArgumentError: * is no name of a golden picture*"])
    assert list(run.path.rglob("*.png")) == []


def test_tests_may_share_a_picture_but_not_disagree(run):
    code = """
@pytest.mark.parametrize("backend", [0, 0, {}])
def test_shared(golden, backend):
    golden(picture(backend), "shared")
"""
    run(code.format(0), "--golden-update").assert_outcomes(passed=3)
    run(code.format(1)).assert_outcomes(passed=2, failed=1)
    result = run(code.format(1), "--golden-update")
    result.assert_outcomes(passed=3)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(["test_a/shared: two calls gave different pictures *"])
    (run.folder / "shared.png").unlink()
    result = run(code.format(1), "--golden-update")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*AssertionError: test_a/shared: two calls gave different *"])


def test_names_that_some_system_takes_for_one_may_not_disagree(run):
    code = """
@pytest.mark.parametrize("name, backend", [("Chair", 0), ("chair", {})])
def test_shared(golden, name, backend):
    golden(picture(backend), name)
"""
    run(code.format(0), "--golden-update").assert_outcomes(passed=2)
    for path in run.folder.glob("*.png"):
        path.unlink()
    result = run(code.format(1), "--golden-update")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*AssertionError: test_a/chair: two calls gave different *"])


def test_allowances(run):
    write_png(run.folder / "a.png", DRAWN)
    code = """
@pytest.mark.parametrize("by, allowed, works", [
    (3, {"tolerance": 3}, True), (3, {"tolerance": 2}, False), (3, {"max_different": 1}, True),
    (0, {}, True), (3, {}, False), (3, {"max_different": 0, "tolerance": 2.5}, False),
])
def test_it(golden, by, allowed, works):
    if works:
        golden(picture(by), "a", **allowed)
    else:
        with pytest.raises(AssertionError, match="1 of 48"):
            golden(picture(by), "a", **allowed)
@pytest.mark.parametrize("wrong", [-1, "1", float("nan")])
def test_wrong(golden, wrong):
    with pytest.raises(ValueError, match="at least 0"):
        golden(picture(), "a", tolerance=wrong)
"""
    run(code).assert_outcomes(passed=9)


def test_flip(run):
    pytest.importorskip("flip_evaluator", reason="needs flip-evaluator")
    write_png(run.folder / "a.png", DRAWN)
    code = """
def test_passes(golden): golden(picture(9), "a", max_flip=0.5)
def test_fails(golden): golden(255 - picture(9), "a", max_flip=0.01)
"""
    result = run(code)
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*; mean FLIP error 0.*"])


def test_a_picture_of_other_means_may_lack_alpha(run):
    write_png(run.folder / "test_one.png", DRAWN[..., :3])
    code = "def test_one(golden): pixels = picture(); pixels[..., 3] = 255; golden(pixels)"
    run(code).assert_outcomes(passed=1)
    run.folder.joinpath("test_one.png").write_bytes(encode_golden(DRAWN[..., :3]))
    result = run(None)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*it is 8x6 RGBA, not 8x6 RGB"])


def test_a_damaged_file_fails_and_is_mended(run):
    run.folder.mkdir(parents=True)
    (run.folder / "test_one.png").write_bytes(encode_golden(DRAWN)[:-9])
    result = run(ONE.format(0))
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*test_one.png: the PNG file ends too early"])
    run(None, "--golden-update=missing").assert_outcomes(failed=1)
    run(None, "--golden-update=failed").assert_outcomes(passed=1)
    run(None).assert_outcomes(passed=1)


def test_a_folder_that_cannot_be_written_to(run):
    (run.path / "golden").write_text("")  # even the superuser cannot write into a file
    result = run(ONE.format(0), "--golden-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*FileAccessError: *test_one.png: cannot write: *"])


@pytest.mark.skipif(
    is_superuser() or os.name == "nt", reason="the superuser and Windows write to such folders, too"
)
def test_a_read_only_folder(run):
    run.folder.mkdir(parents=True)
    run.folder.chmod(0o500)
    result = run(ONE.format(0), "--golden-update")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*FileAccessError: *cannot write: Permission denied"])
    assert run.names() == []


def test_a_fixture_of_that_name_comes_first(run):
    code = """
@pytest.fixture
def golden(): return 7
def test_own(golden): assert golden == 7
"""
    run(code).assert_outcomes(passed=1)


def test_calls_of_other_fixtures_count(run):
    code = """
@pytest.fixture
def before_and_after(golden):
    golden(picture(), "before")
    yield
    golden(picture(), "after")
def test_it(before_and_after, golden): golden(picture(), "within")
"""
    result = run(code, "--golden-update")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["3 updated"])
    assert unused(run(None)) == []


# Unused files

TWO = """
def test_one(golden): golden(picture())
def test_two(golden): golden(picture(1))
"""


def unused(result):
    return [line for line in result.outlines if "no test asks for it" in line]


def test_unused_files_are_reported_failed_or_deleted(run):
    run(TWO, "--golden-update")
    assert unused(run(None)) == []
    code = ONE.format(0)
    result = run(code)
    assert result.ret == 0
    assert unused(result) == ["no test asks for it: golden/test_a/test_two.png"]
    result = run(None, "--golden-unused=fail", "--golden-json=a.json")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    assert json.loads((run.path / "a.json").read_text())["deletedItems"] == ["test_a/test_two"]
    assert len(run.names()) == 2
    result = run(None, "--golden-unused=delete")
    assert unused(result) == ["deleted, no test asks for it: golden/test_a/test_two.png"]
    assert run.names() == ["test_one.png"] and unused(run(None)) == []


def test_files_of_a_module_that_is_gone_are_unused(run):
    run(ONE.format(0), "--golden-update")
    write_png(run.path / "golden" / "data" / "of_others.png", DRAWN)
    for name in ("test_gone", "test_there"):
        folder = run.path / "golden" / name
        folder.mkdir()
        (folder / "a.png").write_bytes(encode_golden(DRAWN))
        (folder / "b.png").write_bytes(b"no picture")
    (run.path / "test_there.py").write_text("")
    assert unused(run(None, "test_a.py")) == ["no test asks for it: golden/test_gone/a.png"]


@pytest.mark.parametrize(
    ("code", "arguments"),
    [
        (TWO, ["-k", "one"]),
        (TWO, ["test_a.py::test_one"]),
        (TWO, ["--deselect", "test_a.py::test_two"]),
        (TWO, ["-x", "--maxfail=1"]),
        (TWO.replace("def test_two", "@pytest.mark.skip\ndef test_two"), []),
        (TWO.replace("(1))", "(1)); assert False"), []),
        (TWO.replace("golden(picture(1))", "assert False"), []),
    ],
)
def test_nothing_is_unused_while_some_test_might_ask_for_it(run, code, arguments):
    run(TWO, "--golden-update")
    write_png(run.folder / "perhaps.png", DRAWN)
    if "-x" in arguments:
        code = code.replace("def test_one(golden):", "def test_one(golden): assert False;")
    assert unused(run(code, *arguments)) == []


# Reports


def test_json_and_junit(run):
    run(TWO, "--golden-update")
    result = run(TWO.replace("(1)", "(9)"), "--golden-json=a.json", "--junitxml=a.xml")
    result.stdout.fnmatch_lines(["1 passed, 1 changed", "JSON: a.json"])
    document = json.loads((run.path / "a.json").read_text())
    assert document["failedItems"] == ["test_a/test_two"]
    assert document["passedItems"] == ["test_a/test_one"]
    two = next(one for one in document["pictures"] if one["status"] == "changed")
    assert (two["test"], two["different"], two["largest"]) == ("test_a.py::test_two", 1, 8)
    assert two["box"] == [3, 2, 4, 3]
    assert Path(two["difference"]).is_file() and Path(two["expected"]).is_file()
    properties = {
        one.get("name"): one.get("value")
        for one in ElementTree.parse(run.path / "a.xml").iter("property")
    }
    assert properties["golden test_a/test_one"] == "passed"
    assert properties["golden test_a/test_two"].startswith("1 of 48 pixels differ")


def test_folders_of_reports_are_made_and_errors_are_told(run):
    assert run(ONE.format(0), "--golden-update", "--golden-report=a/b/r.html").ret == 0
    assert (run.path / "a" / "b" / "r.html").is_file()
    result = run(None, "--golden-json=test_a.py/r.json")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(["error: test_a.py/r.json: cannot write: *"])


def test_workers_collect_and_one_process_reports(run, pytester, monkeypatch):
    pytest.importorskip("xdist", reason="needs pytest-xdist")
    code = """
@pytest.mark.parametrize("n", range(4))
def test_it(golden, n): golden(picture(n)); golden(picture(), "shared")
"""
    run(code, "--golden-update").assert_outcomes(passed=4)
    (run.folder / "test_it-3.png").unlink()
    write_png(run.folder / "old.png", DRAWN)
    write_png(run.path / "golden" / "test_b" / "test_one.png", DRAWN)
    pytester.makepyfile(test_b=HEAD + ONE.format(2))
    monkeypatch.delenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD")
    arguments = ("-n2", "--golden-json=a.json", "--golden-report=a.html")
    result = pytester.runpytest_subprocess(*arguments, "--golden-update=missing")
    result.assert_outcomes(passed=4, failed=1)
    assert unused(result) == ["no test asks for it: golden/test_a/old.png"]
    result.stdout.fnmatch_lines(["written: golden/test_a/test_it-3.png"])
    document = json.loads((run.path / "a.json").read_text())
    assert document["failedItems"] == ["test_b/test_one"]
    assert len(document["pictures"]) == 10
    assert "1 changed" in (run.path / "a.html").read_text()


# What it costs


def test_it_costs_nothing_when_it_is_not_used(pytester, monkeypatch):
    """Of all plug-ins ours is the only one here: those of other packages import what they like."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    folders = ("engine3d", "engine3d.apps", "engine3d.apps.golden")
    modules = (*folders, "engine3d.apps.golden.plugin", "engine3d.apps.golden.runs")
    pytester.makepyfile(
        f"""
        import sys

        def test_nothing():
            loaded = sorted(name for name in sys.modules if name.startswith("engine3d"))
            assert loaded == {[*modules, "engine3d.version"]}
            assert "numpy" not in sys.modules and "PIL" not in sys.modules
        """
    )
    plugins = ("-p", "engine3d.apps.golden.plugin", "-p", "no:cacheprovider")
    pytester.runpytest_subprocess(*plugins).assert_outcomes(passed=1)


def test_assertions_of_engine3d_stay_as_they_are(pytester, monkeypatch):
    pytester.makepyfile(
        test_a="""
        def test_loaders():
            import engine3d.choices
            assert type(engine3d.choices.__loader__).__name__ != "AssertionRewritingHook"
            import other
            assert type(other.__loader__).__name__ == "AssertionRewritingHook"
        """,
        other="",
    )
    # A distribution that names the files which a wheel installs; an editable install names none.
    folder = pytester.mkdir("fake-1.dist-info")
    (folder / "METADATA").write_text("Name: fake\nVersion: 1\n")
    (folder / "RECORD").write_text("engine3d/__init__.py,,\nother.py,,\n")
    (folder / "entry_points.txt").write_text("[pytest11]\nfake = other\n")
    monkeypatch.setenv("PYTHONPATH", str(pytester.path))
    result = pytester.runpytest_subprocess("-p", "no:cacheprovider")
    result.assert_outcomes(passed=1)


def test_the_fixture_is_listed(run):
    run("", "--fixtures").stdout.fnmatch_lines(["golden -- *", "*Compare a picture*"])
