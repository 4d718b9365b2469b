"""Nothing outside of the root folder is read or written, whatever a path looks like."""

import os

import pytest
from agents.conftest import Agent, models

import engine3d as e3d

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def caged(tmp_path):
    root, outside = tmp_path / "root", tmp_path / "root-beside"
    for folder in (root, outside, root / "sub"):
        folder.mkdir()
    models(root)
    models(outside)
    os.symlink(outside / "block.stl", root / "link.stl")
    os.symlink(outside, root / "door")
    os.symlink(root / "block.stl", root / "within.stl")
    return Agent(root, allow_scripts=True)


@pytest.mark.parametrize(
    "path",
    [
        "../root-beside/block.stl",
        "sub/../../root-beside/block.stl",
        "{outside}/block.stl",
        "link.stl",
        "door/block.stl",
        "/etc/passwd",
        "~/block.stl",
        "https://example.org/block.stl",
        "file:///etc/passwd",
        "s3://bucket/a.glb",
        "",
        "a\0b",
        ".",
        "sub",
    ],
)
def test_other_files_are_not_read(caged, path):
    path = path.format(outside=caged.root.parent / "root-beside")
    caged.error("load", path=path)
    caged.error("script", path=path)
    assert caged.told("scene")["objects"] == []


@pytest.mark.parametrize(
    "path", ["../out.stl", "door/out.stl", "/tmp/engine3d-out.stl", "link.stl", "no/out.stl"]
)
def test_other_files_are_not_written(caged, path):
    caged.told("load", path="block.stl")
    before = {p: p.read_bytes() for p in caged.root.parent.rglob("*") if p.is_file()}
    caged.error("export", path=path, overwrite=True)
    assert before == {p: p.read_bytes() for p in caged.root.parent.rglob("*") if p.is_file()}


def test_links_within_the_folder_are_read(caged):
    assert caged.told("load", path="within.stl")["triangles"] == 12
    assert caged.told("load", path=str(caged.root / "block.stl"))["triangles"] == 12
    assert caged.told("export", path="sub/out.stl")["path"] == "sub/out.stl"


def test_files_named_in_models_stay_within(caged):
    (caged.root / "a.obj").write_text(
        "mtllib ../root-beside/a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    )
    (caged.root.parent / "root-beside" / "a.mtl").write_text("newmtl secret\nKd 1 0 0\n")
    told = caged.told("load", path="a.obj")
    assert any("a.mtl" in line for line in told["warnings"])
    assert "secret" not in str(caged.told("scene"))


def test_a_root_that_holds_everything_is_refused(tmp_path):
    with pytest.raises(e3d.InvalidArgumentError, match="--root"):
        Agent("/")
    with pytest.raises(e3d.FileAccessError, match="no such folder"):
        Agent(tmp_path / "none")


@pytest.mark.parametrize("folder", ["", "sub/"])
def test_files_are_named_below_the_root(caged, folder):
    """Whatever is told of a file: its damage, what is left out of it, what a format lacks."""
    write = {"bad.stl": "nope", "none.obj": "", "bare.obj": "mtllib no.mtl\n" + TRIANGLE}
    for name, text in write.items():
        (caged.root / folder / name).write_text(text)
    assert caged.error("load", path=f"{folder}bad.stl").startswith(f"{folder}bad.stl: ")
    assert caged.error("load", path=f"{folder}none.obj").startswith(f"{folder}none.obj: ")
    told = [*caged.told("load", path=f"{folder}bare.obj")["warnings"]]
    caged.told("load", path="block.stl")
    saved = caged.call("export", path=f"{folder}out.stl", objects=["bare"])
    told += [part.text for part in saved.content]
    assert told and not any(str(caged.root) in line for line in told)
