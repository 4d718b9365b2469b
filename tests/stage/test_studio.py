"""What models stand in by default: soft light, a shadow on the ground, a background."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.motion.clips import AnimationClip, Channel
from engine3d.model.scene.orbiting import home_axes
from engine3d.model.scene.staged_scene import StagedScene
from engine3d.model.scene.surroundings import SCENE_VALUES
from engine3d.stage.ground.ground_shadow import SIDE, GroundShadow, slant_along, usual_slant
from engine3d.stage.overlays.theme import DARK, LIGHT
from engine3d.stage.played_clips import play_clips
from engine3d.stage.stage_settings import Settings
from engine3d.stage.studio import theme_for
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (120, 90)


def staged(color=(0.2, 0.2, 0.2), settings=None, **options):
    scene = e3d.Scene(ambient=e3d.linear(0.1, 0.2, 0.3))
    box = e3d.box()
    box.materials = [e3d.Material(color=color)]
    scene.add(box, name="box")
    settings = Settings({}, look="studio") if settings is None else settings
    return scene, ViewRenderer(ViewedScene(scene, "box", themed=True), settings, SIZE, **options)


def shadow_of(renderer):
    beside = renderer.staging.scene.beside
    return next((node for node in beside.nodes if node.name == "shadow"), None)


def test_a_model_casts_a_shadow_on_the_ground():
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        shown = renderer.draw(view).color.astype(int)
        shadow_of(renderer).visible = False
        bare = renderer.renderer.render(
            renderer.staging.scene, (renderer.camera(view), view.pose())
        ).color
        shadow = shadow_of(renderer).object
    alpha = shadow.materials[0].texture.pixels[..., 3]
    middle = len(alpha) // 2
    assert alpha[middle, middle] > 100 and alpha[0].max() == 0 == alpha[:, -1].max()
    corner = [tuple(picture[0, 0]) for picture in (shown, bare.astype(int))]
    assert corner[0] == corner[1]  # where no shadow is, the background is as it was


def test_the_shadow_is_none_of_the_models_parts():
    scene, renderer = staged()
    with renderer:
        renderer.draw(renderer.view())
        assert shadow_of(renderer) is not None
        assert [entry.name for entry in renderer.visibility.objects()] == ["box"]


@pytest.mark.parametrize("change", [{"mode": "normal"}, {"wireframe": "overlay"}])
def test_it_shows_in_pictures_of_faces_alone(change):
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        renderer.draw(view)
        assert shadow_of(renderer).visible
        for name, value in change.items():
            setattr(renderer.appearance, name, value)
        renderer.draw(view)
        assert not shadow_of(renderer).visible


def test_a_transparent_picture_has_none():
    scene, renderer = staged(transparent=True)
    with renderer:
        renderer.draw(renderer.view())
    assert shadow_of(renderer) is None and renderer.staging.scene.background is None


def test_the_scene_stays_as_it_is():
    scene, renderer = staged()
    before = {name: getattr(scene, name) for name in SCENE_VALUES}
    with renderer:
        renderer.draw(renderer.view())
        assert [node.name for node in scene.nodes] == ["box"]
        assert {name: getattr(scene, name) for name in SCENE_VALUES} == before


def staged_points():
    scene = e3d.Scene()
    places = np.random.default_rng(3).uniform(-1.0, 1.0, (60, 3))
    scene.add(e3d.Mesh(places, points=np.arange(60)))
    return scene


@pytest.mark.parametrize("color", [0.05, 0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("shape", ["box", "uv_sphere", "torus"])
def test_like_models_stand_on_the_same_ground(shape, color):
    scene = e3d.Scene()
    mesh = getattr(e3d, shape)()
    mesh.materials = [e3d.Material(color=(color,) * 3)]
    scene.add(mesh)
    viewed = ViewedScene(scene, shape, themed=True)
    with ViewRenderer(viewed, Settings({}, look="studio"), SIZE) as renderer:
        view = renderer.view()
        renderer.fill(view)
        renderer.draw(view)
        assert renderer.theme is LIGHT


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_background_is_one_that_the_model_stands_out_from(theme):
    scene = staged()[0] if theme is LIGHT else staged_points()
    viewed = ViewedScene(scene, "model", themed=True)
    with ViewRenderer(viewed, Settings({}, look="studio"), SIZE) as renderer:
        renderer.draw(renderer.view())
        assert renderer.theme is theme and renderer.staging.scene.background == theme.gradient
        renderer.staging.theme = DARK if theme is LIGHT else LIGHT  # the user's word stands
        renderer.draw(renderer.view())
        assert renderer.theme is not theme


def test_where_nothing_shows_the_first_theme_is_taken():
    assert theme_for(np.zeros((8, 8, 4), np.uint8)) is LIGHT


def test_scenes_of_their_own_and_the_plain_look_have_no_stage():
    scene, renderer = staged(settings=Settings({}))
    with renderer:
        renderer.draw(renderer.view())
    assert shadow_of(renderer) is None and renderer.staging.scene.background == scene.background


# ---- the ground is behind the model, and shows from above only ----


FLAT = {
    "plane": lambda: e3d.plane((2.0, 3.0), 1),
    "fine plane": lambda: e3d.plane((2.0, 2.0), 20),
    "tile": lambda: e3d.box((2.0, 0.02, 2.0)),
    "box": lambda: e3d.box((1.0, 1.0, 1.0)),
    "long box": lambda: e3d.box((9.0, 0.3, 0.5)),
    "cylinder": lambda: e3d.cylinder(0.8, 0.5),
}
LOOKS = [(30, 18), (30, 70), (100, 2.0), (200, 0.2), (75, -25)]


def ground_of(scene, size, view_of, **settings):
    """Yield pictures and object ids with the ground, and pictures without it, look by look."""
    settings = Settings({}, look="studio", **settings)
    viewed = ViewedScene(scene, "flat", themed=True)
    with ViewRenderer(viewed, settings, size) as renderer:
        for azimuth, elevation in LOOKS:
            view = renderer.view()
            view.azimuth, view.elevation = math.radians(azimuth), math.radians(elevation)
            view_of(view)
            renderer.fill(view)
            frame = renderer.draw(view, outputs=("color", "object_id"))
            renderer.staging._studio.hide_ground()
            look = (renderer.camera(view), view.pose())
            bare = renderer.renderer.render(
                renderer.staging.scene, look, **renderer._appearance()
            ).color
            yield elevation, frame.color, frame.object_id >= 0, bare


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e9])
@pytest.mark.parametrize("name", FLAT)
def test_the_ground_is_never_drawn_over_the_model(name, scale):
    scene = e3d.Scene()
    place = np.array((0.37, -0.71, 1.9)) * scale
    scene.add(FLAT[name](), scale=scale, translation=place, name=name)

    def orthographic(view):
        view.orthographic = name in ("tile", "box")

    fields = {"near": 1e-3, "far": 1e3} if name == "cylinder" and scale == 1.0 else {}
    for elevation, shown, model, bare in ground_of(scene, (96, 64), orthographic, **fields):
        assert model.any() or elevation < 10
        assert (shown[model] == bare[model]).all(), elevation
        if elevation < 0:
            assert (shown == bare).all()


def test_what_moves_lower_than_before_is_not_hidden_by_the_ground():
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        renderer.draw(view)
        next(iter(scene.nodes)).translation = (0.0, -0.4, 0.0)
        frame = renderer.draw(view, outputs=("color", "object_id"))
        renderer.staging._studio.hide_ground()
        look = (renderer.camera(view), view.pose())
        bare = renderer.renderer.render(
            renderer.staging.scene, look, **renderer._appearance()
        ).color
        model = frame.object_id >= 0
        assert (frame.color[model] == bare[model]).all()


# ---- the shadow ----


def shadow_alphas(mesh, azimuth=0.0, cull="back"):
    scene = e3d.Scene()
    scene.add(mesh)
    up = (0.0, 1.0, 0.0)
    low = float(scene.bounds[0][1])
    bounds = ViewedScene(scene, "model").bounds
    shadow = GroundShadow(StagedScene(scene), e3d.plane(), home_axes(up))
    return shadow.alphas(low, bounds, usual_slant(azimuth), cull).astype(int)


def mushroom():
    """A stem with a wide cap: surfaces of all heights, and a jump between two."""
    profile = [(0.0, 0.3), (0.02, 0.3), (0.25, 0.34), (0.26, 0.9), (0.7, 0.95), (0.9, 0.0)]
    angles = np.linspace(0.0, 2.0 * np.pi, 97)[:-1]
    rings = [[(r * np.cos(a), h, r * np.sin(a)) for a in angles] for h, r in profile]
    count, faces = len(angles), [tuple(range(len(angles)))]
    for ring in range(len(profile) - 1):
        for k in range(count):
            a, b = ring * count + k, ring * count + (k + 1) % count
            faces += [(a, a + count, b), (b, a + count, b + count)]
    triangles = [face for face in faces if len(face) == 3]
    triangles += [(0, k, k + 1) for k in range(1, count - 1)]
    return e3d.Mesh(np.reshape(rings, (-1, 3)), triangles)


def test_no_ring_and_no_step_is_seen_in_the_shadow():
    alphas = shadow_alphas(mushroom(), azimuth=math.pi / 4, cull="none")
    middle = SIDE // 2
    # Towards the viewer the key light's shadow ends first, and the sky's goes on.
    rows = alphas[middle:, middle - 60 : middle + 60]
    assert np.diff(rows, axis=0).max() <= 1  # what gets brighter stays brighter
    steps = max(np.abs(np.diff(alphas, axis=axis)).max() for axis in (0, 1))
    assert steps <= 255 * 0.76 / 5  # at least five texels from dark to light
    assert max(alphas[0].max(), alphas[-1].max(), alphas[:, 0].max(), alphas[:, -1].max()) == 0


def test_the_shadow_of_the_key_light_turns_with_the_viewer():
    places = np.arange(SIDE) - (SIDE - 1) / 2
    for turn in range(4):
        azimuth = 0.3 + turn * math.pi / 2
        alphas = shadow_alphas(e3d.cylinder(0.3, 2.0), azimuth)
        total = alphas.sum()
        x, z = (alphas.sum(0) * places).sum() / total, (alphas.sum(1) * places).sum() / total
        right = x * math.cos(azimuth) - z * math.sin(azimuth)
        back = -x * math.sin(azimuth) - z * math.cos(azimuth)
        assert right < -8 and back > 8  # to the left of the model, and behind it


def test_each_picture_of_a_turn_is_that_from_there():
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        for azimuth in (0.0, 1.0, 1.05, 4.0, 0.0):
            view.azimuth = azimuth
            kept = renderer.draw(view).color.copy()
            other, fresh = staged()
            with fresh:
                assert (fresh.draw(view).color == kept).all()


def moving():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), name="box")
    times = (0.0, 1.0)
    places = np.array([(0.0, 0.0, 0.0), (3.0, 0.4, 0.0)])
    scene.animations["slide"] = AnimationClip([Channel(node, "translation", times, places)])
    viewed = ViewedScene(scene, "moving", themed=True)
    play_clips(viewed)
    return viewed


@pytest.mark.parametrize("switch", ["grid", "axes_grid"])
def test_grids_cast_no_shadow_and_leave_none(switch):
    _, renderer = staged()
    with renderer:
        view = renderer.view()
        before = renderer.draw(view).color.copy()
        shadow = shadow_of(renderer).object.materials[0].texture.pixels.copy()
        if switch == "grid":
            renderer.staging.show_grid(True)
        renderer.settings.axes_grid = switch == "axes_grid"
        assert (renderer.draw(view).color != before).any()
        view.azimuth += 0.5  # the key light turns with it: the shadow is drawn anew
        renderer.draw(view)
        view.azimuth -= 0.5
        renderer.draw(view)
        assert (shadow_of(renderer).object.materials[0].texture.pixels == shadow).all()
        renderer.staging.show_grid(False)
        renderer.settings.axes_grid = False
        assert (renderer.draw(view).color == before).all()


def test_the_shadow_follows_each_picture_of_an_animation():
    settings = Settings({}, look="studio")
    with ViewRenderer(moving(), settings, SIZE) as renderer:
        view, before = renderer.view(), None
        for time in (0.0, 0.03, 0.06, 0.5, 0.03):
            renderer.draw(view, time)
            pixels = shadow_of(renderer).object.materials[0].texture.pixels
            assert before is None or (pixels != before).any()
            before = pixels.copy()
            with ViewRenderer(moving(), settings, SIZE) as fresh:
                fresh.draw(view, time)
                alone = shadow_of(fresh).object.materials[0].texture.pixels
                assert (alone == pixels).all()


@pytest.mark.parametrize(("cull", "casts"), [("back", False), ("none", True), ("front", True)])
def test_faces_that_are_left_out_cast_no_shadow(cull, casts):
    downward = e3d.Mesh([(0, 1, 0), (1, 1, 0), (0, 1, 1)], [(0, 1, 2)])
    assert bool(shadow_alphas(downward, cull=cull).any()) is casts


# ---- the key light ----


def test_both_shadows_of_the_key_light_lie_in_its_direction():
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        for azimuth, elevation in ((0.0, 0.3), (2.0, 0.1), (4.0, 1.2)):
            view.azimuth, view.elevation = azimuth, elevation
            renderer.draw(view)
            direction = renderer.lighting.main_direction()
            axes = home_axes((0.0, 1.0, 0.0))
            across, along = slant_along(direction, axes)
            assert direction[1] < 0 and across * direction[0] > 0 and along * direction[2] > 0
            assert math.hypot(across, along) <= 0.9 + 1e-9
            assert across * direction[2] == pytest.approx(along * direction[0])


def test_light_that_travels_level_casts_the_longest_shadow():
    axes = home_axes((0.0, 1.0, 0.0))
    for direction in ((1.0, 0.0, 0.0), (1.0, 0.3, 0.0), (1.0, -1e-3, 0.0)):
        assert slant_along(np.array(direction), axes) == pytest.approx((0.9, 0.0))
    assert slant_along(np.array((0.0, -1.0, 0.0)), axes) == (0.0, 0.0)


def wall_on_a_floor():
    """A wall on the side of the key light."""
    pose = np.eye(4)
    pose[:3, 3] = 0.9, 0.5, 0.6
    parts = e3d.plane((3.0, 3.0)), e3d.box((0.2, 1.0, 1.0))
    return e3d.Mesh.concatenate(parts, poses=[np.eye(4), pose])


def test_models_cast_soft_shadows_on_themselves():
    pictures = {
        shadow: e3d.render(
            wall_on_a_floor(), size=(240, 180), look=e3d.Look.studio(shadow=shadow)
        ).color
        for shadow in ("map", "exact", "none")
    }
    pictures = {shadow: picture.astype(int) for shadow, picture in pictures.items()}
    darker = (pictures["none"] - pictures["map"])[..., 1]
    assert darker.min() >= -2 and (darker > 25).sum() > 200
    half = (darker > 6) & (darker < darker.max() - 6)  # the soft edge
    hard = (pictures["none"] - pictures["exact"])[..., 1]
    half_hard = (hard > 6) & (hard < hard.max() - 6)
    assert half.sum() > 1.5 * half_hard.sum()


@pytest.mark.parametrize("shape", ["box", "uv_sphere", "icosphere", "cylinder", "torus"])
def test_convex_models_shadow_nothing_that_is_lit(shape):
    mesh = getattr(e3d, shape)()
    pictures = [
        e3d.render(mesh, size=(240, 180), look=e3d.Look.studio(shadow=shadow)).color.astype(int)
        for shadow in ("none", "map")
    ]
    darker = (pictures[0] - pictures[1])[..., 1]
    if shape == "torus":
        assert darker.max() > 10  # its hole is in its shadow
    else:
        assert darker.max() <= 8  # where light only grazes, at most


def test_maps_are_as_fine_as_the_picture():
    for size, side in (((64, 48), 512), ((1280, 720), 1024), ((4000, 3000), 2048)):
        scene, renderer = staged()
        with renderer:
            renderer.size = size
            renderer._light(np.eye(4))
            key = renderer.lighting.groups()[0][0]
            assert (key.shadow, key.shadow_map_size, key.shadow_taps) == ("map", side, 5)
            fill = renderer.lighting.groups()[0][1]
            assert fill.shadow == "none"


def test_the_ground_makes_shadow_maps_no_coarser():
    scene, renderer = staged()
    with renderer:
        renderer.draw(renderer.view())
        assert renderer.staging.scene.data.shadow_bounds().tolist() == scene.bounds.tolist()
        assert (renderer.staging.scene.bounds != scene.bounds).any()


def test_a_polished_floor_reflects_the_model():
    """Below its feet alone: the model keeps its bytes, and so does the background."""
    scene = e3d.Scene()
    scene.add(e3d.box((1, 2, 1)), translation=(0, 3, 0))
    view = e3d.PerspectiveCamera(0.9), e3d.look_at((3, 4, 6), (0, 2, 0))
    names = ("color", "object_id", "depth")
    shadow, mirror = (
        e3d.render(scene, view, size=SIZE, outputs=names, look=e3d.Look.studio(ground=ground))
        for ground in (True, "mirror")
    )
    assert np.array_equal(shadow.depth, mirror.depth)
    changed = np.abs(shadow.color.astype(int) - mirror.color).max(axis=2)
    feet = np.nonzero((shadow.object_id >= 0).any(axis=1))[0].max()
    assert (changed[feet + 1 :] > 10).sum() > 100 and changed[: feet - 20].max() <= 1
    for options in ({"mode": "unlit"}, {"mode": "normal"}, {"mirror_depth": 0}):
        pictures = [
            e3d.render(scene, view, size=SIZE, look=e3d.Look.studio(ground=one), **options).color
            for one in (True, "mirror")
        ]
        assert np.array_equal(*pictures), options


def test_a_mirror_mirrors_in_the_look():
    pane = e3d.plane((4, 4))
    pane.materials = [e3d.Material(mirror=1.0)]
    scene = e3d.Scene()
    red = e3d.box()
    red.materials = [e3d.Material(color="red")]
    scene.add(red, translation=(0, 1, 0))
    scene.add(pane)
    view = e3d.PerspectiveCamera(0.7), e3d.look_at((0, 2, 4), (0, 0, 0))
    color = e3d.render(scene, view, size=SIZE, look=e3d.Look.studio(ground=False)).color
    red, green = (color[55:, 40:80, k].astype(int) for k in (0, 1))
    assert (red > 2 * green).sum() > 200


def test_grounds_are_named():
    assert e3d.Look.studio(ground="mirror").replace(ground=1).ground is True
    with pytest.raises(e3d.InvalidArgumentError, match="ground must be one of .*'mirror'"):
        e3d.Look.studio(ground="wet")
