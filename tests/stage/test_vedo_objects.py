"""Objects of vedo are drawn as what their data sets and actors say."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.scenes.other_libraries import scene_of_library

pytest.importorskip("pyvista", exc_type=ImportError)
vedo = pytest.importorskip("vedo", exc_type=ImportError)


def test_a_mesh_keeps_its_faces_places_and_colour():
    mesh = vedo.Cube().pos(3, 0, 0).c((10, 200, 90)).alpha(0.5)
    (node,) = scene_of_library(mesh).nodes
    assert np.allclose(node.object.bounds, [(2.5, -0.5, -0.5), (3.5, 0.5, 0.5)])
    assert len(node.object.faces) == 12
    expected = e3d.Material(color=(10, 200, 90, 128), alpha_mode="blend")
    assert node.object.materials[0].color == expected.color
    assert node.object.materials[0].alpha_mode == "blend"


def test_points_lines_groups_and_plotters():
    places = np.random.default_rng(1).random((20, 3))
    points, line = vedo.Points(places), vedo.Line((0, 0, 0), (1, 1, 1))
    assert len(scene_of_library(points).nodes[0].object.points) == 20
    assert len(scene_of_library(line).nodes[0].object.lines) == 1
    assert len(scene_of_library(vedo.Assembly(vedo.Cube(), vedo.Sphere())).nodes) == 2
    assert len(scene_of_library([points, vedo.Cube()]).nodes) == 2
    assert (e3d.render(points, size=(32, 24)).color[..., :3] > 0).any()


def test_what_shows_nothing_in_space_is_refused():
    for thing in (vedo.Volume(np.ones((4, 4, 4))), vedo.Text2D("a")):
        told = f"this {type(thing).__name__} of vedo holds nothing that can be drawn"
        with pytest.raises(e3d.InvalidArgumentError, match=told):
            e3d.render(thing)
