"""`OffscreenRenderer` and its scene: pixels of Open3D's own, depths, cameras, materials."""

import numpy as np
import pytest

o3d = pytest.importorskip("open3d", exc_type=ImportError)

from compat import open3d_filament as filament  # noqa: E402

from engine3d.compat.open3d import rendering  # noqa: E402
from engine3d.errors import Engine3DWarning, FileAccessError, InvalidArgumentError  # noqa: E402

VECTORS = o3d.utility.Vector3dVector


def wall(z, size=1.0):
    """A square that faces +Z."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * size + (0, 0, z)
    mesh = o3d.geometry.TriangleMesh(
        VECTORS(corners), o3d.utility.Vector3iVector([[0, 1, 2], [0, 2, 3]])
    )
    mesh.compute_vertex_normals()
    return mesh


def picture(renderer):
    return np.asarray(renderer.render_to_image())


def looking_at_wall(shader="defaultUnlit", size=(48, 36), **values):
    renderer = rendering.OffscreenRenderer(*size)
    renderer.scene.add_geometry("wall", wall(0.0), filament.record(shader, **values))
    renderer.setup_camera(60.0, [0, 0, 0], [0, 0, 3], [0, 1, 0])
    return renderer


@pytest.mark.parametrize("name", filament.MEASURED)
def test_pixels_are_open3ds(name):
    drawn = picture(filament.stand(name))
    expected = [list(bytes.fromhex(one)) for one in filament.MEASURED[name].split()]
    got = np.array([drawn[place] for place in filament.PLACES], int)
    assert abs(got - expected).max() <= filament.APART.get(name, 9)


def test_depths_have_both_meanings():
    renderer = looking_at_wall()
    depth = np.asarray(renderer.render_to_depth_image())
    metres = np.asarray(renderer.render_to_depth_image(z_in_view_space=True))
    assert depth.dtype == metres.dtype == np.float32 and depth.shape == (36, 48)
    shows = np.isfinite(metres)
    assert np.allclose(metres[shows], 3.0, rtol=1e-6)
    assert np.allclose(depth[shows], 1.0 - 0.1 / 3.0, atol=1e-6)
    assert (depth[~shows] == 1.0).all() and not shows.all() and shows.any()


def test_glass_has_depths():
    renderer = looking_at_wall("defaultLitTransparency", base_color=[1, 1, 1, 0.5], has_alpha=True)
    assert np.isfinite(np.asarray(renderer.render_to_depth_image(True))).any()


def test_a_parallel_projection_has_open3ds_numbers():
    renderer = looking_at_wall()
    camera = renderer.scene.camera
    camera.set_projection(camera.Projection.Ortho, -2, 2, -1.5, 1.5, 1.0, 5.0)
    depth = np.asarray(renderer.render_to_depth_image())
    assert depth[18, 24] == pytest.approx((3.0 - 1.0) / (5.0 - 1.0))
    assert (np.isfinite(depth) & (depth < 1)).sum() == 24 * 24


def test_intrinsics_put_points_where_a_pinhole_does():
    renderer = rendering.OffscreenRenderer(64, 48)
    cloud = o3d.geometry.PointCloud(VECTORS([[0.33, -0.22, 4.0]]))
    renderer.scene.add_geometry("point", cloud, filament.record("defaultUnlit", point_size=1.0))
    matrix = np.array([[50.0, 0, 30.0], [0, 60.0, 20.0], [0, 0, 1]])
    renderer.setup_camera(matrix, np.eye(4), 64, 48)
    rows, columns = np.nonzero(np.isfinite(np.asarray(renderer.render_to_depth_image(True))))
    assert (rows, columns) == (int(60 * -0.22 / 4 + 20), int(50 * 0.33 / 4 + 30))
    as_object = o3d.camera.PinholeCameraIntrinsic(64, 48, matrix)
    before = renderer.scene.camera.get_projection_matrix()
    renderer.setup_camera(as_object, np.eye(4))
    assert np.array_equal(before, renderer.scene.camera.get_projection_matrix())


def test_the_camera_is_where_it_was_put():
    camera = rendering.Camera()
    camera.look_at([1, 2, 3], [4, 6, 3], [0, 0, 1])
    assert np.allclose(camera.get_model_matrix()[:3, 3], [4, 6, 3])
    assert np.allclose(camera.get_model_matrix()[:3, 2], [0.6, 0.8, 0])
    both = camera.get_view_matrix() @ camera.get_model_matrix()
    assert np.allclose(both, np.eye(4), atol=1e-6)
    camera.set_projection(40.0, 1.5, 0.2, 9.0, camera.FovType.Vertical)
    assert (camera.get_near(), camera.get_far(), camera.get_field_of_view()) == (0.2, 9.0, 40.0)
    other = rendering.Camera()
    other.copy_from(camera)
    assert np.array_equal(other.get_projection_matrix(), camera.get_projection_matrix())
    back = camera.unproject(32.0, 24.0, 0.5, 64, 48)
    assert np.allclose(np.cross(back - [4, 6, 3], [0.6, 0.8, 0]), 0, atol=1e-5)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda camera: camera.look_at([1, 1, 1], [1, 1, 1], [0, 1, 0]), "one point"),
        (lambda camera: camera.look_at([np.nan, 1, 1], [0, 0, 1], [0, 1, 0]), "center must be"),
        (lambda camera: camera.look_at([1, 1, 1], [0, np.inf, 1], [0, 1, 0]), "eye must be"),
        (lambda camera: camera.look_at([1, 1, 1], [0, 0, 1], [0, 1]), "up must be three"),
        (lambda camera: camera.set_projection(60.0, 1.0, 0.0, 9.0, camera.Vertical), "near_plane"),
        (lambda camera: camera.set_extrinsic(np.eye(3)), r"\(4, 4\)"),
        (lambda camera: camera.set_projection(np.zeros((3, 3)), 0.1, 9.0, 8, 6), "focal lengths"),
        (lambda camera: camera.set_projection(camera.Ortho, 1, 1, 0, 1, 0, 1), "differ"),
    ],
)
def test_wrong_cameras_are_refused(call, said):
    with pytest.raises(InvalidArgumentError, match=said):
        call(rendering.Camera())


def test_geometries_come_go_move_and_hide():
    renderer = looking_at_wall()
    scene, empty = renderer.scene, picture(rendering.OffscreenRenderer(48, 36))
    shown = picture(renderer)
    assert scene.has_geometry("wall") and not np.array_equal(shown, empty)
    scene.show_geometry("wall", False)
    assert np.array_equal(picture(renderer), empty) and not scene.geometry_is_visible("wall")
    scene.show_geometry("wall", True)
    pose = np.eye(4)
    pose[:3, 3] = 0, 0, 1
    scene.set_geometry_transform("wall", pose)
    assert np.array_equal(scene.get_geometry_transform("wall"), pose)
    assert np.asarray(renderer.render_to_depth_image(True))[18, 24] == pytest.approx(2.0)
    scene.modify_geometry_material(
        "wall", filament.record("unlitSolidColor", base_color=[1, 0, 0, 1])
    )
    red = picture(renderer)[18, 24]
    assert red[0] > 200 > 60 > red[1:].max()
    scene.remove_geometry("wall")
    assert not scene.has_geometry("wall") and np.array_equal(picture(renderer), empty)
    scene.add_geometry("wall", wall(0.0), filament.record())
    with pytest.warns(Engine3DWarning, match="added already"):
        scene.add_geometry("wall", wall(0.0), filament.record())
    scene.clear_geometry()
    assert not scene.has_geometry("wall") and scene.bounding_box.is_empty()


def test_what_was_added_is_a_copy():
    renderer, mesh = rendering.OffscreenRenderer(48, 36), wall(0.0)
    renderer.scene.add_geometry("wall", mesh, filament.record("defaultUnlit"))
    renderer.setup_camera(60.0, [0, 0, 0], [0, 0, 3], [0, 1, 0])
    before = picture(renderer)
    mesh.translate([0.5, 0, 0])
    assert np.array_equal(picture(renderer), before)


def test_sizes_of_points_and_widths_of_lines_are_their_own():
    renderer = rendering.OffscreenRenderer(64, 48)
    for x, size in ((-0.5, 3.0), (0.5, 9.0)):
        cloud = o3d.geometry.PointCloud(VECTORS([[x, 0, 0]]))
        record = filament.record("defaultUnlit", point_size=size)
        renderer.scene.add_geometry(f"point {size}", cloud, record)
    lines = o3d.geometry.LineSet(
        VECTORS([[-1, 0.8, 0], [1, 0.8, 0]]), o3d.utility.Vector2iVector([[0, 1]])
    )
    renderer.scene.add_geometry("line", lines, filament.record("unlitLine", line_width=6.0))
    renderer.setup_camera(60.0, [0, 0, 0], [0, 0, 3], [0, 1, 0])
    shows = np.isfinite(np.asarray(renderer.render_to_depth_image(True)))
    assert shows[16:].sum() == 9 + 81
    # Open3D's wide lines are as wide as half the width over the tangent of half the view.
    assert abs(shows[:16].sum(axis=0).max() - 6.0 * 0.5 / np.tan(np.pi / 6)) < 1


def test_normals_and_depths_as_colours():
    renderer = looking_at_wall("normals")
    straight = picture(renderer)[18, 24]
    turned = np.array([[0, 0, 1.0, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
    renderer.scene.set_geometry_transform("wall", turned)
    renderer.setup_camera(60.0, [0, 0, 0], [3, 0, 0], [0, 1, 0])
    sideways = picture(renderer)[18, 24]
    assert straight[2] > straight[0] and sideways[0] > sideways[2]
    deep = looking_at_wall("depthValue")
    deep.scene.view.set_post_processing(False)
    digits = picture(deep)[18, 24].astype(int)
    value = (digits * (65536, 256, 1)).sum() / 16777215.0
    assert value == pytest.approx(1.0 - 0.1 / 3.0, abs=1e-4)


def test_images_lie_as_in_open3d():
    """The first row of an image of a material is at v = 1; of a background at the top."""
    pixels = np.zeros((16, 16, 3), np.uint8)
    pixels[:8] = (255, 0, 0)
    pixels[8:] = (0, 0, 255)
    mesh = wall(0.0)
    mesh.triangle_uvs = o3d.utility.Vector2dVector([[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]])
    mesh.paint_uniform_color([1, 1, 1])
    renderer = rendering.OffscreenRenderer(48, 36)
    image = o3d.geometry.Image(pixels)
    renderer.scene.add_geometry("wall", mesh, filament.record("defaultUnlit", albedo_img=image))
    renderer.setup_camera(60.0, [0, 0, 0], [0, 0, 3], [0, 1, 0])
    drawn = picture(renderer)
    assert drawn[12, 24, 0] > 200 > drawn[12, 24, 2] and drawn[24, 24, 2] > 200 > drawn[24, 24, 0]
    renderer.scene.clear_geometry()
    renderer.scene.set_background([0, 1, 0, 1], image)
    behind = picture(renderer)
    assert behind[5, 24, 0] > 200 and behind[30, 24, 2] > 200 and behind[5, 2, 1] > 200


def test_the_box_holds_all_that_was_added():
    renderer = rendering.OffscreenRenderer(8, 8)
    renderer.scene.add_geometry("a", filament.ball(), filament.record())
    other = filament.ball().translate([3, 0, 0])
    renderer.scene.add_geometry("b", other, filament.record())
    assert np.allclose(renderer.scene.bounding_box.max_bound, [4, 1, 1])
    model = rendering.TriangleMeshModel()
    model.meshes = [
        rendering.TriangleMeshModel.MeshInfo(filament.ball().translate([0, 0, 8]), "ball", 0)
    ]
    model.materials = [filament.record()]
    renderer.scene.add_model("model", model)
    assert renderer.scene.has_geometry("model")
    assert np.allclose(renderer.scene.bounding_box.max_bound, [4, 1, 9])
    renderer.scene.remove_geometry("model")
    assert not renderer.scene.has_geometry("model")


def test_lights_change_and_go():
    renderer = filament.stand("lamp")
    low, lit = renderer.scene.scene, picture(renderer)
    low.update_light_intensity("lamp", 400000.0)
    assert picture(renderer)[120, 160].sum() > lit[120, 160].sum()
    low.update_light_color("lamp", [1, 0, 0])
    assert picture(renderer)[120, 160, 0] > picture(renderer)[120, 160, 1]
    low.remove_light("lamp")
    assert picture(renderer)[120, 160].max() == 0
    low.add_spot_light("spot", [1, 1, 1], [0, 0, 3], [0, 0, -1], 1e6, 10.0, 0.1, 0.2, True)
    low.add_directional_light("flat", [1, 1, 1], [0, -1, 0], 50000.0, False)
    assert picture(renderer)[120, 160].max() > 0
    with pytest.warns(Engine3DWarning, match="no light 'lamp'"):
        low.update_light_falloff("lamp", 1.0)


def test_what_is_not_drawn_is_named():
    renderer = rendering.OffscreenRenderer(8, 8)
    with pytest.warns(Engine3DWarning, match="ground plane"):
        renderer.scene.show_ground_plane(True, renderer.scene.scene.GroundPlane.XZ)
    with pytest.warns(Engine3DWarning, match="shader unlitGradient is drawn as"):
        renderer.scene.add_geometry("a", wall(0), filament.record("unlitGradient"))
    with pytest.warns(Engine3DWarning, match="map clearcoat_img"):
        image = o3d.geometry.Image(np.zeros((2, 2, 3), np.uint8))
        renderer.scene.add_geometry("b", wall(0), filament.record(clearcoat_img=image))
    with pytest.raises(FileAccessError, match="nowhere"):
        renderer.scene.scene.set_indirect_light("nowhere")


def test_sizes_and_axes():
    with pytest.raises(InvalidArgumentError, match="width"):
        rendering.OffscreenRenderer(0, 8)
    renderer = looking_at_wall()
    before = picture(renderer)
    renderer.scene.show_axes(True)
    assert not np.array_equal(picture(renderer), before)
    renderer.scene.show_axes(False)
    assert np.array_equal(picture(renderer), before)


HOSTILE = (
    {"base_roughness": -1.0, "base_metallic": 9.0, "base_color": [9.0, -9.0, np.nan, 9.0]},
    {"base_roughness": np.nan, "base_reflectance": 1.0, "point_size": 0.0},
    {"shader": "defaultLitSSR", "absorption_distance": -1.0, "thickness": -1.0},
    {"point_size": 1e6, "line_width": -1.0},
)


@pytest.mark.parametrize("values", HOSTILE)
def test_any_numbers_of_a_material_are_drawn(values):
    cloud = o3d.geometry.PointCloud(VECTORS(np.random.default_rng(0).random((9, 3)) + 1e5))
    renderer = rendering.OffscreenRenderer(16, 12)
    record = filament.record(**{"shader": "defaultLit", **values})
    renderer.scene.add_geometry("ball", filament.ball(), record)
    renderer.scene.add_geometry("far", cloud, record)
    assert picture(renderer).shape == (12, 16, 3)


@pytest.mark.parametrize("wrong", [None, 5])
def test_what_is_no_geometry_is_refused(wrong):
    with pytest.raises(InvalidArgumentError, match="a geometry of Open3D is needed"):
        rendering.OffscreenRenderer(8, 8).scene.add_geometry("a", wrong, filament.record())


@pytest.mark.parametrize("wrong", [None, {}, "defaultLit"])
def test_what_is_no_material_is_refused(wrong):
    scene = rendering.OffscreenRenderer(8, 8).scene
    scene.add_geometry("there", wall(0.0), filament.record())
    for call in (scene.update_material, lambda it: scene.modify_geometry_material("there", it)):
        with pytest.raises(InvalidArgumentError, match="material must be a MaterialRecord"):
            call(wrong)
    with pytest.raises(InvalidArgumentError, match="material must be a MaterialRecord"):
        scene.add_geometry("new", wall(0.0), wrong)


@pytest.mark.parametrize(
    "call",
    [
        lambda: rendering.OffscreenRenderer("a", 3),
        lambda: rendering.OffscreenRenderer(float("nan"), 4),
        lambda: rendering.OffscreenRenderer(8, 8).scene.set_background("red"),
        lambda: rendering.OffscreenRenderer(8, 8).scene.scene.set_sun_light("down", [1] * 3, 1.0),
    ],
)
def test_what_is_no_number_is_an_error_of_the_argument(call):
    with pytest.raises(InvalidArgumentError):
        call()
