"""``plotter.engine3d``: what VTK's rules say of a pixel, the same bytes, what is told."""

import io

import numpy as np
import pytest
from compat.plotters import SIZE, plane_plotter, plotter, without_opengl
from PIL import Image

import engine3d as e3d

pv = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)


@pytest.fixture(autouse=True)
def drawn_without_opengl():
    without_opengl()
    from engine3d.compat import pyvista as door

    return door


def middle(pl):
    return pl.engine3d.screenshot()[SIZE[1] // 2, SIZE[0] // 2 + 3].tolist()


@pytest.mark.parametrize("color", [(255, 99, 71), (0, 0, 128), (12, 200, 99)])
def test_an_unlit_colour_is_kept(color):
    assert middle(plane_plotter(color=color)) == list(color)


@pytest.mark.parametrize(("ambient", "diffuse"), [(0.0, 0.5), (0.3, 0.4)])
def test_unlit_light_is_ambient_and_diffuse(ambient, diffuse):
    expected = round(200 * (ambient + diffuse))
    assert (
        middle(plane_plotter(color=(200,) * 3, ambient=ambient, diffuse=diffuse))
        == [pytest.approx(expected, abs=1)] * 3
    )


def test_a_headlight_shows_matt_surfaces_by_the_cosine():
    pl = plotter(lighting="none")
    pl.add_light(pv.Light(light_type="headlight"))
    pl.add_mesh(pv.Plane(direction=(0, np.sin(0.7), np.cos(0.7))), color=(200, 100, 50))
    pl.enable_parallel_projection()
    pl.view_xy()
    assert np.allclose(middle(pl), np.array([200, 100, 50]) * np.cos(0.7), atol=1)


def test_clear_colours_are_the_mean_weighted_by_alpha():
    """Two planes of alpha 0.5 and 0.25, red before blue, over white."""
    pl = plotter(lighting="none")
    pl.add_mesh(pv.Plane(center=(0, 0, 0.2)), color="red", opacity=0.5, lighting=False)
    pl.add_mesh(pv.Plane(), color="blue", opacity=0.25, lighting=False)
    pl.enable_parallel_projection()
    pl.view_xy()
    cover = 1 - 0.5 * 0.75
    mean = np.array([255 * 0.5, 0, 255 * 0.25]) / 0.75
    assert np.allclose(middle(pl), mean * cover + 255 * (1 - cover), atol=1)
    pl.renderer.SetUseDepthPeeling(True)  # PyVista asks OpenGL first, unless `install` was called
    peeled = np.array([255, 0, 0]) * 0.5 + np.array([0, 0, 255]) * 0.25 * 0.5
    assert np.allclose(middle(pl), peeled + 255 * (1 - cover), atol=1)


@pytest.mark.parametrize("kind", ["points", "cells"])
@pytest.mark.parametrize("cmap", ["viridis", ["red", "green", "blue"], "gray_r"])
def test_scalars_have_the_colours_of_the_table(kind, cmap):
    plane = pv.Plane(i_resolution=1, j_resolution=1)
    target = plane.point_data if kind == "points" else plane.cell_data
    target["v"] = np.full(4 if kind == "points" else 1, 0.7)
    pl = plotter(lighting="none")
    options = {"scalars": "v", "clim": [0, 1], "show_scalar_bar": False, "lighting": False}
    actor = pl.add_mesh(plane, cmap=cmap, **options)
    pl.view_xy()
    expected = actor.mapper.lookup_table.map_value(0.7)[:3]
    assert np.allclose(middle(pl), np.array(expected) * 255, atol=1)


def test_edges_lie_on_the_faces():
    pl = plane_plotter(color="white", show_edges=True, edge_color="red", line_width=6)
    picture = pl.engine3d.screenshot()
    is_red = (picture == (255, 0, 0)).all(-1)
    left = np.flatnonzero((picture[SIZE[1] // 2] != 255).any(-1))[0]
    across = is_red[SIZE[1] // 2, left : left + 12]
    assert across[:3].any()
    assert 2 <= across.sum() <= 5  # half of the line: the other half would be outside


def test_pixels_are_the_mean_of_their_samples_light():
    """An edge of black on white that covers half of each pixel of a column."""
    pl = plane_plotter(color="black")
    codes = set(np.unique(pl.engine3d.screenshot()).tolist())
    mean = [round(255 * (1 - k / 4) ** (1 / 2.2)) for k in range(5)]
    assert codes <= set(mean)


def test_depth_is_the_distance_along_the_view_axis():
    pl = plotter()
    pl.add_mesh(pv.Plane(i_size=4, j_size=4))
    pl.camera_position = [(0, 0, 3), (0, 0, 0), (0, 1, 0)]
    depth = pl.engine3d.render().depth
    assert np.allclose(depth[depth > 0], 3.0, rtol=1e-5)
    assert depth[SIZE[1] // 2, SIZE[0] // 2] > 0


def test_far_coordinates_draw_the_same():
    def picture(offset):
        pl = plotter()
        ball = pv.Sphere()
        ball.points = ball.points.astype(float) + offset
        pl.add_mesh(ball, show_edges=True)
        return pl.engine3d.screenshot().astype(int)

    difference = np.abs(picture((0, 0, 0)) - picture((5e5, 4.2e6, 100)))
    assert difference.mean() < 0.5


def crowded():
    pl = plotter(shape=(1, 2))
    ball = pv.Sphere()
    ball["z"] = ball.points[:, 2]
    pl.add_mesh(ball, scalars="z", specular=0.5, smooth_shading=True, show_edges=True)
    pl.add_axes()
    pl.subplot(0, 1)
    pl.add_mesh(pv.Cube(), opacity=0.4, color="blue")
    pl.add_mesh(pv.Icosphere(radius=0.3), pbr=True, metallic=0.5, color="gold")
    pl.add_points(np.eye(3), render_points_as_spheres=True, point_size=9)
    pl.add_text("text", font_size=8)
    return pl


def test_the_same_bytes_with_every_backend_and_threads(monkeypatch):
    pl = crowded()
    expected = pl.engine3d.screenshot()
    for backend in e3d.backends():
        monkeypatch.setenv("ENGINE3D_BACKEND", backend)
        for threads in ("1", "3"):
            monkeypatch.setenv("ENGINE3D_THREADS", threads)
            assert np.array_equal(pl.engine3d.screenshot(), expected), (backend, threads)


def test_drawing_leaves_the_plotter_as_it_was():
    pl = plotter()
    pl.add_mesh(pv.Sphere(radius=0.1))
    pl.engine3d.screenshot()
    assert pl._first_time
    assert not pl.renderer.camera.is_set
    pl.add_mesh(pv.Sphere(center=(5, 0, 0)), color="red")
    both = pl.engine3d.screenshot()
    fresh = plotter()
    fresh.add_mesh(pv.Sphere(radius=0.1))
    fresh.add_mesh(pv.Sphere(center=(5, 0, 0)), color="red")
    assert np.array_equal(both, fresh.engine3d.screenshot())


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_sizes(scale):
    pl = plotter()
    pl.add_mesh(pv.Cube())
    assert pl.engine3d.screenshot(scale=scale).shape == (SIZE[1] * scale, SIZE[0] * scale, 3)
    assert pl.engine3d.render(window_size=(31, 17)).size == (31, 17)
    assert tuple(pl.window_size) == SIZE


def test_backgrounds():
    pl = plotter()
    pl.add_mesh(pv.Sphere(radius=0.01))
    pl.set_background("red", top="blue")
    column = pl.engine3d.screenshot()[:, 0].astype(int)
    assert (np.diff(column[:, 0]) >= 0).all()
    assert (np.diff(column[:, 2]) <= 0).all()
    clear = pl.engine3d.screenshot(transparent_background=True)
    assert clear[0, 0, 3] == 0
    assert clear[..., 3].max() == 255


@pytest.mark.parametrize("name", ["a.png", "a.jpg", "a.tiff", "a.bmp", "a"])
def test_files(tmp_path, name):
    pl = plotter()
    pl.add_mesh(pv.Cube())
    pixels = pl.engine3d.screenshot(tmp_path / name)
    written = next(tmp_path.iterdir())
    assert written.name == (name if "." in name else "a.png")
    assert Image.open(written).size == SIZE
    buffer = io.BytesIO()
    assert pl.engine3d.screenshot(buffer, return_img=False) is None
    assert np.array_equal(np.asarray(Image.open(buffer)), pixels)


def test_wrong_arguments():
    pl = plotter()
    pl.add_mesh(pv.Cube())
    for options in ({"scale": 0}, {"window_size": (3,)}, {"window_size": "x"}, {"filename": 7}):
        with pytest.raises(e3d.InvalidArgumentError, match=next(iter(options))):
            pl.engine3d.screenshot(**options)
    with pytest.raises(e3d.InvalidArgumentError, match="suffix"):
        pl.engine3d.screenshot("a.gif")
    pl.close()
    with pytest.raises(e3d.InvalidArgumentError, match="closed"):
        pl.engine3d.screenshot()


def test_meshes_without_anything_to_see():
    pl = plotter()
    pl.add_mesh(pv.PolyData(np.full((3, 3), np.nan), faces=[3, 0, 1, 2]))
    pl.add_mesh(pv.PolyData(np.zeros((2, 3)), lines=[2, 0, 1]), color="k")
    pl.add_actor(pv.Actor())
    assert (pl.engine3d.screenshot() == 255).all()


def test_what_is_not_drawn_is_named():
    pl = plotter()
    pl.add_mesh(pv.Cube())
    pl.add_volume(pv.Wavelet(extent=(0, 4, 0, 4, 0, 4)), show_scalar_bar=False)
    pl.enable_eye_dome_lighting()
    with pytest.warns(e3d.errors.Engine3DWarning, match="volumes.*vtkEDLShading"):
        pl.engine3d.screenshot()
    alone = plotter()
    chart = pv.Chart2D()
    chart.line([0, 1], [0, 1])
    alone.add_chart(chart)
    with pytest.raises(e3d.InvalidArgumentError, match="charts"):
        alone.engine3d.screenshot()


def test_a_scene_stands_where_the_plotter_looks():
    pl = plotter()
    pl.add_mesh(pv.Sphere(center=(3, 2, 1)), color="red")
    scene = pl.engine3d.scene()
    assert np.allclose(scene.bounds.mean(0), (3, 2, 1), atol=1e-3)
    picture = e3d.render(scene, size=SIZE, look="plain").color
    shown = pl.engine3d.screenshot()
    is_ball = (picture[..., 1] < 200), (shown[..., 1] < 200)
    assert (is_ball[0] & is_ball[1]).sum() > 0.95 * (is_ball[0] | is_ball[1]).sum()
