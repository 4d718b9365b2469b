"""What pictures in pyrender's manner show: light, alpha, depth, order, flags and their quirks."""

import threading

import numpy as np
import pytest
from compat.pyrender_scenes import ball, code, drawn, lit, matte, middle, pose, seen, square

import engine3d.compat.pyrender as pyrender
from engine3d.compat.pyrender import RenderFlags as Flags


@pytest.fixture
def one_sample(monkeypatch):
    monkeypatch.setattr(pyrender.settings, "_samples", 1)


def test_light_is_that_of_the_shader(one_sample):
    metal = pyrender.MetallicRoughnessMaterial(
        baseColorFactor=(0.9, 0.5, 0.2, 1.0), metallicFactor=0.6, roughnessFactor=0.4
    )
    scene = seen(square(2.0, metal), ambient=0.0)
    tilted = np.eye(4)
    tilted[:3, :3] = [[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]  # shines along (0, 0.8, -0.6)
    scene.add(pyrender.DirectionalLight(intensity=2.5), pose=tilted)
    color, _ = drawn(scene, size=(33, 33))
    expected = 2.5 * lit(
        np.array([0.9, 0.5, 0.2]),
        0.4,
        0.6,
        np.array([0, 0, 1.0]),
        np.array([0, 0, 1.0]),
        np.array([0, -0.8, 0.6]),
    )
    assert np.abs(middle(color) - code(expected)).max() <= 1


def test_lamps_fade_with_the_square_of_the_distance_and_have_no_range(one_sample):
    scene = seen(square(2.0, matte()), ambient=0.0)
    scene.add(pyrender.PointLight(intensity=12.0, range=0.5), pose=pose(z=2.0))
    color, _ = drawn(scene, size=(33, 33))
    axis = np.array([0, 0, 1.0])
    assert np.abs(middle(color) - code(12 / 4 * lit(1.0, 1.0, 0.0, axis, axis, axis))).max() <= 1


def test_whole_numbers_are_of_0_to_255():
    assert pyrender.Scene(bg_color=[1, 1, 1]).bg_color[:3] == pytest.approx(1 / 255)
    assert pyrender.Scene(bg_color=[1.0, 1, 1]).bg_color[:3] == pytest.approx(1)
    assert pyrender.Scene(ambient_light=0.4).ambient_light == pytest.approx([0.4] * 3)
    assert pyrender.DirectionalLight(color=[255, 0, 51]).color == pytest.approx([1, 0, 0.2])
    assert pyrender.Scene(bg_color=[0.5, 0.5, 0.5]).bg_color[3] == 1.0


def test_only_the_nearest_four_lights_of_a_kind_shine(one_sample):
    scene = seen(
        square(
            1.0,
            matte(),
        ),
        ambient=0.0,
    )
    for distance in (1.0, 1.1, 1.2, 1.3):
        scene.add(pyrender.DirectionalLight(intensity=0.2), pose=pose(z=distance))
    four = drawn(scene)[0]
    for distance in (9.0, 10.0):
        scene.add(pyrender.DirectionalLight(intensity=5.0), pose=pose(z=distance))
    assert np.array_equal(drawn(scene)[0], four)
    shadowed = drawn(scene, Flags.SHADOWS_DIRECTIONAL)[0]  # as many as there are textures
    assert middle(shadowed)[0] > middle(four)[0]


def test_vertex_colors_multiply_after_light_and_are_not_decoded(one_sample):
    tinted = np.tile([0.5, 0.25, 1.0, 1.0], (4, 1))
    color, _ = drawn(seen(square(2.0, matte(), colors=tinted)))
    assert np.abs(middle(color) - code(np.array([0.5, 0.25, 1.0]))).max() <= 1


def test_emission_counts_squared(one_sample):
    color, _ = drawn(seen(square(2.0, matte(emissiveFactor=[0.5, 0.2, 0.0])), ambient=0.0))
    assert np.abs(middle(color) - code(np.array([0.25, 0.04, 0.0]))).max() <= 1


def test_flat_shows_factors_as_they_are(one_sample):
    color, _ = drawn(seen(square(2.0, matte((0.5, 0.2, 1.0, 1.0))), ambient=0.0), Flags.FLAT)
    assert np.abs(middle(color) - [128, 51, 255]).max() <= 1


def test_textures_are_srgb_and_upright(one_sample):
    image = np.zeros((2, 2, 3), np.uint8)
    image[0] = 188  # the upper row
    mesh = square(2.0, matte(baseColorTexture=image), texcoord_0=[(0, 0), (1, 0), (1, 1), (0, 1)])
    color, _ = drawn(seen(mesh), size=(64, 64))
    assert abs(int(color[21, 32, 0]) - code(0.5028)) <= 2  # 188 is half of the light
    assert color[43, 32, 0] < 20
    flat, _ = drawn(seen(mesh), Flags.FLAT, size=(64, 64))
    assert abs(int(flat[21, 32, 0]) - 188) <= 2


@pytest.mark.parametrize("samples", [1, 4])
def test_what_is_blended_lies_over_what_is_farther_by_the_origins_of_nodes(monkeypatch, samples):
    monkeypatch.setattr(pyrender.settings, "_samples", samples)
    red = square(2.0, matte((1.0, 0.0, 0.0, 0.5), alphaMode="BLEND"))
    green = square(2.0, matte((0.0, 1.0, 0.0, 0.25), alphaMode="BLEND"))
    blue = square(2.0, matte((0.0, 0.0, 1.0, 1.0)))
    things = [(green, pose(z=0.5)), (red, pose(z=1.0)), (blue, pose(z=-1.0))]
    color, depth = drawn(seen(*things), Flags.RGBA)
    # In codes: green over blue, then red over both; alpha is blended alike.
    assert np.abs(middle(color)[:3].astype(int) - [128, 32, 96]).max() <= 1
    assert middle(depth) == pytest.approx(2.0, rel=1e-5)  # what is blended has depth, too
    # Of what is nearer than its origin says, the order is that of the origins.
    near_origin_far = square(2.0, matte((1.0, 0.0, 0.0, 0.5), alphaMode="BLEND"))
    near_origin_far.primitives[0].positions = near_origin_far.primitives[0].positions + [0, 0, 2]
    things = [(green, pose(z=0.5)), (near_origin_far, pose(z=-2.0))]
    assert np.abs(middle(drawn(seen(*things))[0]).astype(int) - [96, 64, 0]).max() <= 1


def test_alpha_of_what_is_opaque_is_written_as_it_is():
    color, _ = drawn(seen(square(5.0, matte((1.0, 1.0, 1.0, 0.3)))), Flags.RGBA)
    assert color[0, 0].tolist() == [255, 255, 255, 76]
    color, _ = drawn(seen(square(0.2), background=[0.2, 0.4, 0.6, 0.0]), Flags.RGBA)
    assert color[0, 0].tolist() == [51, 102, 153, 0]


def test_backs_are_culled_unless_the_material_or_a_flag_says_otherwise():
    turned = np.diag([-1.0, 1.0, -1.0, 1.0])
    one_sided, two_sided = square(5.0), square(5.0, matte(doubleSided=True))
    assert not drawn(seen((one_sided, turned)))[1].any()
    assert drawn(seen((one_sided, turned)), Flags.SKIP_CULL_FACES)[1].all()
    assert drawn(seen((two_sided, turned)))[1].all()
    for flags in (Flags.DEPTH_ONLY, Flags.SEG):  # these cull always
        scene = seen((two_sided, turned))
        nodes = dict.fromkeys(scene.mesh_nodes, 9)
        result = drawn(scene, flags | Flags.SKIP_CULL_FACES, seg_node_map=nodes)
        assert not (result if flags == Flags.DEPTH_ONLY else result[1]).any()


def test_mirrors_turn_triangles_over_as_opengl_counts_them():
    mirrored = np.diag([-1.0, 1.0, 1.0, 1.0])
    assert not drawn(seen((square(2.0), mirrored)))[1].any()


def test_depth_is_metric_and_0_where_nothing_is():
    scene = seen((square(0.5), pose(z=1.0)))
    depth = drawn(scene, Flags.DEPTH_ONLY)
    assert depth.dtype == np.float32 and middle(depth) == pytest.approx(2.0, rel=1e-6)
    assert depth[0, 0] == 0.0
    for far in (None, 100.0, 1e12):
        lens = pyrender.PerspectiveCamera(yfov=np.pi / 2, znear=0.001, zfar=far)
        depth = drawn(seen((square(3.0), pose(z=-7.0)), camera=lens), Flags.DEPTH_ONLY)
        assert middle(depth) == pytest.approx(10.0, rel=1e-5)


def test_orthographic_depth_is_metric_or_pyrenders(monkeypatch):
    lens = pyrender.OrthographicCamera(xmag=1.0, ymag=1.0, znear=0.05, zfar=10.0)
    scene = seen((square(2.0), pose(z=1.0)), camera=lens)
    assert middle(drawn(scene, Flags.DEPTH_ONLY)) == pytest.approx(2.0, rel=1e-6)
    monkeypatch.setattr(pyrender.settings, "orthographic_depth", "pyrender")
    z = 2 * (2.0 - 0.05) / (10.0 - 0.05) - 1
    expected = 2 * 0.05 * 10.0 / (10.05 - z * 9.95)
    assert middle(drawn(scene, Flags.DEPTH_ONLY)) == pytest.approx(expected, rel=1e-6)


def test_segments_are_of_the_listed_nodes_alone():
    scene = seen()
    near = scene.add(square(0.5), pose=pose(z=1.0))
    far = scene.add(square(2.0), pose=pose(z=-1.0))
    color, depth = drawn(scene, Flags.SEG, seg_node_map={near: 7, far: (1, 2, 3)})
    assert middle(color).tolist() == [7, 7, 7] and color[12, 11].tolist() == [1, 2, 3]
    assert set(map(tuple, color.reshape(-1, 3).tolist())) <= {(7,) * 3, (1, 2, 3), (0, 0, 0)}
    color, depth = drawn(scene, Flags.SEG, seg_node_map={far: 9})
    assert middle(color)[0] == 9 and middle(depth) == pytest.approx(4.0)


def test_instances_points_lines_and_wires():
    poses = np.stack([pose(x=-1.0), pose(x=1.0)])
    mesh = square(0.4)
    mesh.primitives[0].poses = poses
    color, depth = drawn(seen(mesh), size=(64, 48))
    assert depth[24, 32] == 0 and depth[24, 24] > 0 and depth[24, 40] > 0
    points = pyrender.Mesh.from_points(np.zeros((1, 3)), colors=[[1.0, 0.0, 0.0]])
    renderer = pyrender.OffscreenRenderer(32, 24, point_size=3.0)
    assert (renderer.render(seen(points), Flags.DEPTH_ONLY) > 0).sum() == 9
    line = pyrender.Primitive([(-1, 0.1, 0), (1, 0.1, 0)], mode=pyrender.GLTF.LINES)
    assert (drawn(seen(pyrender.Mesh([line])), Flags.DEPTH_ONLY) > 0).any(axis=1).sum() == 1
    wire = drawn(seen(square(1.0, matte())), Flags.ALL_WIREFRAME, size=(64, 48))[1] > 0
    assert wire.any() and wire[24, 40] == 0  # between the edges
    strip = pyrender.Primitive(
        [(-1, -1, 0), (1, -1, 0), (-1, 1, 0), (1, 1, 0)], mode=pyrender.GLTF.TRIANGLE_STRIP
    )
    fan = pyrender.Primitive(
        [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], mode=pyrender.GLTF.TRIANGLE_FAN
    )
    whole = drawn(seen(square(1.0)), Flags.DEPTH_ONLY) > 0
    for primitive in (strip, fan):
        found = drawn(seen(pyrender.Mesh([primitive])), Flags.DEPTH_ONLY) > 0
        assert np.array_equal(found, whole)


def test_shadows_of_directional_lights_and_spots(one_sample):
    scene = seen(square(3.0, matte()), (square(0.5, matte()), pose(z=1.0)), ambient=0.0)
    for light in (
        pyrender.DirectionalLight(intensity=3.0),
        pyrender.SpotLight(intensity=30.0, outerConeAngle=1.0, innerConeAngle=0.9),
    ):
        tilt = np.eye(4)
        tilt[:3, :3] = [[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]]
        tilt[:3, 3] = 3.0, 0.0, 4.0
        node = scene.add(light, pose=tilt)
        plain, _ = drawn(scene, size=(64, 48))
        flags = Flags.SHADOWS_DIRECTIONAL | Flags.SHADOWS_SPOT
        shadowed, _ = drawn(scene, flags, size=(64, 48))
        darker = (shadowed[..., 0] < 5) & (plain[..., 0] > 50)
        assert 20 < darker.sum() < 600
        assert np.abs(plain.astype(int) - shadowed)[~darker].max() < 200
        scene.remove_node(node)
    scene.add(pyrender.PointLight())
    with pytest.raises(NotImplementedError):
        drawn(scene, Flags.SHADOWS_ALL)


def test_an_aspect_ratio_stretches_the_picture():
    lens = pyrender.PerspectiveCamera(yfov=np.pi / 2, aspectRatio=1.0)
    depth = drawn(seen(square(1.0), camera=lens), Flags.DEPTH_ONLY, size=(60, 30))
    assert (depth > 0).any(axis=0).sum() == 2 * (depth > 0).any(axis=1).sum()


def test_any_projection_of_a_derived_camera_is_drawn():
    class Weak(pyrender.Camera):
        def get_projection_matrix(self, width=None, height=None):
            return np.diag([0.5, 0.5, -1.0, 1.0])

    camera = Weak(znear=pyrender.camera.DEFAULT_Z_NEAR)
    scene = pyrender.Scene()
    scene.add(square(1.0))
    scene.add(camera)
    _, depth = drawn(scene, size=(32, 32))
    assert (depth > 0).sum() == 16 * 16


def test_pictures_do_not_depend_on_threads_renderers_and_what_was_drawn_before():
    scene = seen(ball(1.0, matte((0.7, 0.5, 0.3, 1.0))), (ball(0.4), pose(x=1.0, z=0.5)))
    scene.add(pyrender.DirectionalLight(intensity=2.0), pose=pose(z=3.0))
    color, depth = drawn(scene, size=(96, 72))
    assert not color.flags.writeable and depth.flags.writeable  # as pyrender's are
    first, second = pyrender.OffscreenRenderer(8, 8), pyrender.OffscreenRenderer(96, 72)
    first.render(scene)
    first.delete()  # leaves the other alone
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(drawn(scene, size=(96, 72)))) for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    found.append(second.render(scene))
    second.viewport_width = 20
    assert second.render(scene)[0].shape == (72, 20, 3)
    assert len(found) == 4
    for other in found:
        assert np.array_equal(other[0], color) and np.array_equal(other[1], depth)
    with pytest.raises(RuntimeError):
        first.render(scene)


def test_four_samples_smooth_edges_and_leave_depth_at_the_centres():
    scene = seen(ball(1.0, matte()))
    color, depth = drawn(scene, size=(64, 48))
    codes = set(color[..., 0].ravel().tolist())
    assert {0, 255} < codes and any(0 < one < 255 for one in codes)
    pyrender.settings.samples = 1
    try:
        sharp, same = drawn(scene, size=(64, 48))
    finally:
        pyrender.settings.samples = 4
    assert np.array_equal(depth, same)
    assert set(sharp[..., 0].ravel().tolist()) == {0, 255}


def test_depth_is_at_the_centre_or_at_pyrenders_sample(monkeypatch):
    slope = ramp()
    depths = {}
    for place in ("centre", "pyrender"):
        monkeypatch.setattr(pyrender.settings, "depth_place", place)
        depths[place] = drawn(slope, size=(24, 24))[1]
        alone = drawn(slope, pyrender.RenderFlags.DEPTH_ONLY, size=(24, 24))
        assert np.array_equal(alone, depths[place])
        listed = dict.fromkeys(slope.mesh_nodes, 9)
        segments = drawn(slope, pyrender.RenderFlags.SEG, (24, 24), seg_node_map=listed)
        assert np.array_equal(segments[1], depths["centre"])
    rows, columns = np.mgrid[:24, :24] + 0.5

    def expected(across, down):  # of the plane z = x + y/2, from z = 3 with a field of view of 90°
        x, y = (columns + across) / 12 - 1, 1 - (rows + down) / 12
        return 3 / (1 + x + y / 2)

    both = (depths["centre"] > 0) & (depths["pyrender"] > 0)
    assert both.sum() > 60
    for place, offset in (("centre", (0, 0)), ("pyrender", (-1 / 8, 3 / 8))):
        assert np.allclose(depths[place][both], expected(*offset)[both], rtol=1e-5), place


def ramp():
    """A slope, z = x + y/2, seen from z = 3."""
    corners = np.array([(x, y, x + y / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    primitive = pyrender.Primitive(corners, indices=[(0, 1, 2), (0, 2, 3)])
    return seen(pyrender.Mesh([primitive]))


def test_changes_of_a_scene_show_in_the_next_picture():
    scene = seen()
    node = scene.add(square(0.5, matte()))
    renderer = pyrender.OffscreenRenderer(32, 24)
    assert middle(renderer.render(scene)[0])[0] == 255
    node.mesh.primitives[0].material.baseColorFactor = [0.0, 0.0, 1.0, 1.0]
    assert middle(renderer.render(scene)[0]).tolist() == [0, 0, 255]
    scene.set_pose(node, pose(x=2.0))
    assert middle(renderer.render(scene)[1]) == 0
    node.matrix = np.eye(4)
    node.mesh = square(0.1, matte())
    small = (renderer.render(scene)[1] > 0).sum()
    node.mesh.primitives[0].positions = node.mesh.primitives[0].positions * 4
    assert (renderer.render(scene)[1] > 0).sum() > small
    node.mesh.is_visible = False
    assert not renderer.render(scene)[1].any()
    scene.remove_node(node)
    assert not renderer.render(scene)[1].any()


def test_vertices_that_are_no_numbers_are_left_out():
    places = np.array([(-1, 0, 0), (np.nan, 0, 0), (1, np.inf, 0), (1, 0, 0)])
    for mode in range(7):
        scene = seen(pyrender.Mesh([pyrender.Primitive(places, mode=mode)]))
        assert (drawn(scene)[1] > 0).sum() <= 12, mode


def test_a_scene_without_a_camera_is_an_error():
    with pytest.raises(ValueError, match="camera"):
        drawn(pyrender.Scene())
