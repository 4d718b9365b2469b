"""Arrays that the engine hands out cannot be written to, whatever flags are set."""

import contextlib

import numpy as np
import pytest
from public.test_copies import COPIED, MAY_BE_WRITTEN, REFUSED, painted

import engine3d as e3d
from engine3d.model.scene.scene_data import SceneData

#: What is not looked into: it shows nothing that a picture is drawn from, or is no program's, or
#: is the caller's own.
_ENDS = (
    *(str, bytes, int, float, bool, complex, type(None), type, np.dtype, np.generic),
    *(SceneData, e3d.Frame),
)


def arrays_of(thing):
    """All arrays that can be reached over public attributes, with the ways to them."""
    todo, seen = [("it", thing)], {}
    while todo:
        where, value = todo.pop()
        if isinstance(value, _ENDS) or id(value) in seen or where.count(".") > 6 or callable(value):
            continue
        seen[id(value)] = value
        if isinstance(value, np.ndarray):
            yield where, value
        elif isinstance(value, dict):
            todo += [(f"{where}[{key!r}]", item) for key, item in value.items()]
        elif isinstance(value, (list, tuple)):
            todo += [(f"{where}[{k}]", item) for k, item in enumerate(value)]
            names = getattr(value, "_fields", ())
        is_array = isinstance(value, np.ndarray)
        if type(value).__module__.startswith("engine3d") and not is_array:
            names = [name for name in dir(value) if not name.startswith("_")]
            todo += [(f"{where}.{name}", getattr(value, name, None)) for name in names]


def allows_writing(array):
    """Whether the array, or one below it, becomes writable when asked to."""
    while isinstance(array, np.ndarray):
        with contextlib.suppress(ValueError):
            array.setflags(write=True)
        if array.flags.writeable:
            array.setflags(write=False)
            return True
        array = array.base
    return not memoryview(array).readonly


@pytest.mark.parametrize("name", sorted({*COPIED, *REFUSED} - MAY_BE_WRITTEN - {"Sheet"}))
def test_arrays_that_are_handed_out_cannot_be_made_writable(name, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    thing = {**COPIED, **REFUSED}[name]()
    again = dict(arrays_of(thing))
    for where, array in arrays_of(thing):
        if array.flags.writeable:  # then it is the caller's own
            assert not np.shares_memory(array, again[where]), f"{where} can be written to"
        else:
            assert not allows_writing(array), f"{where} can be made writable"


@pytest.mark.parametrize("format", ("obj", "ply", "stl", "glb"))
def test_arrays_that_were_loaded_cannot_be_made_writable(format, tmp_path):
    with pytest.warns(e3d.Engine3DWarning):
        painted().save(tmp_path / f"ball.{format}")
    mesh = e3d.load_mesh(tmp_path / f"ball.{format}")
    found = dict(arrays_of(mesh))
    assert len(found) > 5 and not any(map(allows_writing, found.values()))


#: Attributes that take arrays, and how a caller's array gets there.
TAKEN = {
    "positions": (lambda a: e3d.Mesh(a).positions, np.float32, (3, 3)),
    "faces": (lambda a: e3d.Mesh(np.eye(3), a).faces, np.int32, (1, 3)),
    "pixels": (lambda a: e3d.Texture(a).pixels, np.uint8, (2, 2, 4)),
    "radiance": (lambda a: e3d.Environment(a).pixels, np.float32, (2, 4, 3)),
    "poses": (lambda a: e3d.InstancedMesh(e3d.box(), a).poses, np.float32, (2, 4)),
    "offsets": (lambda a: e3d.motion.MorphTarget(a).positions, np.float32, (3, 3)),
    "pose": (lambda a: e3d.Scene().add(translation=a).translation, np.float64, (3,)),
    "coefficients": (lambda a: e3d.LightProbe(a).coefficients, np.float64, (9, 3)),
}


@pytest.mark.parametrize("flag", (True, False))
@pytest.mark.parametrize("name", TAKEN)
def test_arrays_of_callers_stay_theirs(name, flag):
    take, dtype, shape = TAKEN[name]
    given = np.zeros(shape, dtype)
    given.setflags(write=flag)
    kept = take(given)
    assert given.flags.writeable == flag
    given.setflags(write=True)
    given[...] = 1
    assert not kept.any()


def test_what_cannot_be_written_to_is_not_copied():
    mesh = e3d.icosphere(subdivisions=4)
    assert e3d.Mesh(mesh.positions, mesh.faces).positions is mesh.positions
    texture = e3d.Texture(np.zeros((64, 64, 4), np.uint8))
    assert e3d.Texture(texture.pixels).pixels is texture.pixels
