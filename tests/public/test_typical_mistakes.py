"""What people write who come from other packages, or are in a hurry: none of it passes in silence.

A row is a call and words of the answer, which is an error or a warning.
"""

import inspect
import math
import warnings

import numpy as np
import pytest
from public.every_callable import MADE_ELSEWHERE
from public.hostile_calls import SIZE, camera, draw, mesh, scene
from public.public_names import public_things

import engine3d as e3d
from engine3d import linalg
from engine3d.base.foreign_names import _NAMES, foreign_names

BAD = np.array([(0, 0, math.nan), (1, 0, 0), (0, 1, 0)])


def node():
    return scene().nodes[0]


def assign(thing, name, value):
    return lambda: setattr(thing(), name, value)


def added(**arguments):
    return e3d.Scene().add(mesh(), **arguments)


MISTAKES = [
    # names of elsewhere
    (lambda: e3d.sphere(), "did you mean uv_sphere or icosphere"),
    (lambda: e3d.cube(), "did you mean box"),
    (lambda: e3d.rendr, "did you mean render"),
    (lambda: e3d.Walker, "did you mean navigation.Walker?"),
    (lambda: e3d.BoxColider, "did you mean colliders.BoxCollider?"),
    (lambda: e3d.OutOfMemoryError, "did you mean errors.OutOfMemoryError?"),
    (lambda: e3d.city, "did you mean worlds.city?"),
    (lambda: mesh().vertices, "did you mean positions"),
    (lambda: mesh().position, "did you mean positions"),
    (assign(mesh, "vertices", BAD), "did you mean positions"),
    (lambda: mesh().translate((1, 0, 0)), "node's translation"),
    (lambda: node().position, "did you mean translation"),
    (assign(node, "position", (1, 2, 3)), "did you mean translation"),
    (assign(node, "lookAt", (1, 2, 3)), "look_at"),
    (assign(node, "anything", 1), "no attribute 'anything'"),
    (assign(node, "translatoin", (1, 2, 3)), "did you mean translation"),
    (assign(lambda: e3d.Canvas((4, 4)), "pixel", 1), "did you mean pixels"),
    (lambda: node().visble, "no attribute 'visble'"),
    (lambda: scene().lights, "scene.nodes"),
    (assign(e3d.Scene, "bg_color", (1, 1, 1)), "did you mean background"),
    (assign(e3d.Material, "metalness", 1.0), "did you mean metallic"),
    (assign(e3d.PointLight, "position", (1, 2, 3)), "translation="),
    (assign(e3d.PerspectiveCamera, "fov", 60), "yfov, in radians"),
    (lambda: draw().rgb, "did you mean color"),
    (lambda: e3d.Material(metalness=1.0), "did you mean metallic"),
    (lambda: e3d.Material(colour=(1, 1, 1)), "did you mean color"),
    (lambda: e3d.PerspectiveCamera(fov=1.0), "yfov, in radians"),
    (lambda: e3d.PerspectiveCamera(near=1.0), "did you mean znear"),
    (lambda: e3d.PointLight(position=(1, 2, 3)), "translation="),
    (lambda: e3d.PerspectiveCamera(position=(1, 2, 3)), "engine3d.look_at"),
    (lambda: e3d.Mesh(vertices=BAD), "did you mean positions"),
    (lambda: e3d.Scene(bg_color=(1, 1, 1)), "did you mean background"),
    (lambda: added(position=(1, 2, 3)), "did you mean translation"),
    (lambda: e3d.render(mesh(), resolution=SIZE), "size=(width, height)"),
    (lambda: e3d.render(mesh(), tonemapping="aces"), "did you mean tone_mapping"),
    (lambda: e3d.render(mesh(), siz=SIZE), "did you mean size"),
    (lambda: e3d.RenderOptions(wirefram="only"), "did you mean wireframe"),
    (lambda: e3d.RenderOptions(tone="aces"), "did you mean tone_mapping"),
    (lambda: e3d.Look(grond=False), "did you mean ground"),
    (lambda: e3d.box(extents=(1, 1, 1)), "did you mean size"),
    (lambda: e3d.orbit((0, 0, 0), radius=3.0, azimuth=0.0), "did you mean distance"),
    (lambda: e3d.load_mesh("a.obj", formt="obj"), "did you mean format"),
    # degrees, and what is no number
    (lambda: added(euler=(90, 0, 0)), "radians"),
    (assign(node, "euler", (0, 45, 0)), "radians"),
    (lambda: e3d.orbit((0, 0, 0), 3.0, 90), "radians"),
    (lambda: e3d.orbit((0, 0, 0), 3.0, 0.0, 30), "radians"),
    (lambda: e3d.PerspectiveCamera(60), "numpy.radians"),
    (lambda: e3d.frame_scene(scene(), yfov=60), "numpy.radians"),
    (lambda: linalg.perspective(60, 1.0, 0.1, 9.0), "numpy.radians"),
    (lambda: e3d.SpotLight(outer_cone_angle=45), "numpy.radians"),
    (lambda: e3d.Mesh(np.eye(3), crease_angle=35), "numpy.radians"),
    (lambda: linalg.rotation_x(90), "radians"),
    (lambda: linalg.rotation_axis((0, 1, 0), 90), "radians"),
    (lambda: linalg.euler_to_quaternion((0, 0, 180)), "radians"),
    (assign(e3d.Scene, "environment_rotation", 180), "radians"),
    (lambda: e3d.Material(anisotropy_rotation=90), "radians"),
    (lambda: e3d.navigation.NavigationGrid(e3d.plane(), max_slope=40), "numpy.radians"),
    (lambda: e3d.Mesh(BAD, [[0, 1, 2]]), "1 of 3 positions are not finite"),
    (lambda: added(translation=(0, 0, math.nan)), "finite"),
    (lambda: e3d.render(scene(), (camera()[0], np.full((4, 4), math.nan))), "finite"),
    # wrong values
    (lambda: added(rotation=(0.1, 0, 0)), "euler="),
    (lambda: e3d.Renderer((8, 8), samples=8, antialiasing="ssaa"), "needs antialiasing='msaa'"),
    (
        lambda: e3d.uv_sphere(segments=12),
        "from pole to pole, not 12",
    ),
    (lambda: e3d.Renderer(8), "size must be (width, height), not 8"),
    (lambda: e3d.Renderer((8, 8)).render(5), "a mesh or points can be drawn, not int"),
    (lambda: e3d.Scene().add("model.obj"), "'model.obj'"),
    (lambda: e3d.Scene().add(mesh(), name=5), "name must be a str, not 5"),
    (assign(node, "visible", "no"), "visible must be True or False, not 'no'"),
    (lambda: e3d.Material(two_sided="yes"), "two_sided must be True or False"),
    (lambda: e3d.Look.studio(ground=None), "ground must be one of True, False, 'mirror', not None"),
    (lambda: e3d.Material(color="tab:blue"), "nor the name of a colour"),
    (lambda: e3d.Material(color="Oragne"), "did you mean orange?"),
    (lambda: e3d.Texture("brick.png"), "load_texture"),
    (lambda: e3d.load_mesh(5), "not a path"),
    (lambda: e3d.save_scene(mesh(), "a.glb"), "scene must be a Scene"),
    (lambda: e3d.save_mesh(scene(), "a.ply"), "mesh must be a Mesh"),
    (lambda: scene().remove(scene().find("nobody")), "find() returns"),
    (lambda: node().translation.__setitem__(0, 1.0), "assign all of it"),
    (lambda: e3d.render(e3d.Scene(background=None), size=SIZE).save("a.jpg"), "transparency"),
    (lambda: e3d.render(e3d.Scene(background=None), size=SIZE).encode("jpeg"), "transparency"),
    (lambda: e3d.datasets.random_camera(1, scene()), "generator must be a Generator, not 1"),
    (lambda: e3d.batch.run(["a.obj"], "out"), "Task"),
    (lambda: e3d.Canvas((9, 9)).triangle(1, 2, 3, (1, 2, 3)), "a must be (x, y), not 1"),
]


@pytest.mark.parametrize("number", range(len(MISTAKES)))
def test_a_mistake_is_told(number, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, words = MISTAKES[number]
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        try:
            call()
        except (e3d.Engine3DError, AttributeError, TypeError) as error:
            assert words in str(error)
            unknown = "no attribute" in str(error) or "unexpected keyword" in str(error)
            assert unknown or isinstance(error, e3d.Engine3DError)
            return
    assert any(words in str(w.message) for w in seen), "it passes in silence"
    assert all(issubclass(w.category, e3d.Engine3DWarning) for w in seen)


def test_turning_for_long_warns_once_a_line():
    turning = node()
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("default")
        for second in range(100):
            turning.euler = (0, second, 0)
    assert len(seen) == 1


CLASSES = {name: thing for name, thing in public_things().items() if inspect.isclass(thing)}


@pytest.mark.parametrize("name", sorted(_NAMES.keys() & CLASSES.keys()))
def test_foreign_names_are_not_ours_and_what_they_are_here_is(name):
    kind = CLASSES[name]
    parameters = inspect.signature(kind).parameters
    for foreign, here in foreign_names(kind).items():
        assert foreign not in parameters, foreign
        assert not here.isidentifier() or here in parameters or hasattr(kind, here), foreign


def test_asking_for_an_attribute_costs_no_hint(monkeypatch):
    """`getattr` with a default asks of cameras and lights for names that they do not have."""
    monkeypatch.setattr("difflib.get_close_matches", None)
    assert getattr(e3d.PointLight(), "name", "none") == "none"
    assert not hasattr(node(), "position") and not hasattr(mesh(), "vertices")
    assert not hasattr(e3d, "sphere")


def test_what_is_written_for_other_names_is_not_listed():
    assert "position" not in dir(node())


def test_modules_that_need_other_packages_come_by_their_names():
    assert e3d.golden.__name__ == "engine3d.apps.golden"
    assert e3d.compat.pyrender.__name__ == "engine3d.compat.pyrender"
    assert "notebook" not in e3d.__all__


def test_parts_of_a_pose_add_up():
    moved = node()
    moved.translation += (1, 2, 3)
    moved.translation -= (0, 0, 3)
    moved.scale *= 2
    moved.scale /= (1, 1, 2)
    moved.euler += (0, 0.5, 0)
    assert moved.translation.tolist() == [1, 2, 0] and moved.scale.tolist() == [2, 2, 1]
    assert moved.euler[1] == pytest.approx(0.5)


def test_signatures_and_modules_show_what_is_meant():
    tuples = [kind for kind in CLASSES.values() if issubclass(kind, tuple)]
    assert len(tuples) >= 6
    assert not [kind for kind in tuples if "ForwardRef" in str(inspect.signature(kind))]
    for module in (e3d.choices, e3d.errors):
        assert not {"Any", "annotations", "os", "sys", "warn"} & set(module.__all__)


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (0, 3, 2, 1)])
def test_a_hexahedron_is_never_inside_out(order):
    """Any side, and then the side across from it, in either sense."""
    sides = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])[list(order)]
    for axis in range(3):
        for first in (0.0, 1.0):
            ends = [np.insert(sides, axis, end, axis=1) for end in (first, 1.0 - first)]
            made = e3d.primitives.hexahedron(np.concatenate(ends))
            a, b, c = made.positions[made.faces].astype(np.float64).transpose(1, 0, 2)
            assert (np.cross(a, b) * c).sum() / 6 == pytest.approx(1.0)


def test_every_output_is_named_where_frames_are_asked_for():
    from engine3d.rendering.frame import OUTPUTS

    documented = e3d.RenderOptions.__doc__
    assert not [name for name in OUTPUTS if f"``{name}``" not in documented]


def swapped(word):
    """A word with two letters swapped near its middle."""
    middle = len(word) // 2
    return word[: middle - 1] + word[middle] + word[middle - 1] + word[middle + 1 :]


def keywords(thing):
    """What a callable takes as keywords alone or, if it passes none on, also by place."""
    parameters = inspect.signature(thing).parameters.values()
    passes_on = any(each.kind is each.VAR_KEYWORD for each in parameters)
    kinds = {inspect.Parameter.KEYWORD_ONLY} | (
        set() if passes_on else {inspect.Parameter.POSITIONAL_OR_KEYWORD}
    )
    return [each.name for each in parameters if each.kind in kinds and len(each.name) > 3]


CALLED = {
    name: thing
    for name, thing in public_things().items()
    if callable(thing) and name not in MADE_ELSEWHERE
    if not (inspect.isclass(thing) and issubclass(thing, (Exception, tuple)))
}


@pytest.mark.parametrize("name", sorted(CALLED))
def test_a_misspelt_keyword_is_answered_by_the_right_one(name):
    required = ["scene"] if name == "render" else []
    for word in keywords(CALLED[name]):
        wrong = swapped(word)
        if wrong != word:
            with pytest.raises(TypeError, match=f"{wrong}.*did you mean {word}"):
                CALLED[name](*required, **{wrong: None})
