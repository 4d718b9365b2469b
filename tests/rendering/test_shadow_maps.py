"""Maps of shadows: what they keep the light off, when they are drawn, that edges stay in place."""

import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg, primitives
from engine3d.rendering.passes.shadow_maps import ShadowMaps

DOWN = (0.0, -1.0, 0.0)


def stage(light=None, **light_options):
    """A floor under a box that hangs, seen from above, and a light from the left above."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0.25, 0.25, 0.25))
    floor = scene.add(e3d.plane((8.0, 8.0)), name="floor")
    box = scene.add(e3d.box(1.0), name="box", translation=(0.0, 2.0, 0.0))
    light = light or e3d.DirectionalLight(
        (1, -1, 0), intensity=math.pi * math.sqrt(2) / 2, shadow="map", **light_options
    )
    lamp = scene.add(light, name="light")
    return scene, floor, box, lamp


def shadow_maps(renderer):
    """The pass of a renderer that draws them."""
    return next(one for one in renderer._painter.passes._all if isinstance(one, ShadowMaps))


def seen_from_above(scene, size=(160, 160), **options):
    camera = e3d.OrthographicCamera(4.0, znear=0.0, zfar=20.0)
    pose = e3d.look_at((0, 10, 0), (0, 0, 0), (0, 0, -1))
    with Renderer(size, color_space="linear") as renderer:
        return renderer.render(scene, (camera, pose), **options)


def grey_at(frame, x, z):
    """The grey of the floor at a place, of a picture by `seen_from_above`."""
    row, column = round((z + 4) * 20), round((x + 4) * 20)
    return int(frame.color[row, column, 0])


LIT, DARK = round(255 * 0.75), round(255 * 0.25)


def test_a_box_throws_its_shadow_along_the_light():
    """The light goes 2 to the right on its way down from the box, 2 above the floor."""
    scene, *_ = stage()
    frame = seen_from_above(scene)
    assert grey_at(frame, 2.0, 0.0) == DARK
    for x, z in [(2.0, 1.0), (-2.0, 0.0), (3.4, 0.0), (2.0, -1.0)]:
        assert grey_at(frame, x, z) == LIT


def test_without_shadow_nothing_changes():
    scene, *_, lamp = stage()
    lamp.object.shadow = "none"
    frame = seen_from_above(scene)
    assert grey_at(frame, 2.0, 0.0) == LIT
    assert frame.stats["shadow_maps"] == 0


def test_what_a_light_sees_does_not_depend_on_who_looks_into_holes():
    """A cup throws the shadow of its inside, too, and its map stays as the camera turns."""
    scene, _, box, _ = stage(shadow_cascades=1)
    mesh = box.object
    sides = mesh.faces[mesh.face_normals[:, 1] < 0.5]
    cup = e3d.Mesh(mesh.positions, sides, position_ids=mesh.position_ids)
    scene.remove(box)
    scene.add(cup, translation=(0.0, 2.0, 0.0))
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=50.0)
    drawn = []
    with Renderer((64, 48)) as renderer:
        for eye in ((0, 1, 8), (0, 8, 4), (0, 1, 8)):
            pose = e3d.look_at(eye, (0, 1, 0), (0, 1, 0))
            frame = renderer.render(scene, (camera, pose), cull="auto")
            drawn.append(frame.stats["shadow_maps_drawn"])
    assert drawn == [1, 0, 0]


@pytest.mark.parametrize("mode", ["unlit", "normal", "depth"])
def test_other_modes_draw_no_maps(mode):
    scene, *_ = stage()
    assert seen_from_above(scene, mode=mode).stats["shadow_maps_drawn"] == 0


def test_a_coloured_light_under_a_shadow_shows_its_colour():
    """Where a red light is kept off, the white one's shadow is what is left: cyan is missing."""
    scene, *_, lamp = stage()
    lamp.object.color = (1.0, 0.0, 0.0)
    scene.ambient = (0.0, 0.0, 0.0)
    scene.add(e3d.DirectionalLight(DOWN, e3d.linear(0.0, 0.5, 0.5)))
    frame = seen_from_above(scene)
    rows, columns = [round((z + 4) * 20) for z in (0.0, 1.5)], round((2.0 + 4) * 20)
    under, beside = frame.color[rows, columns, :3].tolist()
    assert under[0] == 0 and beside[0] > 100
    assert under[1:] == beside[1:] == [round(255 * 0.5)] * 2


def test_switches_of_nodes():
    scene, floor, box, _ = stage()
    box.cast_shadows = False
    assert grey_at(seen_from_above(scene), 2.0, 0.0) == LIT
    box.cast_shadows = True
    floor.receive_shadows = False
    assert grey_at(seen_from_above(scene), 2.0, 0.0) == LIT
    floor.receive_shadows = True
    assert grey_at(seen_from_above(scene), 2.0, 0.0) == DARK


def test_a_node_added_with_its_switches():
    scene = e3d.Scene()
    node = scene.add(e3d.box(1.0), cast_shadows=False, receive_shadows=False)
    assert (node.cast_shadows, node.receive_shadows) == (False, False)
    other = scene.add(e3d.box(1.0))
    assert (other.cast_shadows, other.receive_shadows) == (True, True)


def test_switches_survive_packing():
    """Rows of nodes are packed when many were removed."""
    scene = e3d.Scene()
    nodes = [scene.add(cast_shadows=number % 2 == 0) for number in range(200)]
    for node in nodes[:150]:
        scene.remove(node)
    scene.add()
    assert [node.cast_shadows for node in nodes[150:]] == [n % 2 == 0 for n in range(150, 200)]


@pytest.mark.parametrize(
    "light",
    [
        e3d.PointLight(intensity=20.0 * math.pi, shadow="map", shadow_map_size=256),
        e3d.SpotLight(
            intensity=20.0 * math.pi, shadow="map", shadow_map_size=256, outer_cone_angle=1.0
        ),
    ],
    ids=["point", "spot"],
)
def test_lamps(light):
    scene, _, box, lamp = stage(light)
    lamp.pose = e3d.look_at((0.0, 4.0, 0.0), (0.0, 0.0, 0.0), (0, 0, -1))
    lit = seen_from_above(scene)
    box.visible = False
    free = seen_from_above(scene)
    box.visible = True
    # The upper face is 1.5 below the lamp: its edge falls 0.5 * 4 / 1.5 to the right.
    assert grey_at(lit, 1.9, 0.0) == grey_at(free, 1.9, 0.0) > 64
    column, row = round((0.5 * 4 / 1.5 - 0.2 + 4) * 20), 80
    assert lit.color[row, column, 0] == 64 < free.color[row, column, 0]


def test_what_is_behind_the_near_end_of_the_camera_still_casts():
    scene, *_ = stage()
    camera = e3d.PerspectiveCamera(0.5, znear=0.05, zfar=3.0)
    with Renderer((64, 64), color_space="linear") as renderer:
        frame = renderer.render(scene, (camera, e3d.look_at((2.0, 1.0, 0.5), (2.0, 0, 0))))
    assert int(frame.color[32, 32, 0]) == DARK


# When maps are drawn


def drawn(renderer, scene, camera):
    return renderer.render(scene, camera).stats["shadow_maps_drawn"]


@pytest.fixture
def still():
    """A renderer, scene and camera whose maps are drawn, and the scene's nodes."""
    scene, floor, box, lamp = stage(shadow_map_size=128, shadow_cascades=1)
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((3, 4, 6), (0, 0.5, 0))
    with Renderer((64, 48)) as renderer:
        assert drawn(renderer, scene, camera) == 1
        yield renderer, scene, camera, (floor, box, lamp)


def test_a_still_scene_draws_no_map_again(still):
    renderer, scene, camera, _ = still
    assert drawn(renderer, scene, camera) == 0
    assert drawn(renderer, scene, camera) == 0


def test_a_camera_that_moves_a_little_draws_no_map_again(still):
    renderer, scene, (camera, pose), _ = still
    for step in range(1, 4):
        moved = pose.copy()
        moved[:3, 3] += 0.02 * step
        assert drawn(renderer, scene, (camera, moved)) == 0


def test_what_moves_is_drawn_anew(still):
    renderer, scene, camera, (_, box, lamp) = still
    for change in (
        lambda: setattr(box, "translation", (0.1, 2.0, 0.0)),
        lambda: setattr(lamp, "euler", (0.1, 0.0, 0.0)),
        lambda: setattr(lamp.object, "direction", (1, -1.2, 0)),
        lambda: setattr(box, "cast_shadows", False),
        lambda: setattr(box, "cast_shadows", True),
        lambda: setattr(box, "visible", False),
        lambda: setattr(box.object.materials[0], "alpha_mode", "mask"),
        lambda: setattr(lamp.object, "shadow_map_size", 64),
    ):
        change()
        assert drawn(renderer, scene, camera) == 1
        assert drawn(renderer, scene, camera) == 0


def test_what_a_map_does_not_show_may_move():
    """Of two spot lights, each with a box before it, one box moves."""
    scene = e3d.Scene()
    boxes = []
    for x in (-6.0, 6.0):
        boxes.append(scene.add(e3d.box(1.0), translation=(x, 0, 0)))
        light = e3d.SpotLight(
            intensity=5 * math.pi, shadow="map", shadow_map_size=64, outer_cone_angle=0.3
        )
        scene.add(light, pose=e3d.look_at((x, 5, 0), (x, 0, 0), (0, 0, 1)))
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((0, 9, 14), (0, 0, 0))
    with Renderer((64, 48)) as renderer:
        assert drawn(renderer, scene, camera) == 2
        boxes[1].euler = (0, 0.4, 0)
        assert drawn(renderer, scene, camera) == 1


def test_kept_maps_show_what_new_ones_would(still):
    renderer, scene, camera, (_, box, _) = still
    box.translation = (0.7, 2.5, 0.3)
    before = renderer.render(scene, camera).color.copy()
    box.translation = (0.0, 2.0, 0.0)
    renderer.render(scene, camera)
    box.translation = (0.7, 2.5, 0.3)
    assert np.array_equal(renderer.render(scene, camera).color, before)
    with Renderer((64, 48)) as other:
        assert np.array_equal(other.render(scene, camera).color, before)


@pytest.mark.parametrize("kind", ["sun", "spot", "point"])
def test_the_ranges_of_kept_maps_change_no_pixel(kind):
    """They are found when maps are looked up again, and for other comparisons anew."""
    options = {"shadow": "map", "shadow_map_size": 96}
    light = {
        "sun": e3d.DirectionalLight((1, -1, 0), shadow_cascades=2, **options),
        "spot": e3d.SpotLight(intensity=30 * math.pi, outer_cone_angle=1.2, **options),
        "point": e3d.PointLight(intensity=30 * math.pi, **options),
    }[kind]
    scene, _, box, lamp = stage(light)
    if kind == "spot":
        lamp.pose = e3d.look_at((-2, 4, 0), (0, 0, 0))
    elif kind == "point":
        lamp.translation = (-2, 4, 0)
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((3, 4, 6), (0, 0.5, 0))
    with Renderer((80, 60)) as renderer:
        for change in (
            lambda: None,
            lambda: setattr(light, "shadow_taps", 5),
            lambda: setattr(light, "shadow_radius", 1.6),
            lambda: setattr(box, "translation", (0.2, 1.5, 0.0)),
        ):
            change()
            with Renderer((80, 60)) as other:
                expected = other.render(scene, camera).color
            for frame in range(3):
                assert np.array_equal(renderer.render(scene, camera).color, expected)
                kept = shadow_maps(renderer)._kept[0]
                taps, step = light.shadow_taps, round(256 * light.shadow_radius)
                found = [drawn.compared == (taps, step) for drawn in kept.drawn]
                assert all(found) or frame == 0


# What maps are drawn, and how fine


def sides_and_number(size, camera, **options):
    """The side of a light's maps in a picture of the far stage, and how many there are."""
    scene, light = far_stage()
    for name, value in {"shadow_map_size": 2048, **options}.items():
        setattr(light, name, value)
    with Renderer(size) as renderer:
        renderer.render(scene, camera)
        depths = shadow_maps(renderer)._kept[0].depths
    return depths.shape[1], len(depths)


def test_maps_are_as_fine_as_the_picture():
    lens = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=500.0)
    camera = lens, e3d.look_at((0, 2, 8), (0, 1, 0))
    small, large = (sides_and_number(size, camera)[0] for size in ((64, 48), (512, 384)))
    assert 48 <= small <= 256 and 4 * small <= large <= 1024
    assert sides_and_number((64, 48), camera, shadow_map_size=96)[0] == 96
    assert sides_and_number((64, 48), camera, shadow_cascades=1) == (2048, 1)
    for eye in ((0, 2, 30), (3, 40, 8), (0, 2, 600)):
        assert sides_and_number((64, 48), (lens, e3d.look_at(eye, (0, 1, 0))))[0] == small
    flat = e3d.OrthographicCamera(5.0, znear=0.1, zfar=500.0), camera[1]
    assert sides_and_number((64, 48), flat, shadow_cascades=1)[0] == 2048
    wide = e3d.OrthographicCamera(400.0, znear=0.1, zfar=500.0), camera[1]
    assert sides_and_number((64, 48), wide)[0] < 128


def test_parts_of_the_view_without_anything_have_no_map():
    """The floor is 566 across: parts of the view end at 9, 35 and 141."""
    lens = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=2000.0)
    for eye, number in (((0, 2, 8), 4), ((0, 2, 0.1), 2), ((0, 80, 0.1), 2), ((0, 300, 0.1), 1)):
        assert sides_and_number((64, 48), (lens, e3d.look_at(eye, (0, 1, 0))))[1] == number


# Edges stay in place


def far_stage():
    """A floor that is wide beside what the camera sees, with columns on it."""
    scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
    scene.add(e3d.plane((400.0, 400.0)))
    column = e3d.box((0.7, 2.0, 0.5))
    for x in range(-8, 9, 2):
        for z in range(-30, 9, 3):
            scene.add(column, translation=(x, 1.0, z), euler=(0, 0.3 * x, 0))
    light = e3d.DirectionalLight(
        (0.7, -1, 0.4), intensity=0.7 * math.pi, shadow="map", shadow_map_size=256
    )
    scene.add(light)
    return scene, light


def maps_of(renderer, scene, camera, pose):
    """The maps of the first light: what they show, and where they are."""
    renderer.render(scene, (camera, pose))
    kept = shadow_maps(renderer)._kept[0]
    from engine3d.rendering.passes import shadow_views as _shadow_views

    towards, _ = renderer._painter.draw_list.lights.placed()[0][2]
    light = renderer._painter.draw_list.lights.placed()[0][1]
    view = renderer._viewpoint.look(scene, (camera, pose), renderer.width, renderer.height)
    sight = _shadow_views.sight_of(view, scene.bounds, light.shadow_cascades)
    views = _shadow_views.VIEWS["cascades"](light, (towards, None), scene.bounds, sight)
    return kept.depths.copy(), views


def test_a_camera_that_moves_and_turns_moves_no_texel():
    """Two maps that overlap show the same depths there: they are moved by whole texels."""
    scene, _ = far_stage()
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=500.0)
    with Renderer((64, 48)) as renderer:
        before, old = maps_of(renderer, scene, camera, e3d.look_at((0, 2, 8), (0, 1, 0)))
        moved = 0
        for step in range(1, 7):
            eye = np.array([0.9 * step, 2, 8 - 1.7 * step])
            pose = e3d.look_at(eye, eye + (0.3 * step, -0.4, -8))
            after, new = maps_of(renderer, scene, camera, pose)
            for k in range(len(old.maps)):
                scale, x, y = old.places[k]
                assert scale == new.places[k][0]
                right, down = (b - a for a, b in zip((x, y), new.places[k][1:], strict=True))
                assert right == int(right) and down == int(down)
                moved += (right, down) != (0, 0)
                shifted, size = np.full_like(before[k], np.nan), new.size
                rows = slice(max(0, int(down)), min(size, size + int(down)))
                columns = slice(max(0, int(right)), min(size, size + int(right)))
                from_rows = slice(rows.start - int(down), rows.stop - int(down))
                from_columns = slice(columns.start - int(right), columns.stop - int(right))
                shifted[rows, columns] = before[k][from_rows, from_columns]
                both = np.isfinite(shifted) & np.isfinite(after[k])
                # Corners are snapped to 1/256 of a texel, and depths rounded, in both.
                close = np.abs(shifted[both] - after[k][both]) < 1e-4
                assert both.sum() > 1000 and close.mean() > 0.999
        assert moved > 6


def test_a_moving_camera_makes_no_edge_swim():
    """Places on the floor are as light as before wherever the camera goes."""
    scene, light = far_stage()
    light.shadow_map_size, light.shadow_cascades = 2048, 2
    places = np.array([(x, 0.0, z) for x in np.arange(-3, 3, 0.11) for z in np.arange(-3, 2, 0.13)])
    camera = e3d.PerspectiveCamera(0.6, znear=0.1, zfar=60.0)
    found = []
    with Renderer((400, 400), color_space="linear") as renderer:
        for step in range(5):
            pixel = 2 * 20.0 * math.tan(0.3) / 400  # on the floor: places keep theirs within one
            shift = pixel * np.array([37 * step, 0, 23 * step])
            eye = np.array([0, 20.0, 0]) + shift
            pose = e3d.look_at(eye, eye - (0, 1, 0), (0, 0, -1))
            frame = renderer.render(scene, (camera, pose), outputs=("color", "world_position"))
            pixels, _ = frame.project(places)
            columns, rows = np.floor(pixels).astype(int).T
            inside = (columns >= 0) & (columns < 400) & (rows >= 0) & (rows < 400)
            greys = np.full(len(places), np.nan)
            greys[inside] = frame.color[rows[inside], columns[inside], 0]
            heights = np.full(len(places), np.nan)
            heights[inside] = frame.world_position[rows[inside], columns[inside], 1]
            greys[np.abs(heights) > 1e-3] = np.nan  # columns stand before it
            found.append(greys)
    for greys in found[1:]:
        both = ~np.isnan(greys) & ~np.isnan(found[0])
        assert both.sum() > 500
        # Where an edge goes through the middle of a texel, rounding decides: a ninth of the light.
        differ = np.abs(greys - found[0])[both]
        assert differ.max() <= 20 and differ.mean() < 0.5
    assert len(np.unique(found[0][~np.isnan(found[0])])) > 2


# Bad arguments


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"shadow": "soft"}, "shadow must be one of .none., .map."),
        ({"shadow_map_size": 16}, r"shadow_map_size must be a whole number in 32..8192, not 16"),
        ({"shadow_map_size": 256.0}, "shadow_map_size must be a whole number"),
        ({"shadow_bias": math.nan}, "shadow_bias must be a finite number"),
        ({"shadow_radius": -1}, "shadow_radius must be a finite number, 0 or greater"),
        ({"shadow_radius": 17}, "shadow_radius must be at most 16 texels"),
        ({"shadow_taps": 2}, "shadow_taps must be one of 1, 3, 5"),
        ({"shadow_cascades": 0}, r"shadow_cascades must be a whole number in 1..8, not 0"),
        ({"shadow_map_size": 32, "shadow_radius": 8}, "shadow_radius 8 is too wide for"),
    ],
)
def test_bad_arguments(options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.DirectionalLight(**options)


def test_a_radius_that_became_too_wide_is_told_when_drawing():
    scene, *_, lamp = stage(shadow_map_size=32)
    lamp.object.shadow_radius = 8
    with pytest.raises(e3d.InvalidArgumentError, match="too wide"):
        seen_from_above(scene)


def test_lights_without_anything_to_shine_on():
    scene = e3d.Scene()
    scene.add(e3d.DirectionalLight(shadow="map"))
    scene.add(e3d.PointLight(shadow="map"))
    scene.add(e3d.SpotLight(shadow="map"))
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((3, 4, 6), (0, 0, 0))
    with Renderer((16, 16)) as renderer:
        assert not renderer.render(scene, camera).color[..., :3].any()


@pytest.mark.parametrize("size", [1e-42, 1e-38, 1e-30, 1e-20, 1e-10, 1e20, 1e37])
def test_a_scene_of_any_size_around_the_camera_is_drawn(size):
    # The camera's own range, of at least so many metres, then has no parts but a point.
    rng = np.random.default_rng(0)
    scene = e3d.Scene()
    positions = (rng.uniform(-1, 1, (60, 3)) * size).astype(np.float32)
    scene.add(e3d.Mesh(positions, np.arange(60, dtype=np.int32).reshape(-1, 3)))
    scene.add(e3d.DirectionalLight(shadow="map"))
    camera = scene.add(e3d.PerspectiveCamera(), pose=np.eye(4))
    frame = e3d.Renderer((24, 16), threads=1).render(scene, camera)
    assert frame.color.shape == (16, 24, 4)


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
@pytest.mark.parametrize("place", [1e18, 1e25, 1e30])
def test_what_is_far_away_and_has_no_extent_is_drawn(place):
    scene = e3d.Scene()
    scene.add(e3d.Mesh(np.float32([(place, 0, 0), (place, 0, 0), (place, 1, 0)]), [(0, 1, 2)]))
    scene.add(e3d.DirectionalLight(direction=(1, -1, 0), shadow="map"))
    camera = e3d.PerspectiveCamera(), e3d.linalg.translation((place, 0, 2))
    frame = e3d.render(scene, camera, size=(32, 24))
    assert (frame.color[..., 3] == 255).all()


@pytest.mark.parametrize("aside", [(0.0, 0.0), (0.3, 0.1), (0.9, 0.2), (0.7, -0.8)])
@pytest.mark.parametrize("kind", [e3d.PointLight, e3d.SpotLight])
def test_what_faces_a_light_hides_nothing_of_itself_beside_the_middle_of_a_map(kind, aside):
    """A map has depths along its axis: in these, such a plane slopes."""
    place = 3.0 * linalg.normalize(np.array([*aside, -1.0]))
    facing = e3d.look_at(place, (0, 0, 0))
    corners = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    cone = {"outer_cone_angle": 1.2} if kind is e3d.SpotLight else {}
    radiances = []
    for shadow in ("none", "map"):
        scene = e3d.Scene(ambient=(0, 0, 0))
        # A camera looks along -z: its back is what faces the light.
        front = linalg.multiply(facing, linalg.rotation_y(math.pi))
        scene.add(primitives.quad(*corners), pose=front)
        scene.add(kind(shadow=shadow, **cone))
        camera = e3d.PerspectiveCamera(0.8), e3d.look_at((0.2, -0.3, 0.1), place)
        with Renderer((120, 120)) as renderer:
            radiances.append(renderer.render(scene, camera, outputs=("radiance",)).radiance)
    assert radiances[0].max() > 0.05
    np.testing.assert_array_equal(*radiances)
