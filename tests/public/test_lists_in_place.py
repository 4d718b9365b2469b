"""Lists and dicts that things show may be changed in place: checked, seen, and nobody else's."""

import copy
import pickle

import numpy as np
import pytest
from public.test_copies import COPIED, REFUSED, moved

import engine3d as e3d
from engine3d.base.checked_containers import DICT_CHANGES, LIST_CHANGES

RED, GREEN, BLUE = (
    e3d.Material(color=color, unlit=True) for color in ((255, 0, 0), (0, 255, 0), (0, 0, 255))
)
CAMERA = (e3d.OrthographicCamera(1, znear=-5, zfar=5), np.eye(4))
#: What does not change a list or dict.
READS = {
    *("copy", "count", "index", "get", "items", "keys", "values", "fromkeys"),
    *dir(tuple),
    *("__reversed__", "__or__", "__ror__"),
}
#: Lists and dicts that nothing is drawn or written from as they are, or that hold anything.
FREE = {"warnings", "extras", "report", "stats"}


def two_squares():
    """Two squares side by side, of which the left is made of the second material."""
    mesh = e3d.Mesh(
        [[-1, -1, 0], [0, -1, 0], [0, 1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]],
        [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]],
        materials=[RED, GREEN],
        material_ids=[1, 1, 0, 0],
    )
    scene = e3d.Scene()
    scene.add(mesh)
    other = e3d.Mesh([[5, 5, 0], [6, 5, 0], [5, 6, 0]], [[0, 1, 2]], materials=[BLUE])
    scene.add(other)
    return scene, mesh


def colors(renderer, scene):
    color = renderer.render(scene, CAMERA).color
    return color[5, 1, :3].tolist(), color[5, 6, :3].tolist()


def test_every_method_that_changes_is_checked():
    for kind, changes in ((list, LIST_CHANGES), (dict, DICT_CHANGES)):
        assert {*dir(kind)} - {*dir(object)} - READS == {*changes}


@pytest.mark.parametrize(
    "change",
    (
        lambda materials: materials.pop(),
        lambda materials: materials.clear(),
        lambda materials: materials.remove(RED),
        lambda materials: materials.__delitem__(0),
        lambda materials: materials.__setitem__(slice(None), [RED]),
        lambda materials: materials.__setitem__(0, "red"),
        lambda materials: materials.append(None),
        lambda materials: materials.extend([BLUE, 3]),
        lambda materials: materials.insert(0, RED.color),
        lambda materials: materials.__imul__(0),
        lambda materials: materials.__iadd__(["green"]),
    ),
)
def test_a_change_that_faces_do_not_bear_changes_nothing(change):
    scene, mesh = two_squares()
    with e3d.Renderer((8, 8)) as renderer:
        before = colors(renderer, scene)
        with pytest.raises(e3d.errors.InvalidArgumentError, match=r"(?i)material"):
            change(mesh.materials)
        assert mesh.materials == [RED, GREEN]
        assert colors(renderer, scene) == before == ([0, 255, 0], [255, 0, 0])


def test_the_error_names_mesh_and_index():
    _, mesh = two_squares()
    mesh.name = "squares"
    with pytest.raises(e3d.errors.InvalidArgumentError, match=r"'squares'.* index 1.* 1 materials"):
        mesh.materials.pop()


def test_materials_that_are_changed_in_place_are_drawn():
    scene, mesh = two_squares()
    with e3d.Renderer((8, 8)) as renderer:
        for change, expected in (
            (lambda m: m.reverse(), ([255, 0, 0], [0, 255, 0])),
            (lambda m: m.append(BLUE), ([255, 0, 0], [0, 255, 0])),
            (lambda m: m.pop(0), ([0, 0, 255], [255, 0, 0])),
            (lambda m: m.__setitem__(1, GREEN), ([0, 255, 0], [255, 0, 0])),
            (lambda m: m.sort(key=id), None),
            (lambda m: m.__setitem__(slice(None), [BLUE, RED, GREEN]), ([255, 0, 0], [0, 0, 255])),
            (lambda m: m.remove(GREEN), ([255, 0, 0], [0, 0, 255])),
        ):
            version = mesh.version
            change(mesh.materials)
            assert mesh.version > version
            seen = colors(renderer, scene)
            assert expected in (None, seen)
            assert seen == colors(e3d.Renderer((8, 8)), scene)
        mesh.material_ids = np.zeros(4, int)
        mesh.materials.pop()
        assert colors(renderer, scene) == ([0, 0, 255], [0, 0, 255])


@pytest.mark.parametrize("way", (copy.copy, copy.deepcopy, lambda m: pickle.loads(pickle.dumps(m))))
def test_lists_of_copies_are_their_own(way):
    _, mesh = two_squares()
    mesh.groups = {"left": [0, 1]}
    other = way(mesh)
    other.materials.append(BLUE)
    other.groups["right"] = [2, 3]
    assert len(mesh.materials) == 2 and list(mesh.groups) == ["left"]
    with pytest.raises(e3d.errors.InvalidArgumentError):
        other.materials.clear()
    assert len(other.materials) == 3
    assert type(way(mesh.materials)) is list and type(way(mesh.groups)) is dict


def test_groups_and_animations_are_checked():
    _, mesh = two_squares()
    mesh.groups["left"] = [0, 1]
    assert mesh.groups["left"].dtype == np.int32 and not mesh.groups["left"].flags.writeable
    for name, faces in (("all", [4]), (3, [0]), ("half", 0.5), ("none", None)):
        with pytest.raises(e3d.errors.InvalidArgumentError):
            mesh.groups[name] = faces
    assert list(mesh.groups) == ["left"]
    clip = e3d.motion.AnimationClip([moved()])
    scene = e3d.Scene()
    scene.animations["turn"] = clip
    for name, value in (("turn", 3), (3, clip)):
        with pytest.raises(e3d.errors.InvalidArgumentError):
            scene.animations[name] = value
    with pytest.raises(e3d.errors.InvalidArgumentError):
        scene.animations = [clip]
    assert scene.animations == {"turn": clip}


@pytest.mark.parametrize("name", sorted({*COPIED, *REFUSED} - {"World"}))
def test_every_list_that_is_shown_is_checked_or_free(name, monkeypatch):
    """A list or dict that a thing shows twice as the same object can be changed in place."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    thing = {**COPIED, **REFUSED}[name]()
    for attribute in set(dir(thing)) - FREE:
        value = None if attribute.startswith("_") else getattr(thing, attribute, None)
        if isinstance(value, (list, dict, set)) and getattr(thing, attribute) is value:
            with pytest.raises((e3d.errors.InvalidArgumentError, TypeError)):
                value.update({1: 2}) if isinstance(value, dict) else value.append(object())
