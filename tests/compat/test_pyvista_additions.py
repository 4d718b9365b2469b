"""Every ``add_…`` of a plotter: what it adds is drawn, or a warning says what is not."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from compat.plotters import plotter, without_opengl

import engine3d as e3d

pv = pytest.importorskip("pyvista", exc_type=ImportError)
# What a widget of splines returns before VTK's module of its class is loaded is an object without
# methods, for whoever asks for that class later, too.
pytest.importorskip("vtkmodules.vtkCommonComputationalGeometry")
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "pyvista.md").read_text("utf-8")


def _ball():
    ball = pv.Sphere(theta_resolution=12, phi_resolution=12)
    ball["height"] = ball.points[:, 2]
    return ball


def _grid():
    grid = pv.ImageData(dimensions=(5, 5, 5))
    grid["values"] = np.arange(125.0)
    return grid


def _nothing(*_values, **_names):
    pass


#: What each is called with; a name alone is called with nothing.
GIVEN = {
    "add_actor": lambda: [pv.Actor(pv.DataSetMapper(_ball()))],
    "add_affine_transform_widget": None,  # takes what `add_mesh` returns
    "add_arrows": lambda: [np.zeros((1, 3)), np.ones((1, 3))],
    "add_background_image": None,  # a file
    "add_box_widget": lambda: [_nothing],
    "add_chart": lambda: [pv.Chart2D()],
    "add_checkbox_button_widget": lambda: [_nothing],
    "add_composite": lambda: [pv.MultiBlock([_ball()])],
    "add_floor": lambda: ["+z"],  # the cube hides the one below
    "add_legend": lambda: [[["a", "red"]]],
    "add_light": None,  # shows only on something
    "add_line_widget": lambda: [_nothing],
    "add_lines": lambda: [np.array([[0.0, 0, 0], [1, 1, 1]])],
    "add_mesh": lambda: [_ball()],
    "add_mesh_clip_box": lambda: [_ball()],
    "add_mesh_clip_plane": lambda: [_ball()],
    "add_mesh_isovalue": lambda: [_grid()],
    "add_mesh_slice": lambda: [_ball()],
    "add_mesh_slice_orthogonal": lambda: [_grid()],
    "add_mesh_slice_spline": lambda: [_grid()],
    "add_mesh_threshold": lambda: [_grid()],
    "add_orientation_widget": lambda: [_ball()],
    "add_plane_widget": lambda: [_nothing],
    "add_point_labels": lambda: [np.zeros((1, 3)), ["a"]],
    "add_point_scalar_labels": lambda: [_ball(), "height"],
    "add_points": lambda: [_ball().points],
    "add_radio_button_widget": lambda: [_nothing, "group"],
    "add_ruler": lambda: [(0, 0, 0), (1, 1, 1)],
    "add_scalar_bar": None,  # of a mesh
    "add_silhouette": lambda: [_ball()],
    "add_slider_widget": lambda: [_nothing, (0, 1)],
    "add_sphere_widget": lambda: [_nothing],
    "add_spline_widget": lambda: [_nothing],
    "add_text": lambda: ["a"],
    "add_text_slider_widget": lambda: [_nothing, ["a", "b"]],
    "add_title": lambda: ["a"],
    "add_volume": lambda: [_grid()],
    "add_volume_clip_plane": lambda: [_grid()],
}
#: Those that show nothing by themselves.
SILENT = {
    *("add_camera3d_widget", "add_key_event", "add_measurement_widget"),
    *("add_on_render_callback", "add_timer_event"),
}
NAMES = sorted(
    name
    for name in dir(pv.Plotter)
    if name.startswith("add_") and GIVEN.get(name, _nothing) is not None and name not in SILENT
)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_added_is_drawn_or_named(name):
    without_opengl()
    pl = plotter()
    pl.add_mesh(pv.Cube(center=(2, 0, 0), x_length=0.5), show_scalar_bar=False)
    before = pl.engine3d.screenshot()
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        getattr(pl, name)(*GIVEN.get(name, list)())
        is_drawn = (pl.engine3d.screenshot() != before).any()
    pl.close()
    undrawn = [str(one.message) for one in told if one.category is e3d.Engine3DWarning]
    assert is_drawn or undrawn
    for sentence in undrawn:
        named = re.fullmatch(r"engine3d does not draw (.+)", sentence)[1]
        words = named.split(" (")[0]
        assert "vtk" not in words, "a class of VTK is no name that a user knows"
        assert words in PAGE


@pytest.mark.parametrize(
    "effect", ["enable_eye_dome_lighting", "enable_ssao", "add_blurring", "enable_depth_of_field"]
)
def test_effects_are_named(effect):
    without_opengl()
    pl = plotter()
    pl.add_mesh(pv.Cube())
    getattr(pl, effect)()
    with pytest.warns(e3d.Engine3DWarning, match="does not draw") as told:
        pl.engine3d.screenshot()
    named = str(told[0].message).removeprefix("engine3d does not draw ").split(" (")[0]
    assert named in PAGE and named != "the effect"
