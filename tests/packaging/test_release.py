"""What a release is built with, its papers, and what others read of it."""

import io
import json
import os
import re
import runpy
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from types import SimpleNamespace

import pytest

import engine3d as e3d

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="wheels are built on Linux")


def rules(source_tree, name):
    return runpy.run_path(str(source_tree / name), run_name="rules")


@pytest.mark.parametrize("machine", ["aarch64-linux-gnu", "x86_64-linux-musl"])
def test_a_module_is_named_after_its_machine(source_tree, tmp_path, machine):
    release = rules(source_tree, ".ci/release")
    release["write_settings"](machine, tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    tag = f"{sys.implementation.cache_tag}-{machine}"
    assert made["EXT_SUFFIX"] == f".{tag}.so"
    assert made["SOABI"] == tag


def test_no_folder_of_this_machine_is_in_the_settings(source_tree, tmp_path, monkeypatch):
    release = rules(source_tree, ".ci/release")
    here = {"MULTIARCH": "m", "EXT_SUFFIX": ".m.so", "SOABI": "m", "N": 1}
    here["LDSHARED"] = "gcc -shared -L/here/lib -Wl,-rpath,/here/lib -Wl,-z,now"
    monkeypatch.setattr(
        release["importlib"], "import_module", lambda name: SimpleNamespace(build_time_vars=here)
    )
    release["write_settings"]("x86_64-linux-musl", tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    assert made["LDSHARED"] == "gcc -shared -Wl,-z,now"
    assert made["HOST_GNU_TYPE"] == "x86_64-linux-musl" and made["N"] == 1


def test_the_cross_compiler_names_its_target(source_tree):
    command = [sys.executable, source_tree / ".ci" / "zigcc", "-dumpmachine"]
    environment = {**os.environ, "ENGINE3D_TARGET": "aarch64-linux-gnu.2.17"}
    named = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert named.stdout == "aarch64-linux-gnu.2.17\n"


@pytest.mark.parametrize(
    "target, has_frames, has_tables",
    [
        ("x86_64-linux-gnu.2.17", False, False),
        ("aarch64-linux-musl", False, False),
        ("x86_64-windows-gnu", False, True),
        ("aarch64-windows-gnu", True, True),
        ("aarch64-macos.11.0", True, True),
    ],
)
def test_the_cross_compiler_optimises_as_gcc_does(source_tree, target, has_frames, has_tables):
    given = ["-fno-strict-overflow", "-O3", "-fno-asynchronous-unwind-tables", "-pthread"]
    given += ["-fstrict-overflow", "-march=x86-64"]
    flags = rules(source_tree, ".ci/zigcc")["flags_of"](target, given)
    assert ("-fomit-frame-pointer" in flags) is not has_frames
    assert ("-fno-unwind-tables" in flags) is not has_tables
    # Python's own flag comes first, and must not be the last word.
    assert flags.index("-fstrict-overflow") > flags.index("-fno-strict-overflow")
    assert "-march=x86_64" in flags and "-pthread" not in flags


def test_a_module_for_windows_is_named_so_and_sees_its_headers(source_tree, tmp_path, monkeypatch):
    release = rules(source_tree, ".ci/release")
    ran = []
    monkeypatch.setattr(release["subprocess"], "run", lambda command, **_: ran.append(command))
    release["write_settings"]("win-amd64", tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    assert made["EXT_SUFFIX"] == ".pyd"
    config = (tmp_path / "include" / "pyconfig.h").read_text()
    assert made["INCLUDEPY"] == str(tmp_path / "include") and "SIZEOF_LONG 4" in config
    names = (tmp_path / "python3.def").read_text().split("EXPORTS")[1].splitlines()
    assert {"PyLong_FromLong", "PyType_Type DATA", "_Py_FatalErrorFunc", "PyErr_Format"} < {*names}
    assert all(name.lstrip("_").startswith("Py") for name in names if name)
    assert "ziglang" in ran[0]


def test_on_windows_each_folder_of_tests_has_a_process_of_its_own(source_tree, capsys):
    script = rules(source_tree, ".ci/windows")
    statuses = {"files": 1, "notebook": script["NO_TESTS"]}
    asked = []

    def test(folder, write):
        asked.append(folder.name)
        write(f"{folder.name} begins\n")
        write(f"{folder.name} is done\n")
        return script["Ended"](statuses.get(folder.name, 0), f"{folder.name} is done")

    windows = SimpleNamespace(test=test)
    assert script["whole"](windows) == 1
    assert {"batch", "editor", "files", "notebook"} < {*asked}
    lines = capsys.readouterr().out.splitlines()
    printed, table = lines[: 2 * len(asked)], lines[2 * len(asked) :]
    for name in asked:
        first = printed.index(f"{name} begins")
        assert printed[first + 1] == f"{name} is done"
    assert [line.split()[0] for line in table] == sorted(asked)
    assert all(line.endswith(f"{line.split()[0]} is done") for line in table)
    del statuses["files"]
    assert script["whole"](windows) == 0


@pytest.mark.parametrize(
    "platform, machine, is_windows",
    [
        ("linux-x86_64", "X86", False),
        ("x86_64-linux-gnu.2.17", "X86", False),
        ("win-amd64", "X86", True),
        ("x86_64-windows-gnu", "X86", True),
        ("linux-aarch64", "AARCH64", False),
        ("macosx-11.0-arm64", "AARCH64", False),
        ("aarch64_be-linux-gnu", "", False),
        ("linux-riscv64", "", False),
    ],
)
def test_the_build_knows_its_machine(source_tree, platform, machine, is_windows):
    build = rules(source_tree, "csrc/build_rules.py")
    assert build["machine_of"](platform) == machine
    assert build["is_windows"](platform) == is_windows


def test_each_machine_has_its_kernels(source_tree):
    isa_flags = rules(source_tree, "csrc/build_rules.py")["isa_flags"]
    assert list(isa_flags("X86")) == ["sse41", "avx2", "avx512"]
    assert isa_flags("AARCH64") == {"neon": []}
    assert isa_flags("") == {}


@pytest.mark.parametrize(
    "machine, platform, has_sdl",
    [
        ("x86_64-linux-gnu", "linux-x86_64", True),
        ("aarch64-linux-musl", "linux-aarch64", False),
        ("windows-gnu", "win-amd64", True),
        ("windows-gnu", "win-arm64", False),
        ("aarch64-linux-gnu", "macosx-11.0-arm64", True),
    ],
)
def test_only_where_there_is_sdl_it_is_required(
    source_tree, monkeypatch, machine, platform, has_sdl
):
    settings = {"SOABI": f"cpython-311-{machine}", "HOST_GNU_TYPE": machine}
    monkeypatch.setattr(sysconfig, "get_config_var", settings.get)
    monkeypatch.setattr(sysconfig, "get_platform", lambda: platform)
    required = rules(source_tree, "setup.py")["requirements"]()
    names = [requirement.partition(">")[0] for requirement in required]
    sdl = ["pysdl2-dll"] if has_sdl else []
    assert names == ["numpy", "pillow", "pysdl2", "rich", *sdl]


def packed(path, names, mtime, mode):
    """Write an archive as some machine would."""
    with tarfile.open(path, "w:gz") as archive:
        for name in names:
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime, entry.mode = len(name), mtime, mode
            entry.uid, entry.uname = mtime % 1000, f"user{mtime}"
            archive.addfile(entry, io.BytesIO(name.encode()))
    return path


def test_a_source_distribution_has_the_same_bytes_whoever_packs_it(source_tree, tmp_path):
    repack = rules(source_tree, ".ci/source_archive.py")["repack"]
    names = ["engine3d-1/b", "engine3d-1/a", "engine3d-1/" + "long/" * 60 + "c"]
    archives = [packed(tmp_path / "one.tar.gz", names, 1000, 0o600)]
    archives += [packed(tmp_path / "two.tar.gz", names[::-1], 2003, 0o664)]
    assert archives[0].read_bytes() != archives[1].read_bytes()
    for path in archives:
        repack(path, 1_700_000_000)
    assert archives[0].read_bytes() == archives[1].read_bytes()
    with tarfile.open(archives[0]) as archive:
        assert archive.getnames() == sorted(names)
        for entry in archive:
            assert archive.extractfile(entry).read() == entry.name.encode()
            assert (entry.mtime, entry.mode, entry.uname) == (1_700_000_000, 0o644, "")


def test_a_bill_of_materials_names_the_files_and_what_they_need(source_tree, tmp_path, monkeypatch):
    written = rules(source_tree, ".ci/bill_of_materials.py")["bill_of_materials"]
    monkeypatch.setitem(written.__globals__, "version", lambda name: "1.2")
    monkeypatch.setitem(written.__globals__, "mingw_version", lambda: "15.0.0")
    metadata = (
        "Metadata-Version: 2.4\nName: engine3d\nVersion: 0.1\nSummary: Draws\n"
        'License-Expression: MIT\nRequires-Dist: NumPy_x>=1.23\nRequires-Dist: no; extra == "no"\n'
    )
    wheel = tmp_path / "engine3d.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("engine3d-0.1.dist-info/METADATA", metadata)
    digests = {"engine3d.whl": "ab" * 32, "engine3d.tar.gz": "cd" * 32}
    digests["engine3d-win_amd64.whl"] = "ef" * 32
    text = written(digests, [wheel], 1_700_000_000)
    assert text == written(dict(reversed(digests.items())), [wheel], 1_700_000_000)
    content = json.loads(text)
    itself = content["metadata"]["component"]
    assert itself["purl"] == "pkg:pypi/engine3d@0.1"
    assert {one["name"]: one["hashes"][0]["content"] for one in itself["components"]} == digests
    held = {
        one["name"]: [part["name"] for part in one.get("components", [])]
        for one in itself["components"]
    }
    everywhere = ["compiler_rt of zig", "code that Cython adds"]
    assert held == {
        "engine3d.tar.gz": [],
        "engine3d.whl": everywhere,
        "engine3d-win_amd64.whl": [*everywhere, "mingw-w64", "winpthreads", "musl"],
    }
    (needed,) = content["components"]
    assert (needed["purl"], needed["properties"][0]["value"]) == ("pkg:pypi/numpy-x", ">=1.23")
    assert content["dependencies"][0]["dependsOn"] == [needed["bom-ref"]]
    validation = pytest.importorskip("cyclonedx.validation.json", exc_type=ImportError)
    schema = pytest.importorskip("cyclonedx.schema", exc_type=ImportError)
    assert validation.JsonStrictValidator(schema.SchemaVersion.V1_6).validate_str(text) is None


def test_what_is_compiled_in_has_its_notice(source_tree):
    notices = (source_tree / "csrc" / "NOTICES.txt").read_text("utf-8")
    rows = rules(source_tree, ".ci/bill_of_materials.py")["COMPILED_IN"]
    for part, name, _, licence in rows:
        where = "wheels for Windows" if part == "-win_" else "all wheels"
        assert (f"\n{name} ({where})\n" in notices) is (licence != "Apache-2.0"), name


@pytest.mark.parametrize(
    "given, links",
    [("", 0), ("https://code.invalid/us/engine3d/", 4), ("code.invalid", None)],
)
def test_the_repository_that_releases_it_is_named(source_tree, monkeypatch, given, links):
    monkeypatch.setenv("ENGINE3D_REPOSITORY", given)
    asked = rules(source_tree, "setup.py")["project_urls"]
    if links is None:
        with pytest.raises(SystemExit, match=r"ENGINE3D_REPOSITORY=code.invalid: expected https"):
            asked()
        return
    assert len(asked()) == links
    if links:
        assert asked()["Source"] == "https://code.invalid/us/engine3d"
        assert asked()["Changelog"] == "https://code.invalid/us/engine3d/blob/HEAD/CHANGELOG.md"


def test_links_of_the_description_lead_to_the_repository(source_tree, monkeypatch, tmp_path):
    described = rules(source_tree, "setup.py")["description"]
    monkeypatch.chdir(tmp_path)
    text = "![a](a.webp) [b](docs/b.md#c) [`d` e](d/) [f](#f) [g](https://g.invalid/)"
    (tmp_path / "README.md").write_text(text)
    assert described() == text
    monkeypatch.setenv("ENGINE3D_REPOSITORY", "https://code.invalid/us")
    head = "https://code.invalid/us/{}/HEAD"
    expected = text.replace("(a", f"({head.format('raw')}/a").replace(
        "(d", f"({head.format('blob')}/d"
    )
    assert described() == expected


def test_the_recipe_for_conda_says_what_the_package_does(source_tree):
    yaml = pytest.importorskip("yaml", exc_type=ImportError)
    recipe = yaml.safe_load((source_tree / ".ci" / "conda" / "recipe.yaml").read_text("utf-8"))
    assert recipe["package"]["version"] == e3d.__version__
    needed, built_with = (
        [need.replace(" ", "") for need in recipe["requirements"][name]] for name in ("run", "host")
    )
    project = (source_tree / "pyproject.toml").read_text("utf-8")
    oldest = re.search(r'^requires-python = "(.+)"$', project, re.MULTILINE)[1]
    required = rules(source_tree, "setup.py")["REQUIREMENTS"]
    assert needed == [f"python{oldest}", *required, "sdl2"]
    build_system = re.search(r"^requires = (\[.+\])$", project, re.MULTILINE)[1]
    assert built_with == [f"python{oldest}", "pip", *json.loads(build_system)]
    # pip would miss pysdl2-dll, for which sdl2 stands.
    assert recipe["tests"][0]["python"]["pip_check"] is False
    assert recipe["about"]["license_file"] == ["LICENSE", "data/fonts/LICENSE.txt"]


@pytest.mark.parametrize(
    "platform, tools",
    [
        ("linux-64", ["gcc_linux-64", "sysroot_linux-64 2.17.*"]),
        ("osx-arm64", ["clang_osx-arm64", "macosx_deployment_target_osx-arm64 11.0.*"]),
    ],
)
def test_rattler_build_resolves_the_recipe(source_tree, platform, tools):
    rattler = pytest.importorskip("rattler_build", reason="pip install py-rattler-build")
    folder = source_tree / ".ci" / "conda"
    machine = rattler.PlatformConfig(
        target_platform=platform, build_platform=platform, host_platform=platform
    )
    variants = rattler.VariantConfig.from_file_with_context(
        folder / "variants.yaml", rattler.JinjaConfig(platform=machine)
    )
    recipe = rattler.Stage0Recipe.from_file(folder / "recipe.yaml")
    (made,) = recipe.render(variants, rattler.RenderConfig(platform=machine))
    assert made.recipe.to_dict()["requirements"]["build"] == tools


@pytest.fixture
def workflow(source_tree):
    """The workflow that publishes a release."""
    yaml = pytest.importorskip("yaml", exc_type=ImportError)
    path = source_tree / ".github" / "workflows" / "release.yml"
    return yaml.safe_load(path.read_text("utf-8"))


def shell(command, cwd, **variables):
    done = subprocess.run(
        ["bash", "-e", "-c", command],
        cwd=cwd,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
    )
    return done.returncode, done.stdout


def test_only_a_tag_of_this_version_is_released(workflow, source_tree, tmp_path):
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "python").symlink_to(sys.executable)
    path = f"{tools}:{os.environ['PATH']}"
    (step,) = (step for step in workflow["jobs"]["build"]["steps"] if "tag" in step.get("name", ""))
    for tag, status in {f"v{e3d.__version__}": 0, "v0.0.9": 1}.items():
        done, said = shell(step["run"], source_tree, GITHUB_REF_NAME=tag, PATH=path)
        assert done == status and (tag in said) is bool(status)


def test_each_wheel_is_tried_and_draws_the_same(workflow, source_tree, tmp_path):
    jobs = workflow["jobs"]
    tried = [name for job in ("install", "install-musl") for name in systems_of(jobs[job])]
    assert len(tried) == len(rules(source_tree, ".ci/release")["TARGETS"])
    compare = jobs["same-pixels"]["steps"][-1]["run"]
    for number in range(len(tried)):
        folder = tmp_path / "pixels" / f"pixels-{number}"
        folder.mkdir(parents=True)
        (folder / "pixels.txt").write_bytes(b"ab\r\n" if number else b"ab\n")
    assert shell(compare, tmp_path)[0] == 0
    (folder / "pixels.txt").write_text("cd\n")
    assert shell(compare, tmp_path)[0] == 1
    (folder / "pixels.txt").unlink()
    assert shell(compare, tmp_path)[0] == 1


def systems_of(job):
    return job["strategy"]["matrix"]["os"]


def test_the_drawing_of_the_workflow_is_hashed(workflow, tmp_path):
    tools = tmp_path / "bin"
    tools.mkdir()
    for name, command in {"python": "", "engine3d": "-m engine3d"}.items():
        (tools / name).write_text(f'#!/bin/sh\nexec "{sys.executable}" {command} "$@"\n')
        (tools / name).chmod(0o755)
    status, _ = shell(workflow["env"]["DRAW"], tmp_path, PATH=f"{tools}:{os.environ['PATH']}")
    assert status == 0 and re.fullmatch(r"[0-9a-f]{64}\n", (tmp_path / "pixels.txt").read_text())


def test_a_wheel_that_is_too_large_is_refused(source_tree, tmp_path):
    release = rules(source_tree, ".ci/release")
    wheel = tmp_path / "large.whl"
    with open(wheel, "wb") as file:
        file.truncate(release["MAX_WHEEL_BYTES"] + 1)
    with pytest.raises(SystemExit, match=r"large.whl: 6,200,001 bytes, of at most 6,200,000"):
        release["check"](wheel, "win_amd64")


def test_forms_and_workflows_can_be_read(source_tree):
    yaml = pytest.importorskip("yaml", exc_type=ImportError)
    paths = [*source_tree.glob(".github/**/*.yml"), source_tree / ".readthedocs.yaml"]
    paths += [source_tree / "CITATION.cff"]
    assert len(paths) > 8
    for path in paths:
        assert yaml.safe_load(path.read_text("utf-8")), path
