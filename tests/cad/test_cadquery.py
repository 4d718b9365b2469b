"""Workplanes, assemblies and sketches of CadQuery, against what the library itself says."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.scenes.other_libraries import library_of, scene_of_library
from engine3d.measuring import measure

cq = pytest.importorskip("cadquery", exc_type=ImportError)


def plate():
    return cq.Workplane().box(40, 60, 20).faces(">Z").workplane().hole(20)


def test_workplanes_are_drawn():
    assert library_of(plate()) == "cadquery"
    found = measure(scene_of_library(plate()))
    assert found.watertight
    assert found.volume == pytest.approx(plate().val().Volume(), rel=0.02)
    assert e3d.render(plate(), size=(64, 48)).color.std() > 5


def test_workplanes_of_several_shapes_show_all():
    pins = cq.Workplane().rarray(5, 5, 3, 2).circle(1).extrude(4, combine=False)
    scene = scene_of_library(pins)
    assert measure(scene).volume == pytest.approx(6 * math.pi * 4, rel=0.03)


def test_assemblies_keep_names_colours_and_places():
    inner = cq.Assembly(name="inner", loc=cq.Location((0, 0, 10)))
    inner.add(cq.Workplane().sphere(3), name="ball", color=cq.Color("red"))
    outer = cq.Assembly(name="outer", loc=cq.Location((100, 0, 0)))
    outer.add(plate(), name="plate", color=cq.Color(0.1, 0.2, 0.9, 0.5))
    outer.add(inner, loc=cq.Location((0, 0, 30)))
    scene = scene_of_library(outer)
    assert [node.name for node in scene.nodes] == ["plate", "ball"]
    body, ball = scene.nodes
    np.testing.assert_allclose(body.bounds.mean(axis=0), (100, 0, 0), atol=1e-4)
    expected = outer.toCompound().BoundingBox()
    found = measure(scene).bounds
    np.testing.assert_allclose(found[1], (expected.xmax, expected.ymax, expected.zmax), atol=0.3)
    assert body.object.materials[0].alpha_mode == "blend"
    assert ball.object.materials[0].color[0] > 0.9


def test_sketches_edges_and_lists():
    assert measure(scene_of_library(cq.Sketch().rect(4, 2))).area == pytest.approx(8)
    assert measure(scene_of_library(cq.Sketch().rect(4, 2).vertices())).area == pytest.approx(8)
    assert scene_of_library(cq.Sketch().segment((0, 0), (2, 0))).nodes[0].object.lines.size
    (node,) = scene_of_library(cq.Edge.makeCircle(3)).nodes
    assert len(node.object.lines) > 12
    shapes = [cq.Workplane().box(1, 1, 1), cq.Solid.makeBox(2, 2, 2)]
    assert measure(scene_of_library(shapes)).volume == pytest.approx(9)
    on_plane = cq.Workplane().placeSketch(cq.Sketch().circle(1)).extrude(2)
    assert measure(scene_of_library(on_plane)).volume == pytest.approx(2 * math.pi, rel=0.03)


@pytest.mark.parametrize("empty", ["Location", "Plane", "Workplane"])
def test_what_has_no_shape_is_refused(empty):
    thing = {"Location": cq.Location, "Plane": cq.Plane.XY, "Workplane": cq.Workplane}[empty]()
    with pytest.raises(e3d.InvalidArgumentError, match="can be drawn"):
        e3d.render(thing)
