"""Area lights against integrals over their surfaces in NumPy, and what their parameters do."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.lights import DiscLight, RectangleLight, TubeLight

POINTS = 120  # across a light, for the integrals
LIGHTS = {
    "rectangle": RectangleLight(intensity=3.0, width=1.2, height=0.7),
    "disc": DiscLight(intensity=3.0, radius=0.5),
    "tube": TubeLight(intensity=3.0, length=1.5, radius=0.08),
}
DOWN = e3d.look_at((0.3, 1.2, -0.4), (0, 0, 0.2), (0, 0, 1))
ASIDE = e3d.look_at((1.5, 1.8, 1.5), (0, 0, 0), (0, 1, 0))


def points_of(light):
    """Points of a light's surface in its node, their normals, and the area of each."""
    steps = (np.arange(POINTS) + 0.5) / POINTS
    if isinstance(light, RectangleLight):
        x, y = np.meshgrid((steps - 0.5) * light.width, (steps - 0.5) * light.height)
        points, normals = np.stack([x, y, 0 * x], -1), np.stack([0 * x, 0 * x, 0 * x - 1], -1)
    elif isinstance(light, DiscLight):
        r, turn = np.meshgrid(np.sqrt(steps) * light.radius, 2 * np.pi * steps)
        points = np.stack([r * np.cos(turn), r * np.sin(turn), 0 * r], -1)
        normals = np.stack([0 * r, 0 * r, 0 * r - 1], -1)
    else:
        x, turn = np.meshgrid((steps - 0.5) * light.length, 2 * np.pi * steps)
        normals = np.stack([0 * x, np.cos(turn), np.sin(turn)], -1)
        points = normals * light.radius + np.stack([x, 0 * x, 0 * x], -1)
    return points.reshape(-1, 3), normals.reshape(-1, 3), light.area / POINTS**2


def reflected(n, v, l, look):  # noqa: E741
    """The BRDF of R31 or R51 times n . l."""
    nl, nv, h = l @ n, abs(n @ v), l + v
    h /= np.linalg.norm(h, axis=1)[:, None]
    nh, vh = h @ n, h @ v
    if "roughness" not in look:
        return (look["color"] * nl + look["specular"] * np.maximum(nh, 0) ** 30) / np.pi
    a, metallic, color = look["roughness"] ** 4, look["metallic"], look["color"]
    distribution = a / (np.pi * (nh * nh * (a - 1) + 1) ** 2)
    smith = nv * np.sqrt(a + (1 - a) * nl * nl) + nl * np.sqrt(a + (1 - a) * nv * nv)
    f0, schlick = 0.04 + (color - 0.04) * metallic, (1 - vh) ** 5
    diffuse = color * (1 - metallic) / np.pi * (1 - (0.04 + 0.96 * schlick))
    return nl * (diffuse + distribution * 0.5 / smith * (f0 + (1 - f0) * schlick))


def drawn_and_true(light, mesh, pose, look, eye):
    """The radiance of a few samples, as drawn and by integrals."""
    given = {name: look[name] for name in ("metallic", "roughness") if name in look}
    if "specular" in look:
        given = {"specular": (look["specular"],) * 3, "shininess": 30.0}
    mesh.materials = [e3d.Material(color=(look["color"],) * 3, **given)]
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    scene.add(mesh)
    scene.add(light, pose=pose)
    scene.add(e3d.PerspectiveCamera(yfov=0.7), pose=e3d.look_at(eye, (0, 0, 0)))
    outputs = ("radiance", "world_position", "world_normal", "object_id")
    renderer = e3d.Renderer((16, 16), color_space="linear")
    frame = renderer.render(scene, outputs=outputs, specular_antialiasing=False)
    shown = np.argwhere(frame.object_id >= 0)[::3]
    points, facing, area = points_of(light)
    points, facing = points @ pose[:3, :3].T + pose[:3, 3], facing @ pose[:3, :3].T
    true = []
    for row, column in shown:
        p = frame.world_position[row, column].astype(np.float64)
        n = frame.world_normal[row, column].astype(np.float64)
        n, v, d = n / np.linalg.norm(n), eye - p, points - p
        square = (d * d).sum(1)
        l = d / np.sqrt(square)[:, None]  # noqa: E741
        cosine = -(l * facing).sum(1)
        lit = (cosine > 0) & (l @ n > 0)
        light_in = cosine[lit] * area / square[lit]
        arrives = reflected(n, v / np.linalg.norm(v), l[lit], look) * light_in
        true.append(light.intensity * arrives.sum())
    return frame.radiance[..., 0][tuple(shown.T)], np.array(true)


# The error that remains is that of one transformed cosine for all of GGX, greatest at grazing
# angles; that of the tube is that of its ends, which are seen as those of a rectangle.
@pytest.mark.parametrize(
    ("look", "bound"),
    [
        ({"color": 0.8, "specular": 0.0}, 0.001),
        ({"color": 0.0, "specular": 0.8}, 0.21),
        ({"color": 0.8, "metallic": 0.0, "roughness": 0.5}, 0.035),
        ({"color": 0.9, "metallic": 1.0, "roughness": 0.35}, 0.06),
        ({"color": 0.9, "metallic": 1.0, "roughness": 0.6}, 0.12),
        ({"color": 0.9, "metallic": 1.0, "roughness": 1.0}, 0.06),
    ],
    ids=["matt", "shiny", "plastic", "metal", "rough metal", "roughest metal"],
)
@pytest.mark.parametrize("shape", ["plane", "ball"])
@pytest.mark.parametrize("kind", LIGHTS)
def test_radiance_is_the_integral(kind, shape, look, bound):
    mesh = e3d.plane((4, 4)) if shape == "plane" else e3d.uv_sphere(1.0)
    pose = DOWN if shape == "plane" else ASIDE
    drawn, true = drawn_and_true(LIGHTS[kind], mesh, pose, look, np.array([0.0, 1.6, 4.0]))
    assert true.max() > 0.01
    mean = abs(drawn - true).mean() / true.mean()
    assert mean < bound + (0.03 if kind == "tube" else 0.0)


def seen_below(light, pose, distance=0.0, **given):
    """The radiance in the middle of a white matt floor."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    floor = e3d.plane((40, 40))
    floor.materials = [e3d.Material(color=(1, 1, 1), **given)]
    scene.add(floor)
    scene.add(light, pose=pose)
    eye = e3d.look_at((distance, 3, 0.001), (distance, 0, 0), (0, 0, -1))
    scene.add(e3d.PerspectiveCamera(yfov=0.1), pose=eye)
    return e3d.Renderer((1, 1)).render(scene, outputs=("radiance",)).radiance[0, 0, 0]


def overhead(height):
    return e3d.look_at((0, height, 0), (0, 0, 0), (0, 0, 1))


def test_a_light_that_fills_the_sky_shows_its_intensity():
    light = RectangleLight(intensity=2.0, width=2000, height=2000)
    assert seen_below(light, overhead(1.0)) == pytest.approx(2.0, rel=1e-3)


@pytest.mark.parametrize("kind", ["rectangle", "disc"])
@pytest.mark.parametrize(
    "given", [{}, {"metallic": 0.0, "roughness": 0.7}], ids=["matt", "physical"]
)
def test_far_away_it_is_a_point(kind, given):
    light = LIGHTS[kind]
    point = e3d.PointLight(intensity=light.intensity * light.area)
    pose = overhead(30.0)
    expected = seen_below(point, pose, **given)
    assert seen_below(light, pose, **given) == pytest.approx(expected, rel=0.01)


def test_rectangles_and_discs_shine_to_one_side():
    up = e3d.look_at((0, 1, 0), (0, 2, 0), (0, 0, 1))
    assert seen_below(LIGHTS["rectangle"], up) == seen_below(LIGHTS["disc"], up) == 0.0
    assert seen_below(LIGHTS["tube"], up) > 0.0


def test_nothing_arrives_beyond_the_range():
    near = DiscLight(radius=0.2, range=2.0)
    far = DiscLight(radius=0.2)
    assert seen_below(near, overhead(2.01)) == 0.0
    assert 0.0 < seen_below(near, overhead(1.9)) < seen_below(far, overhead(1.9))


def test_nodes_scale_no_light():
    pose = overhead(1.5)
    scaled = pose @ np.diag([3.0, 0.5, 2.0, 1.0])
    for light in LIGHTS.values():
        assert seen_below(light, scaled) == pytest.approx(seen_below(light, pose), rel=1e-5)


@pytest.mark.parametrize("light", [RectangleLight(), DiscLight(), TubeLight()])
def test_power(light):
    assert light.power == pytest.approx(math.pi * light.area)
    version = light.version
    light.power = 100.0
    assert light.intensity == pytest.approx(100.0 / (math.pi * light.area))
    assert light.version > version
    with pytest.raises(e3d.errors.InvalidArgumentError, match="power"):
        light.power = -1.0


@pytest.mark.parametrize(
    "bad",
    [
        lambda: RectangleLight(width=0),
        lambda: RectangleLight(height=-1),
        lambda: DiscLight(radius=math.nan),
        lambda: TubeLight(length=0),
        lambda: TubeLight(range=0),
    ],
)
def test_bad_sizes(bad):
    with pytest.raises(e3d.errors.InvalidArgumentError):
        bad()


@pytest.mark.parametrize("kind", LIGHTS)
def test_shadows_are_as_soft_as_the_light_is_large(kind):
    """What hides nothing changes nothing; a wall hides; a larger light has wider penumbrae."""
    given = {"shadow": "map", "shadow_map_size": 512}
    sizes = {
        "rectangle": [RectangleLight(width=w, height=w, **given) for w in (0.1, 0.6)],
        "disc": [DiscLight(radius=r, **given) for r in (0.06, 0.35)],
        "tube": [TubeLight(length=n, radius=0.02, **given) for n in (0.1, 1.2)],
    }
    widths = []
    for light in sizes[kind]:
        scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
        scene.add(e3d.plane((6, 6)))
        scene.add(e3d.box((1.5, 0.02, 3)), translation=(-0.75, 0.6, 0))
        scene.add(light, pose=overhead(2.0))
        eye = e3d.look_at((0, 0.5, 0.001), (0, 0, 0), (0, 0, -1))
        scene.add(e3d.PerspectiveCamera(yfov=1.4), pose=eye)
        outputs = ("radiance",)
        renderer = e3d.Renderer((96, 96))
        shown = renderer.render(scene, outputs=outputs).radiance[48, :, 0]
        light.shadow = "none"
        lit = renderer.render(scene, outputs=outputs).radiance[48, :, 0]
        share = shown / lit
        assert share.min() == 0.0 and share.max() == pytest.approx(1.0)
        widths.append(((share > 0.1) & (share < 0.9)).sum())
    assert widths[1] > widths[0]


def test_scene_files_hold_them(tmp_path):
    scene = e3d.Scene()
    given = [
        RectangleLight("red", 2.0, 3.0, 0.5, 9.0, shadow="map"),
        DiscLight(radius=0.3),
        TubeLight(intensity=5.0, length=2.0, radius=0.01),
    ]
    for light in given:
        scene.add(light, translation=(1, 2, 3))
    e3d.save_scene(scene, tmp_path / "lights.e3d.json")
    back = [node.object for node in e3d.load_scene(tmp_path / "lights.e3d.json").nodes]
    assert list(map(type, back)) == list(map(type, given))
    for read, light in zip(back, given, strict=True):
        assert (read.halves(), read.power, read.range) == (light.halves(), light.power, light.range)
        assert read.shadow == light.shadow


@pytest.mark.parametrize("light", [RectangleLight(), DiscLight(), TubeLight()])
def test_gltf_tells_that_it_does_not_hold_them(tmp_path, light):
    scene = e3d.Scene()
    scene.add(e3d.box(1.0))
    scene.add(light, name="panel")
    with pytest.warns(e3d.errors.Engine3DWarning, match=f"panel.*{type(light).__name__}"):
        e3d.save_scene(scene, tmp_path / "scene.glb")


def test_a_tube_lies_along_its_x_whatever_its_parents_do():
    scene = e3d.Scene()
    tube, turned = TubeLight(intensity=50.0, length=2.0, radius=0.05), e3d.linalg.rotation_y(0.7)
    node = scene.add(tube, parent=scene.add(scale=(1, 1, 3)), pose=turned)
    along = node.world_pose[:3, 0] / np.linalg.norm(node.world_pose[:3, 0])
    assert abs(along[2]) > 0.9  # by the parent's scale
    scene.add(e3d.box((40, 0.1, 40)), translation=(0, -0.5, 0))
    frame = e3d.render(
        scene,
        (e3d.OrthographicCamera(3.0), e3d.look_at((0, 5, 0), (0, 0, 0), (0, 0, -1))),
        size=(61, 61),
        outputs=("radiance",),
        look="plain",
    )
    y, x = np.mgrid[-30:31, -30:31]
    light = frame.radiance[..., 1] ** 4
    spread = [np.average(k**2, weights=light) for k in (x, y)]
    assert spread[1] > 2 * spread[0]
