"""A scene that is written, read and written again is the same file, whatever it is made of."""

import inspect

import pytest
from writers.any_scene import ARRAYS, MATERIALS, any_scene

import engine3d as e3d
from engine3d.model.materials.material import TEXTURE_SLOTS

pytestmark = pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")


def test_scenes_are_made_of_all_that_there_is():
    fields = inspect.signature(e3d.Material).parameters.keys()
    assert fields == {*MATERIALS, *TEXTURE_SLOTS}
    arrays = inspect.signature(e3d.Mesh).parameters.keys()
    assert arrays - {*ARRAYS} == {"positions", "faces", "materials", "joints", "weights", "name"}


@pytest.mark.parametrize("extension", ("e3d.json", "glb"))
@pytest.mark.parametrize("seed", range(45))
def test_what_is_read_is_written_as_it_was(seed, extension, tmp_path):
    scene = any_scene(seed)
    first, again = tmp_path / f"first.{extension}", tmp_path / f"again.{extension}"
    scene.save(first)
    read = e3d.load_scene(first)
    read.save(again)
    assert again.read_bytes() == first.read_bytes()
    scene.save(again)
    assert again.read_bytes() == first.read_bytes()


def test_copies_of_a_primitive_keep_their_names(tmp_path):
    scene = e3d.Scene()
    for name in ("first", None, "last"):
        box = e3d.box()
        box.name = box.name if name is None else name
        scene.add(box)
    scene.save(tmp_path / "a.e3d.json")
    read = e3d.load_scene(tmp_path / "a.e3d.json")
    assert [node.object.name for node in read.nodes] == ["first", "box", "last"]
