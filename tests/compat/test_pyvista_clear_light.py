"""Clear faces of plotters are lit as solid ones: physical materials, cones, layers of one mesh."""

import numpy as np
import pytest
from compat.plotters import SIZE, plotter, without_opengl

import engine3d as e3d

pv = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)

NEARLY = 0.999


@pytest.fixture(autouse=True)
def drawn_without_opengl():
    without_opengl()
    import engine3d.compat.pyvista  # noqa: F401


def spot(**options):
    usual = {"position": (0, 0, 3), "focal_point": (0, 0, 0), "positional": True}
    return pv.Light(**usual | options)


def drawn(mesh, light, *, peels=False, surroundings=None, **options):
    """Return a picture as numbers; without antialiasing, as clear faces have none."""
    pl = plotter(lighting="none")
    pl.add_mesh(mesh, **options)
    pl.add_light(light)
    if surroundings is not None:
        pl.set_environment_texture(surroundings)
    pl.disable_anti_aliasing()
    pl.renderer.SetUseDepthPeeling(peels)
    pl.view_xy()
    return pl.engine3d.screenshot().astype(float)


def plane(height=0.0):
    return pv.Plane(center=(0, 0, height), i_size=5, j_size=5, i_resolution=1, j_resolution=1)


FADING = (0.2, 0.1, 0.3)


@pytest.mark.parametrize(("cone", "fading"), [(10, (1, 0, 0)), (10, FADING), (90, FADING)])
@pytest.mark.parametrize("is_flat", [True, False])
def test_cones_and_attenuation_count_for_clear_faces(fading, cone, is_flat):
    mesh = plane() if is_flat else pv.Sphere(radius=2).clip("z", invert=False)
    light = spot(cone_angle=cone, attenuation_values=fading)
    look = {"color": (200, 120, 60), "specular": 0.5, "peels": not is_flat}
    solid = drawn(mesh, light, **look)
    clear = drawn(mesh, light, opacity=NEARLY, **look)
    off = np.abs(clear - solid).max(-1)
    assert solid.max() > 50 and (off > 2).mean() < 0.003


def test_a_clear_physical_material_is_no_matt_one():
    grey = np.full((8, 16, 3), (200, 160, 90), np.uint8)
    look = {"pbr": True, "metallic": 0.7, "roughness": 0.3, "color": (200, 120, 60)}
    given = pv.Sphere(), pv.Light(position=(1, 2, 3))
    for surroundings in (None, pv.Texture(grey)):
        told = look | {"surroundings": surroundings, "peels": True}
        off = np.abs(drawn(*given, opacity=NEARLY, **told) - drawn(*given, **told)).max(-1)
        assert (off > 2).mean() < 0.003


def test_layers_of_one_mesh_are_lit_each():
    """Two squares that are one mesh, in light that fades: the mean, or one over the other."""
    light = spot(cone_angle=90, attenuation_values=(0, 0, 0.3))
    look = {"color": "white", "reset_camera": False}

    def middle(mesh, **options):
        return drawn(mesh, light, **look, **options)[SIZE[1] // 2, SIZE[0] // 2 + 3]

    low, high = middle(plane(-1.0)), middle(plane(1.0))
    assert high[0] - low[0] > 30
    both = plane(-1.0).merge(plane(1.0))
    under = middle(plane(50.0), opacity=0.0)  # behind the camera: the background
    cover = 1 - 0.5 * 0.5
    expected = (low + high) / 2 * cover + under * (1 - cover)
    assert np.allclose(middle(both, opacity=0.5), expected, atol=2)
    expected = high * 0.5 + low * 0.25 + under * (1 - cover)
    assert np.allclose(middle(both, opacity=0.5, peels=True), expected, atol=2)


def test_clear_points_are_lit_where_they_stand():
    points = pv.PolyData(np.random.default_rng(1).uniform(-1, 1, (30, 3)))
    look = {"render_points_as_spheres": True, "point_size": 12, "color": (200, 120, 60)}
    light = spot(cone_angle=20)
    solid = drawn(points, light, **look)
    clear = drawn(points, light, opacity=NEARLY, peels=True, **look)
    assert (np.abs(clear - solid).max(-1) > 2).mean() < 0.01


def test_clear_points_in_no_order_are_told():
    with pytest.warns(e3d.Engine3DWarning, match="clear lines and points are drawn as matt"):
        drawn(
            pv.PolyData(np.eye(3)), spot(cone_angle=20), opacity=0.5, render_points_as_spheres=True
        )


def test_layers_beyond_count_are_told(monkeypatch):
    from engine3d.compat.pyvista import _clear_layers

    monkeypatch.setattr(_clear_layers, "_MOST_SHEETS", 2)
    planes = pv.merge([plane(0.1 * number) for number in range(5)])
    with pytest.warns(e3d.Engine3DWarning, match="only the nearest"):
        drawn(planes, spot(cone_angle=20), opacity=0.5)


def test_scenes_say_that_lights_lose_their_cones():
    pl = plotter(lighting="none")
    pl.add_mesh(plane())
    pl.add_light(spot(cone_angle=10))
    with pytest.warns(e3d.Engine3DWarning, match="without the cones and the attenuation"):
        pl.engine3d.scene()
