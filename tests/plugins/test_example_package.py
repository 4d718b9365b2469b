"""The package of docs/examples/package, installed by pip: each of its six parts is used."""

import json
import subprocess
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.datasets.kinds import writer_class
from engine3d.base.plugins.groups import GROUPS
from engine3d.loaders import formats

SIZE = ["--size", "32x24"]


@pytest.fixture
def hills(tmp_path):
    path = tmp_path / "a.hills"
    np.savetxt(path, np.arange(12.0).reshape(3, 4))
    return path


def test_every_group_has_an_example(example):
    listed = [plugin for plugin in e3d.plugins.listed() if plugin.package == "engine3d-hills"]
    assert sorted({plugin.group for plugin in listed}) == sorted(GROUPS)
    assert {plugin.version for plugin in listed} == {"1.0"}


def test_a_file_is_read(example, hills):
    mesh = e3d.load_mesh(hills)
    assert len(mesh.positions) == 12 and mesh.name == "a"
    assert mesh.bounds[:, 1].tolist() == [0, 11]
    scene = e3d.load_scene(hills)
    assert [node.name for node in scene.nodes] == ["a"]
    assert e3d.render(hills, size=(32, 24)).color.shape == (24, 32, 4)
    assert e3d.load_mesh(hills.read_bytes(), format="hills").positions.tolist() == (
        mesh.positions.tolist()
    )


def test_a_damaged_file_names_itself(example, tmp_path):
    path = tmp_path / "b.hills"
    path.write_text("1 2\n3 x\n")
    with pytest.raises(e3d.FileFormatError, match=r"b\.hills: .*'x'"):
        e3d.load_mesh(path)


def test_a_file_is_written_and_converted(example, hills, tmp_path):
    out = tmp_path / "out.hills"
    e3d.save_mesh(e3d.load_mesh(hills), out, digits=1)
    assert out.read_text().splitlines()[0] == "0.0 1.0 2.0 3.0"
    e3d.save_scene(e3d.load_scene(hills), out)
    assert np.loadtxt(out).tolist() == np.loadtxt(hills).tolist()
    assert main(["convert", str(hills), str(tmp_path / "c.hills")]) == 0
    assert (tmp_path / "c.hills").read_bytes() == out.read_bytes()
    with pytest.raises(e3d.InvalidArgumentError, match="hills files have no option 'ascii'"):
        e3d.save_mesh(e3d.box(), out, ascii=True)


def test_what_a_format_lacks_is_told_and_what_fails_leaves_the_old_file(example, hills, tmp_path):
    scene = e3d.load_scene(hills)
    scene.add(e3d.box())
    out = tmp_path / "out.hills"
    with pytest.warns(e3d.Engine3DWarning, match=r"out\.hills: 1 other nodes are left out"):
        e3d.save_scene(scene, out)
    before = out.read_bytes()
    with pytest.raises(e3d.FileFormatError, match="no hills"):
        e3d.save_mesh(e3d.box(), out)
    assert out.read_bytes() == before and len(list(tmp_path.iterdir())) == 2


def test_formats_are_listed_with_their_package(example, capsys):
    found = next(row for row in formats("mesh") if row.name == "hills")
    assert found.description == "by engine3d-hills 1.0" and found.extensions == (".hills",)
    with pytest.raises(SystemExit):
        from engine3d.apps.cli.parser import parse

        parse(["--list-readers"])
    assert "by engine3d-hills 1.0" in capsys.readouterr().out


def test_the_command_runs_and_has_its_help(example, hills, capsys):
    assert main(["heights", str(hills)]) == 0
    assert capsys.readouterr().out == f"{hills}: 0 to 11\n"
    assert main(["heights", "--help"]) == 0
    assert "Print the lowest and the highest point" in capsys.readouterr().out
    assert main(["--help"]) == 0
    assert "heights       by engine3d-hills 1.0" in capsys.readouterr().out
    assert main(["completion", "bash"]) == 0
    completed = capsys.readouterr().out
    assert "heights" in completed and "valley" in completed and "evening" in completed


def test_the_scene_and_the_look_are_drawn(example, tmp_path):
    pictures = []
    for look in ("studio", "evening"):
        out = tmp_path / f"{look}.png"
        arguments = ["render", "--scene", "valley", "--look", look, "-o", str(out), *SIZE]
        assert main(arguments) == 0
        pictures.append(e3d.load_texture(out).pixels.tolist())
    assert pictures[0] != pictures[1]
    by_name = e3d.render(e3d.box(), look="evening", size=(32, 24))
    assert by_name.color.tolist() != e3d.render(e3d.box(), size=(32, 24)).color.tolist()


def batch(folder, hills, jobs="1", **more):
    """Draw a data set of hills in folder/out; return the exit status."""
    manifest = {
        "version": 1,
        "dataset": {"writer": "yolo"},
        "defaults": {"size": [32, 24]},
        "tasks": [{"model": str(hills), "name": "a"}, {"model": str(hills), "name": "b"}],
        **more,
    }
    path = folder / "manifest.json"
    path.write_text(json.dumps(manifest))
    return main(["batch", str(path), "-o", str(folder / "out"), "--jobs", jobs, "--resume"])


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_batch_records_who_took_part(example, hills, tmp_path, capsys, jobs):
    assert writer_class("yolo").kind == "yolo"
    assert batch(tmp_path, hills, jobs) == 0
    assert "with plug-ins of engine3d-hills 1.0" in capsys.readouterr().out
    assert (tmp_path / "out" / "labels" / "b.txt").read_text().startswith("0 0.")
    for name in ("a", "b"):
        record = (tmp_path / "out" / ".batch" / f"{name}.json").read_bytes()
        stamps = json.loads(record)["plugins"]
        assert stamps == [
            ["datasets", "yolo", "engine3d-hills", "1.0"],
            ["readers", "hills", "engine3d-hills", "1.0"],
        ]
    assert batch(tmp_path, hills, jobs) == 0
    assert "0 drawn, 2 done before" in capsys.readouterr().out


def test_a_batch_draws_again_what_another_version_read(
    example, example_site, hills, tmp_path, capsys, monkeypatch
):
    from engine3d.base.plugins.plugin import Plugin

    assert batch(tmp_path, hills) == 0
    capsys.readouterr()
    stamp = Plugin.stamp.fget
    newer = property(lambda self: [*stamp(self)[:3], "1.1"])
    monkeypatch.setattr(Plugin, "stamp", newer)
    assert batch(tmp_path, hills) == 0
    assert "2 drawn, 0 done before" in capsys.readouterr().out


def test_a_manifest_leaves_plugins_out(example, hills, tmp_path, capsys):
    without = {"defaults": {"plugins": False, "size": [32, 24]}}
    assert batch(tmp_path, hills, **without) == 1
    assert "unknown mesh format '.hills'" in capsys.readouterr().err
    assert batch(tmp_path, hills, defaults={"plugins": "no"}) == 1
    assert "defaults.plugins: plugins must be True or False" in capsys.readouterr().err


def test_plugins_are_left_out_on_demand(example, hills, tmp_path, capsys, monkeypatch):
    assert main(["--no-plugins", "plugins"]) == 0
    assert capsys.readouterr().out == "no plug-ins\n"
    out = ["-o", str(tmp_path / "a.png"), *SIZE]
    assert main(["render", str(hills), "--no-plugins", *out]) == 1
    assert "unknown mesh format '.hills'" in capsys.readouterr().err
    assert main(["render", "--scene", "valley", "--no-plugins", *out]) == 2
    assert main(["render", str(hills), *out]) == 0
    monkeypatch.setenv("ENGINE3D_PLUGINS", "0")
    assert e3d.plugins.listed() == ()
    with pytest.raises(e3d.FileFormatError, match="unknown mesh format"):
        e3d.load_mesh(hills)


def test_the_list_says_what_can_be_imported(example, capsys):
    assert main(["plugins"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 6 and all("engine3d-hills 1.0  imported in" in line for line in lines)
    assert main(["plugins", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["contract"] == e3d.plugins.API == 1
    assert {each["problem"] for each in report["plugins"]} == {None}


READS_NO_GROUP = """
import sys
import engine3d as e3d
from engine3d.apps.cli import main

e3d.render(e3d.box(), size=(8, 6), look="plain")
e3d.save_mesh(e3d.box(), "a.obj")
assert main(["render", "a.obj", "-o", "a.png", "--size", "8x6", "--look", "plain"]) == 0
assert main(["convert", "a.obj", "a.ply"]) == 0
from engine3d.base.plugins.discovery import _found
print(_found.cache_info().currsize, "engine3d_hills" in sys.modules)
"""


def test_what_ships_reads_no_group(example, tmp_path):
    command = [sys.executable, "-c", READS_NO_GROUP]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert run.stdout == "0 False\n", run.stderr
