"""Real pictures through the public face: outputs, modes, colours, cameras, lights, changes."""

import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg
from engine3d.rendering.frame import OUTPUTS

BACKENDS = e3d.backends()
MODES = ["lit", "unlit", "random", "depth", "normal", "face_id", "object_id", "overdraw"]
SIZE = 32


@pytest.fixture(params=BACKENDS)
def renderer(request):
    return Renderer((SIZE, SIZE), backend=request.param, threads=2)


@pytest.fixture
def front():
    """A camera at z = 3 that sees 2 x 2 units at z = 0, 16 pixels a unit."""
    return e3d.PerspectiveCamera(2 * math.atan(1 / 3), znear=1, zfar=5), linalg.translation(
        (0, 0, 3)
    )


def square(**options):
    """A 1 x 1 square at z = 0 that faces +Z: columns and rows 8 to 23 of the picture."""
    return e3d.Mesh(
        [[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]],
        [[0, 1, 2], [0, 2, 3]],
        **{"uvs": [[0, 0], [1, 0], [1, 1], [0, 1]], **options},
    )


def scene_of(*objects, **options):
    scene = e3d.Scene(**options)
    for obj in objects:
        scene.add(obj)
    return scene


def inside():
    """Where the square is."""
    mask = np.zeros((SIZE, SIZE), bool)
    mask[8:24, 8:24] = True
    return mask


# ---- Outputs ------------------------------------------------------------------------------------


def test_outputs_of_a_square(renderer, front):
    scene = e3d.Scene()
    scene.add(e3d.PointLight())
    node = scene.add(square())
    frame = renderer.render(scene, front, outputs=tuple(OUTPUTS))
    seen = inside()
    for name, (dtype, channels) in OUTPUTS.items():
        array = getattr(frame, name)
        assert array.dtype == dtype
        assert array.shape == ((SIZE, SIZE, channels) if channels else (SIZE, SIZE)), name
    np.testing.assert_array_equal(frame.depth, np.where(seen, np.float32(3), 0))
    # z_ndc = (f + n) / (f - n) - 2fn / ((f - n) d) at distance d = 3
    np.testing.assert_allclose(frame.ndc_depth[seen], 1.5 - 10 / 12, rtol=1e-6)
    assert np.isposinf(frame.ndc_depth[~seen]).all()
    np.testing.assert_array_equal(frame.object_id, np.where(seen, node.id, -1))
    np.testing.assert_array_equal(frame.instance_id, np.where(seen, 0, -1))
    np.testing.assert_array_equal(frame.material_id, np.where(seen, 0, -1))
    assert set(np.unique(frame.face_id)) == {-1, 0, 1}
    np.testing.assert_array_equal(frame.albedo, np.repeat(seen[..., None], 3, axis=2))
    np.testing.assert_array_equal(frame.normal[seen], [[0, 0, 1]] * 256)
    np.testing.assert_array_equal(frame.world_normal[seen], [[0, 0, 1]] * 256)
    np.testing.assert_allclose(frame.barycentric[seen].sum(axis=-1), 1, rtol=1e-6)
    for name in ("normal", "position", "world_normal", "world_position", "uv", "barycentric"):
        assert not getattr(frame, name)[~seen].any(), name


def test_positions_and_uvs_are_where_the_pixel_looks(renderer, front):
    frame = renderer.render(scene_of(square()), front, outputs=("world_position", "position", "uv"))
    centers = (np.arange(8, 24) + 0.5 - 16) / 16
    x, y = np.meshgrid(centers, -centers)
    seen = inside()
    world = frame.world_position[seen].reshape(16, 16, 3)
    np.testing.assert_allclose(world[..., 0], x, atol=1e-6)
    np.testing.assert_allclose(world[..., 1], y, atol=1e-6)
    np.testing.assert_allclose(world[..., 2], 0, atol=1e-6)
    np.testing.assert_allclose(frame.position[seen], world.reshape(-1, 3) - [0, 0, 3], atol=1e-6)
    uv = frame.uv[seen].reshape(16, 16, 2)
    np.testing.assert_allclose(uv[..., 0], x + 0.5, atol=1e-6)
    np.testing.assert_allclose(uv[..., 1], y + 0.5, atol=1e-6)


def test_only_what_is_asked_for(renderer, front):
    frame = renderer.render(scene_of(square()), front, outputs=["depth"])
    assert frame.outputs == ("depth",)
    with pytest.raises(e3d.errors.MissingOutputError):
        _ = frame.color


BAD_OUTPUTS = (), (None,), (1,), ([],), (np.array(["a", "b"]),), (np.array(["color"]),), "color"


@pytest.mark.parametrize("outputs", BAD_OUTPUTS, ids=repr)
def test_outputs_that_are_no_names_are_refused_by_every_frame(front, outputs):
    scene = scene_of(square())
    with Renderer((SIZE, SIZE)) as renderer:
        for _ in range(2):
            with pytest.raises(e3d.InvalidArgumentError, match="outputs"):
                renderer.render(scene, front, outputs=outputs)
            renderer.render(scene, front)


def test_outputs_may_change_between_frames_and_so_may_their_size(front):
    scene, names = scene_of(square()), ["depth"]
    with Renderer((SIZE, SIZE)) as renderer:
        renderer.render(scene, front, outputs=names)
        names[0] = "uv"
        assert renderer.render(scene, front, outputs=names).uv.shape == (SIZE, SIZE, 2)
        renderer.resize((SIZE, 2 * SIZE))
        assert renderer.render(scene, front).color.shape[:2] == (2 * SIZE, SIZE)


def test_ids_tell_nodes_instances_and_materials_apart(renderer, front):
    red, blue = e3d.Material(color=(1, 0, 0)), e3d.Material(color=(0, 0, 1))
    mesh = square(materials=[red, blue], material_ids=[1, 0])
    scene = e3d.Scene()
    scene.add(translation=(9, 9, 9))
    instances = e3d.InstancedMesh(mesh, [[-0.5, 0, 0, 0.5], [0.5, 0, 0, 0.5]])
    node = scene.add(instances)
    outputs = ("object_id", "instance_id", "material_id", "face_id", "albedo")
    frame = renderer.render(scene, front, outputs=outputs)
    assert set(np.unique(frame.object_id)) == {-1, node.id}
    assert set(np.unique(frame.instance_id[:, :16])) == {-1, 0}
    assert set(np.unique(frame.instance_id[:, 16:])) == {-1, 1}
    seen = frame.object_id >= 0
    np.testing.assert_array_equal(frame.material_id[seen], 1 - frame.face_id[seen])
    np.testing.assert_array_equal(frame.albedo[frame.material_id == 1][:, 2], 1)
    np.testing.assert_array_equal(frame.albedo[frame.material_id == 0][:, 0], 1)


def test_stats(renderer, front):
    stats = renderer.render(scene_of(square(), square()), front).stats
    assert stats["backend"] == renderer.backend
    assert stats["draws"] == 2
    assert stats["triangles"] == 4
    assert stats["ms_total"] >= 0


@pytest.mark.parametrize("backend", BACKENDS)
def test_rasterize_agrees_with_the_renderer(backend, front):
    mesh = e3d.uv_sphere(1.2, (12, 7))
    camera, pose = front
    clip_from_world = linalg.multiply(camera.projection((SIZE, SIZE)), linalg.inverse(pose))
    clip = np.c_[mesh.positions, np.ones(len(mesh.positions))] @ clip_from_world.T
    result = e3d.rasterization.rasterize(
        clip, mesh.faces, (SIZE, SIZE), cull="back", backend=backend
    )
    frame = render(scene_of(mesh), front, size=(SIZE, SIZE), backend=backend, outputs=("face_id",))
    np.testing.assert_array_equal(result.face_id, frame.face_id)
    assert np.isposinf(result.depth[result.face_id < 0]).all()


# ---- Colours ------------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("color_space", ["srgb", "linear"])
def test_background_is_the_same_in_each_mode(mode, color_space):
    renderer = Renderer((4, 4), color_space=color_space)
    frame = renderer.render(e3d.Scene(background=(10, 128, 250)), mode=mode)
    assert (frame.color == (10, 128, 250, 255)).all()


def test_no_background_is_transparent(renderer, front):
    frame = renderer.render(scene_of(square(), background=None), front)
    np.testing.assert_array_equal(frame.color[..., 3], np.where(inside(), 255, 0))
    assert not frame.color[~inside()].any()


@pytest.mark.parametrize("color_space", ["srgb", "linear"])
def test_8_bit_colours_come_back(front, color_space):
    mesh = square(materials=[e3d.Material(color=(200, 100, 3))])
    renderer = Renderer((SIZE, SIZE), color_space=color_space)
    frame = renderer.render(scene_of(mesh), front, mode="unlit")
    assert (frame.color[16, 16] == (200, 100, 3, 255)).all()


@pytest.mark.parametrize("color_space", ["srgb", "linear"])
@pytest.mark.parametrize("filter", ["nearest", "bilinear", "trilinear"])
def test_an_unlit_texture_at_its_size_gives_its_bytes(renderer, front, color_space, filter):
    pixels = np.random.default_rng(1).integers(0, 256, (16, 16, 3), np.uint8)
    texture = e3d.Texture(pixels, filter=filter)
    mesh = square(materials=[e3d.Material(texture=texture)])
    renderer = Renderer((SIZE, SIZE), backend=renderer.backend, color_space=color_space)
    frame = renderer.render(scene_of(mesh), front, mode="unlit")
    np.testing.assert_array_equal(frame.color[8:24, 8:24, :3], pixels)


def test_vertex_colours(renderer, front):
    corners = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]], np.uint8)
    eight_bit = renderer.render(scene_of(square(colors=corners)), front, outputs=("albedo",))
    floats = renderer.render(scene_of(square(colors=corners / 255.0)), front, outputs=("albedo",))
    np.testing.assert_allclose(eight_bit.albedo, floats.albedo, atol=1e-6)
    assert len(np.unique(floats.albedo[inside()], axis=0)) > 50


def test_instance_colours(renderer, front):
    colors = np.array([[255, 0, 0], [0, 0, 255]], np.uint8)
    poses = [[-0.5, 0, 0, 0.5], [0.5, 0, 0, 0.5]]
    instances = e3d.InstancedMesh(square(), poses, colors=colors)
    frame = renderer.render(scene_of(instances), front, mode="unlit")
    assert frame.color[16, 8].tolist() == [255, 0, 0, 255]
    assert frame.color[16, 24].tolist() == [0, 0, 255, 255]


# ---- Light --------------------------------------------------------------------------------------


def lit_pixel(scene, front, **options):
    renderer = Renderer((SIZE, SIZE), color_space="linear")
    return renderer.render(scene, front, **options).color[16, 16, :3].tolist()


def test_headlight_makes_white_white(front):
    assert lit_pixel(scene_of(square()), front) == [255, 255, 255]
    turned = e3d.Scene(ambient=(0, 0, 0))
    turned.add(square(), pose=linalg.rotation_y(math.pi / 3))
    assert lit_pixel(turned, front) == pytest.approx([127.5] * 3, abs=1)


def test_hidden_lights_stay_off(front):
    scene = scene_of(square(), ambient=(0, 0, 0))
    light = scene.add(e3d.DirectionalLight())
    assert lit_pixel(scene, front) == [255, 255, 255]
    light.visible = False
    assert lit_pixel(scene, front) == [0, 0, 0]


def test_directional_light_turns_with_its_node(front):
    scene = scene_of(square(), ambient=(0, 0, 0))
    light = scene.add(e3d.DirectionalLight((0, 0, -1), e3d.linear(1.0, 0.5, 0.25)))
    assert lit_pixel(scene, front) == [255, 128, 64]
    light.rotation = linalg.quaternion_from_axis_angle((0, 1, 0), math.pi / 3)
    assert lit_pixel(scene, front) == pytest.approx([127, 64, 32], abs=1)
    light.rotation = linalg.quaternion_from_axis_angle((0, 1, 0), math.pi)
    assert lit_pixel(scene, front) == [0, 0, 0]


def test_point_light_falls_off(front):
    scene = scene_of(square(), ambient=(0, 0, 0))
    light = e3d.PointLight(intensity=2.0 * math.pi)
    scene.add(light, translation=(0, 0, 2))
    assert lit_pixel(scene, front) == pytest.approx([127] * 3, abs=1)
    light.range = 2.0  # exactly nothing from the range on
    assert lit_pixel(scene, front) == [0, 0, 0]
    light.falloff, light.range, light.intensity = "inverse_square", 4.0, math.pi
    light.falloff = "window"
    assert lit_pixel(scene, front) == pytest.approx([255 * 0.75**2] * 3, abs=1)


def test_light_clamp(front):
    scene = scene_of(square(), ambient=(0, 0, 0))
    light = e3d.DirectionalLight(intensity=9.0 * math.pi)
    node = scene.add(light)
    scene.light_clamp = (0.2, 0.6)
    assert lit_pixel(scene, front) == [153] * 3
    node.visible = False
    assert lit_pixel(scene, front) == [51] * 3


def test_specular_and_emissive(front):
    shiny = e3d.Material(color=(0, 0, 0), specular=e3d.linear(0.5, 0.5, 0.5), shininess=10)
    scene = scene_of(square(materials=[shiny]), e3d.DirectionalLight(), ambient=(0, 0, 0))
    assert lit_pixel(scene, front) == pytest.approx([127] * 3, abs=2)
    glowing = e3d.Material(color=(0, 0, 0), emissive=e3d.linear(0.25, 0.5, 1.0))
    scene = scene_of(square(materials=[glowing]), ambient=(0, 0, 0))
    assert lit_pixel(scene, front) == [64, 128, 255]


def test_flat_and_smooth_normals(front):
    sphere = e3d.uv_sphere(0.6, (8, 4))
    picture = {
        normals: render(scene_of(sphere), front, size=(64, 64), normals=normals).color
        for normals in ("auto", "smooth", "flat")
    }
    assert (picture["auto"] == picture["smooth"]).all()
    assert len(np.unique(picture["flat"][..., 0])) < 20 < len(np.unique(picture["smooth"][..., 0]))
    sphere.materials = [e3d.Material(flat_shading=True)]
    assert (render(scene_of(sphere), front, size=(64, 64)).color == picture["flat"]).all()


@pytest.mark.parametrize("physical", [False, True])
def test_each_facet_has_the_light_of_its_middle(front, physical):
    """E = I / d² cos θ, in the middle of each triangle and with its normal."""
    how = {"roughness": 0.4, "metallic": 0.0} if physical else {}
    ball = e3d.icosphere(0.7, 2)
    ball.materials = [e3d.Material(**how)]
    place, intensity = np.array([0.9, 0.6, 1.2]), 1.3
    scene = scene_of(ball, ambient=(0, 0, 0))
    scene.add(e3d.PointLight(intensity=intensity), translation=place)
    options = {"size": (96, 96), "normals": "facet", "outputs": ("radiance", "face_id")}
    frame = render(scene, front, **options)
    shown = frame.face_id
    assert len(np.unique(shown)) > 50
    middles = ball.positions[ball.faces].astype(np.float64).mean(axis=1)
    to_light = place - middles
    distance = np.linalg.norm(to_light, axis=1)
    cosine = (ball.face_normals * to_light).sum(axis=1) / distance
    expected = intensity / math.pi * np.maximum(cosine, 0) / distance**2
    for triangle in np.unique(shown[shown >= 0]):
        radiance = frame.radiance[shown == triangle][:, :3]
        assert len(np.unique(radiance, axis=0)) == 1
        assert physical or radiance[0] == pytest.approx(expected[triangle], rel=2e-5, abs=1e-6)


# ---- Options ------------------------------------------------------------------------------------


def test_cull(renderer, front):
    scene = e3d.Scene()
    scene.add(square(), scale=(-1, 1, -1))
    area = {
        cull: int((renderer.render(scene, front, cull=cull).color[..., 0] > 0).sum())
        for cull in ("back", "front", "none")
    }
    assert area == {"back": 0, "front": 256, "none": 256}
    scene = e3d.Scene()
    scene.add(square(materials=[e3d.Material(two_sided=True)]), scale=(-1, 1, -1))
    assert (renderer.render(scene, front).color[inside()][:, 0] > 0).all()


def test_mirrored_pose_keeps_its_front(renderer, front):
    scene = e3d.Scene()
    scene.add(square(), scale=(-1, 1, 1))
    assert (renderer.render(scene, front).color[inside()][:, 0] == 255).all()


def test_wireframe(renderer, front):
    scene = scene_of(square(edge_visible=[[1, 1, 0], [0, 1, 1]]), background=(0, 0, 40))
    only = renderer.render(scene, front, wireframe="only", line_color=(255, 100, 0)).color
    assert only[16, 16].tolist() == [0, 0, 40, 255]  # neither face nor hidden diagonal
    assert (only == (255, 100, 0, 255)).all(axis=-1).sum() >= 60
    overlay = renderer.render(scene, front, wireframe="overlay", line_width=3).color
    assert overlay[16, 16].tolist() == [255, 255, 255, 255]


def test_hidden_lines(renderer, front):
    scene = scene_of(e3d.box())
    counts = [
        int(
            renderer.render(scene, front, wireframe="only", hidden_lines=hidden).color[..., 0].sum()
        )
        for hidden in (False, True)
    ]
    assert counts[0] < counts[1]


def test_lines_and_points(renderer, front):
    mesh = e3d.Mesh([[-0.5, 0, 0], [0.5, 0, 0], [0, 0.5, 0]], lines=[[0, 1]], points=[2])
    frame = renderer.render(
        scene_of(mesh), front, line_width=2, point_size=4, outputs=("color", "face_id")
    )
    assert (frame.color[15:17, 9:23, :3] == 255).all()
    assert (frame.color[6:10, 14:18, :3] == 255).all()
    assert (frame.face_id == -1).all()


def test_hidden_surfaces(renderer, front):
    red, blue = e3d.Material(color=(1, 0, 0)), e3d.Material(color=(0, 0, 1))
    scene = e3d.Scene()
    scene.add(square(materials=[red]), translation=(0, 0, 0.5))
    scene.add(square(materials=[blue]))
    seen = {
        method: renderer.render(scene, front, mode="unlit", hidden_surfaces=method).color[16, 16]
        for method in ("zbuffer", "painter", "none")
    }
    assert seen["zbuffer"].tolist() == seen["painter"].tolist() == [255, 0, 0, 255]
    assert seen["none"].tolist() == [0, 0, 255, 255]


@pytest.mark.parametrize("mode", MODES)
def test_deferred_and_forward_agree(renderer, front, mode):
    scene = scene_of(e3d.torus(0.6, 0.3), e3d.PointLight(), e3d.DirectionalLight((1, -1, -1)))
    pictures = [
        renderer.render(scene, front, mode=mode, shading=shading).color
        for shading in ("deferred", "forward")
    ]
    np.testing.assert_array_equal(*pictures)


def test_samples_smooth_edges(front):
    scene = e3d.Scene()
    scene.add(square(), pose=linalg.rotation_z(0.3))
    tones = [
        len(np.unique(render(scene, front, size=(32, 32), samples=samples).color[..., 0]))
        for samples in (1, 4, 16)
    ]
    assert tones[0] == 2 < tones[1] < tones[2]


def test_depth_mode_is_white_near_and_black_far(renderer, front):
    scene = scene_of(square())
    scene.add(square(), translation=(0.25, 0, 0.5))
    color = renderer.render(scene, front, mode="depth").color
    assert color[16, 20].tolist() == [255, 255, 255, 255]
    assert color[16, 9].tolist() == [0, 0, 0, 255]


# ---- Cameras ------------------------------------------------------------------------------------


def test_a_scene_without_camera_is_framed(renderer):
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere(), translation=(1e3, -50, 7), scale=20)
    seen = renderer.render(scene, outputs=("object_id",)).object_id >= 0
    assert 0.3 < seen.mean() < 0.9
    assert not (seen[0].any() or seen[-1].any() or seen[:, 0].any() or seen[:, -1].any())


def test_first_visible_camera_of_the_scene(renderer, front):
    scene = scene_of(square())
    away = scene.add(e3d.PerspectiveCamera(), pose=linalg.translation((0, 0, -9)))
    camera = scene.add(front[0], pose=front[1])
    expected = renderer.render(scene, front).color
    assert not renderer.render(scene).color[..., :3].any()
    np.testing.assert_array_equal(renderer.render(scene, camera).color, expected)
    away.visible = False
    np.testing.assert_array_equal(renderer.render(scene).color, expected)
    camera.translation = (0, 0, 4)
    assert not np.array_equal(renderer.render(scene).color, expected)


def test_changing_a_camera_shows(renderer, front):
    camera, pose = front
    before = renderer.render(scene_of(square()), front).color
    camera.yfov *= 2
    assert not np.array_equal(renderer.render(scene_of(square()), (camera, pose)).color, before)


def test_orthographic(renderer):
    camera = e3d.OrthographicCamera(1.0, znear=0, zfar=9)
    scene = scene_of(square())
    outputs = ("depth", "object_id")
    near = renderer.render(scene, (camera, linalg.translation((0, 0, 2))), outputs=outputs)
    far = renderer.render(scene, (camera, linalg.translation((0, 0, 8))), outputs=outputs)
    np.testing.assert_array_equal(near.object_id, far.object_id)
    assert near.depth[16, 16] == 2
    assert far.depth[16, 16] == 8


# ---- Changes between frames ---------------------------------------------------------------------


def change_positions(scene, mesh, material, texture):
    mesh.positions = mesh.positions * 2


def change_faces(scene, mesh, material, texture):
    mesh.faces = mesh.faces[:1]


def change_color(scene, mesh, material, texture):
    material.color = (0, 1, 0)


def change_material(scene, mesh, material, texture):
    mesh.materials = [e3d.Material(color=(1, 0, 0))]


def change_material_in_place(scene, mesh, material, texture):
    mesh.materials[0] = e3d.Material(color=(1, 0, 0))


def change_pixels(scene, mesh, material, texture):
    texture.pixels = np.full((1, 1, 3), 90, np.uint8)


def change_pose(scene, mesh, material, texture):
    scene.nodes[0].translation = (0.5, 0, 0)


def change_visible(scene, mesh, material, texture):
    scene.nodes[0].visible = False


def change_nodes(scene, mesh, material, texture):
    scene.remove(scene.nodes[0])


def change_light(scene, mesh, material, texture):
    scene.add(e3d.DirectionalLight(intensity=0.2 * math.pi))


def change_ambient(scene, mesh, material, texture):
    scene.add(e3d.DirectionalLight(intensity=0))
    scene.ambient = e3d.linear(0.3, 0.3, 0.3)


@pytest.mark.parametrize(
    "change", [value for name, value in list(globals().items()) if name.startswith("change_")]
)
def test_a_change_shows_in_the_next_frame(renderer, front, change):
    texture = e3d.Texture(np.full((1, 1, 3), 200, np.uint8))
    material = e3d.Material(texture=texture)
    mesh = square(materials=[material])
    scene = scene_of(mesh)
    before = renderer.render(scene, front).color
    np.testing.assert_array_equal(renderer.render(scene, front).color, before)
    change(scene, mesh, material, texture)
    after = renderer.render(scene, front).color
    assert not np.array_equal(after, before)
    fresh = Renderer((SIZE, SIZE), backend=renderer.backend).render(scene, front).color
    np.testing.assert_array_equal(after, fresh)


def test_instances_that_change_show(renderer, front):
    instances = e3d.InstancedMesh(square(), [[-0.5, 0, 0, 0.5]])
    scene = scene_of(instances)
    before = renderer.render(scene, front).color
    instances.replace([[0.5, 0, 0, 0.5], [-0.5, 0, 0, 0.5]])
    after = renderer.render(scene, front).color
    assert (after[..., 0] > 0).sum() == 2 * (before[..., 0] > 0).sum()


def test_one_renderer_draws_several_scenes(renderer, front):
    first, second = scene_of(square()), scene_of(e3d.uv_sphere(0.4))
    expected = [renderer.render(scene, front).color for scene in (first, second)]
    for _ in range(3):
        for scene, picture in zip((first, second), expected, strict=True):
            np.testing.assert_array_equal(renderer.render(scene, front).color, picture)


def test_faces_that_are_neither_shaded_nor_counted_leave_the_background(renderer, front):
    """They cover all of the picture, and another output shows them."""
    scene = e3d.Scene(background=(0, 0, 255))
    scene.add(square(), scale=8.0, translation=(2.5, 0, 0))  # its edges are out of the picture
    renderer.render(scene, front, mode="unlit")
    outputs = ("color", "object_id")
    frame = renderer.render(scene, front, mode="overdraw", wireframe="only", outputs=outputs)
    assert (frame.object_id >= 0).all()
    assert (frame.color == (0, 0, 255, 255)).all()


# ---- Arrays -------------------------------------------------------------------------------------


def test_kept_frames_are_never_drawn_over(renderer, front):
    scene = scene_of(square())
    kept = renderer.render(scene, front)
    row = kept.color[16, 4:12]
    copy = row.copy()
    del kept
    for _ in range(5):
        renderer.render(scene, front, mode="normal")
    np.testing.assert_array_equal(row, copy)


def test_out_draws_into_an_earlier_frame(renderer, front):
    frame = renderer.render(scene_of(square()), front, outputs=("color", "depth"))
    color = frame.color
    again = renderer.render(e3d.Scene(background=(7, 8, 9)), front, out=frame)
    assert again is frame
    assert again.color is color
    assert (color == (7, 8, 9, 255)).all()
    assert not frame.depth.any()


def test_resize(renderer, front):
    before = renderer.render(scene_of(square()), front)
    renderer.resize((7, 3))
    frame = renderer.render(scene_of(square()), front)
    assert frame.color.shape == (3, 7, 4)
    assert before.color.shape == (SIZE, SIZE, 4)
    with pytest.raises(e3d.InvalidArgumentError):
        renderer.render(scene_of(square()), front, out=before)


def test_canvas_draws_on_the_frame(renderer, front):
    frame = renderer.render(e3d.Scene(), front)
    frame.canvas().point(3, 5, (1, 2, 3))
    assert frame.color[5, 3].tolist() == [1, 2, 3, 255]
