"""Section 17 of docs/exactness: exact shadows, against rays cast in float64 in NumPy.

A white scene without ambient light is drawn with the shadow and without: where the pictures differ,
the light is hidden. For each pixel a ray goes from its world position to the light, past every
triangle of the scene, from 1e-5 units above its surface: R100 tells that without a bias.
"""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

SIZE = (96, 72)
LIGHTS = ["sun", "point", "spot"]
LEAST_WAY = 1e-5  # world units: rays start so far along their way


@pytest.fixture(params=LIGHTS)
def kind(request):
    return request.param


def white(mesh, **options):
    mesh.materials = [e3d.Material(color=(1, 1, 1), flat_shading=True, **options)]
    return mesh


def rotation(rng):
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.sign(np.linalg.det(q))


def pose_of(turned, offset, scale=1.0):
    pose = np.eye(4)
    pose[:3, :3] = turned * scale
    pose[:3, 3] = offset
    return pose


def add_light(scene, kind, shadow, to=(2.0, 3.5, 1.5)):
    """A light from a place, or from its direction; its shadow, or this and its softness."""
    to = np.asarray(to, np.float64)
    kind_of_shadow, softness = (shadow, 0.0) if isinstance(shadow, str) else shadow
    how = {"shadow": kind_of_shadow, "shadow_softness": softness}
    if kind == "sun":
        scene.add(e3d.DirectionalLight(-to, intensity=np.pi, **how))
    elif kind == "point":
        scene.add(e3d.PointLight(intensity=float(np.pi * to @ to), **how), translation=to)
    else:
        light = e3d.SpotLight(intensity=float(2 * np.pi * to @ to), outer_cone_angle=0.7, **how)
        scene.add(light, pose=e3d.look_at(to, (0, 0, 0)))


def still_life(kind, shadow):
    scene = e3d.Scene(ambient=(0, 0, 0))
    scene.add(white(e3d.plane(6.0)))
    scene.add(white(e3d.box(0.8)), translation=(0, 0.4, 0), euler=(0, 0.6, 0))
    scene.add(white(e3d.icosphere(0.5, 2)), translation=(-0.9, 0.6, 0.5))
    ring = white(e3d.torus(segments=(24, 12)))
    scene.add(ring, translation=(0.9, 1.1, -0.4), euler=(0.9, 0.4, 0))
    add_light(scene, kind, shadow)
    return scene, e3d.look_at((1.2, 2.2, 3.2), (0, 0.3, 0))


def fence(kind, shadow):
    """Thin bars, whose shadows are thinner than pixels."""
    scene = e3d.Scene(ambient=(0, 0, 0))
    scene.add(white(e3d.plane(6.0)))
    for k in range(17):
        scene.add(white(e3d.box((0.02, 0.8, 0.02))), translation=(0.12 * k - 1, 0.4, 0.2))
    scene.add(white(e3d.box((2.2, 0.03, 0.015))), translation=(0, 0.6, 0.2))
    add_light(scene, kind, shadow, (0.6, 1.4, -1.6))
    return scene, e3d.look_at((0.6, 1.6, 2.8), (0, 0, 0.6))


def heap(kind, shadow):
    """Triangles in all directions."""
    rng = np.random.default_rng(27)
    middle = rng.uniform(-1, 1, (150, 1, 3))
    corners = middle + 10.0 ** rng.uniform(-2, -0.4, (150, 1, 1)) * rng.normal(size=(150, 3, 3))
    scene = e3d.Scene(ambient=(0, 0, 0))
    faces = np.arange(450).reshape(-1, 3)
    scene.add(white(e3d.Mesh(corners.reshape(-1, 3), faces), two_sided=True))
    scene.add(white(e3d.plane(6.0)), translation=(0, -1, 0))
    add_light(scene, kind, shadow)
    return scene, e3d.look_at((1.2, 1.9, 3.2), (0, -0.1, 0))


def triangles_of(scene):
    """(N, 3, 3) float64 corners in the world, rounded as R1 and R3 round them."""
    found = []
    for node in scene.nodes:
        if isinstance(node.object, e3d.Mesh):
            world = node.world_pose.astype(np.float32)
            points = node.object.positions
            placed = [
                ((row[0] * points[:, 0] + row[1] * points[:, 1]) + row[2] * points[:, 2]) + row[3]
                for row in world[:3]
            ]
            found.append(np.stack(placed, -1)[node.object.faces])
    return np.concatenate(found).astype(np.float64)


def hits(origins, ways, far, triangles):
    """Whether rays along unit vectors hit a triangle before they end (Moller and Trumbore)."""
    e, f = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    hidden = np.zeros(len(origins), bool)
    for n, (origin, way) in enumerate(zip(origins, ways, strict=True)):
        p = np.cross(way, f)
        with np.errstate(all="ignore"):
            det = (e * p).sum(-1)
            s = origin - triangles[:, 0]
            u = (s * p).sum(-1) / det
            q = np.cross(s, e)
            v = (q @ way) / det
            t = (f * q).sum(-1) / det
        hidden[n] = ((u >= 0) & (v >= 0) & (u + v <= 1) & (t > LEAST_WAY) & (t < far[n])).any()
    return hidden


def picture(make, kind, shadow, backend="auto", threads=2, **options):
    scene, pose = make(kind, shadow)
    camera = (e3d.PerspectiveCamera(), pose)
    outputs = ("color", "world_position", "face_id")
    return render(
        scene, camera, size=SIZE, backend=backend, threads=threads, outputs=outputs, **options
    )


def hidden_and_lit(make, kind, **options):
    """Where the light would reach a pixel if nothing were in between, and where it is hidden."""
    open_, shadowed = (picture(make, kind, shadow, **options) for shadow in ("none", "exact"))
    lit = open_.color[..., :3].any(-1)
    changed = (open_.color != shadowed.color).any(-1)
    assert not shadowed.color[changed][..., :3].any()  # wholly, or not at all
    return changed, lit, open_.world_position


@pytest.mark.parametrize("make", [still_life, fence, heap])
def test_like_rays_cast_in_float64(make, kind):
    hidden, lit, position = hidden_and_lit(make, kind)
    origins = position[lit].astype(np.float64)
    scene, _ = make(kind, "exact")
    to = np.array((0.6, 1.4, -1.6) if make is fence else (2.0, 3.5, 1.5))
    ways = np.broadcast_to(to, origins.shape) if kind == "sun" else to - origins
    far = np.linalg.norm(ways, axis=1)
    ends = far if kind != "sun" else np.full(len(far), np.inf)
    by_rays = hits(origins, ways / far[:, None], ends, triangles_of(scene))
    assert 0.02 < hidden[lit].mean() < 0.9
    np.testing.assert_array_equal(by_rays, hidden[lit])


def test_flat_and_convex_surfaces_are_never_in_their_own_shadow(kind):
    rng = np.random.default_rng(3)
    meshes = [white(e3d.plane(2.0, 24)), white(e3d.icosphere(1.0, 3)), white(e3d.box((1, 2, 0.5)))]
    for trial in range(12):
        scale = 10.0 ** rng.uniform(-2, 2)
        offset = rng.normal(size=3) * scale * 10.0 ** rng.uniform(-1, 2)
        turned, to = rotation(rng), scale * 4 * rng.normal(size=3)
        pictures = []
        for shadow in ("none", "exact"):
            scene = e3d.Scene(ambient=(0, 0, 0))
            scene.add(meshes[trial % 3], pose=pose_of(turned, offset, scale))
            if kind == "sun":
                scene.add(e3d.DirectionalLight(-to, shadow=shadow))
            else:
                lamp = e3d.PointLight(intensity=10 * np.pi * scale * scale, shadow=shadow)
                scene.add(lamp, translation=offset + to)
            eye = e3d.look_at(offset + scale * np.array((2.0, 2.4, 3.0)), offset)
            pictures.append(render(scene, (e3d.PerspectiveCamera(), eye), size=SIZE).color)
        np.testing.assert_array_equal(*pictures)


def test_shadows_begin_where_things_touch():
    """A wall on a floor: seen from above, no lit pixel is between the wall and its shadow."""
    for turned in (np.eye(3), rotation(np.random.default_rng(5))):
        rows = []
        for shadow in ("none", "exact"):
            scene = e3d.Scene(background=(255, 0, 0), ambient=(0, 0, 0))
            root = scene.add(None, pose=pose_of(turned, (3.0, -2.0, 5.0)))
            scene.add(white(e3d.plane(4.0)), parent=root)
            wall = white(e3d.box((2.0, 1.0, 0.1)))
            scene.add(wall, translation=(0, 0.5, 0), parent=root)
            light = e3d.DirectionalLight((0, -1, -1), shadow=shadow)
            scene.add(light, parent=root)
            pose = pose_of(turned, (3.0, -2.0, 5.0)) @ e3d.look_at(
                (0, 5, 0), (0, 0, 0), up=(0, 0, -1)
            )
            camera = e3d.OrthographicCamera(0.4), pose
            frame = render(scene, camera, size=(8, 400))
            rows.append(frame.color[:, 4, 0].astype(int))
        hidden = rows[1] < rows[0]
        # From the top: floor in shadow, then the wall's top.
        first = np.flatnonzero(hidden)
        assert len(first) > 100 and first[0] == 0
        assert hidden[: first[-1] + 1].all()
        assert not hidden[first[-1] + 1 :].any()
        assert first[-1] + 1 == round(400 * (0.5 - 0.05 / 0.8))


def count_hidden(scene, size=(64, 64), **options):
    camera = (e3d.PerspectiveCamera(), e3d.look_at((0, 3, 0.001), (0, 0, 0)))
    frame = render(scene, camera, size=size, **options)
    return int((frame.color[..., 0] == 0).sum())


def floor_and_caster(mesh, **options):
    scene = e3d.Scene(background=(9, 9, 9), ambient=(0, 0, 0))
    scene.add(white(e3d.plane(20.0)))
    scene.add(mesh, translation=(0, 6, 0), **options)  # above the camera
    scene.add(e3d.DirectionalLight((0, -1, 0), shadow="exact"))
    return scene


def test_what_is_not_in_view_casts():
    assert count_hidden(floor_and_caster(white(e3d.box(1.0)))) > 100


def test_either_side_casts():
    sheet = white(e3d.plane(1.0))
    both = [count_hidden(floor_and_caster(sheet, euler=(turn, 0, 0))) for turn in (0, np.pi)]
    assert both[0] == both[1] > 100


def test_switches_of_nodes():
    caster = white(e3d.box(1.0))
    assert count_hidden(floor_and_caster(caster, cast_shadows=False)) == 0
    scene = floor_and_caster(caster)
    for node in scene.nodes:
        node.receive_shadows = False
    assert count_hidden(scene) == 0


def test_holes_let_light_through():
    texture = np.full((2, 2, 4), 255, np.uint8)
    texture[0, 0, 3] = texture[1, 1, 3] = 0
    sheet = e3d.plane(1.0)
    whole = white(e3d.plane(1.0))
    holes = e3d.Texture(texture, filter="nearest")
    sheet.materials = [e3d.Material(texture=holes, alpha_mode="mask", alpha_cutoff=0.5)]
    half, all_ = count_hidden(floor_and_caster(sheet)), count_hidden(floor_and_caster(whole))
    assert abs(2 * half - all_) <= 16


@pytest.mark.parametrize(("alpha", "casts"), [(0.49, False), (0.5, True), (1.0, True)])
def test_what_is_blended_casts_from_half_on(alpha, casts):
    sheet = e3d.plane(1.0)
    sheet.materials = [e3d.Material(color=(1, 1, 1, alpha), alpha_mode="blend")]
    assert (count_hidden(floor_and_caster(sheet)) > 100) == casts


def test_what_is_blended_receives():
    scene = floor_and_caster(white(e3d.box(1.0)))
    glass = e3d.plane(20.0)
    glass.materials = [e3d.Material(color=(1, 1, 1, 0.5), alpha_mode="blend")]
    scene.add(glass, translation=(0, 1, 0))
    assert count_hidden(scene) > 100


def test_casters_that_move_are_found_again():
    scene = floor_and_caster(white(e3d.box(1.0)))
    box = list(scene.nodes)[1]
    camera = (e3d.PerspectiveCamera(), e3d.look_at((0, 3, 0.001), (0, 0, 0)))
    with Renderer((64, 64)) as renderer:
        frames = []
        for x in (0.0, 0.5, 0.5, 40.0):
            box.translation = (x, 6, 0)
            frames.append(renderer.render(scene, camera).color.copy())
            fresh = render(scene, camera, size=(64, 64)).color
            np.testing.assert_array_equal(frames[-1], fresh)
    assert (frames[0] != frames[1]).any()
    assert frames[3].min() > 0


def test_casters_whose_mesh_or_material_changes_are_found_again():
    mesh = white(e3d.box(1.0))
    scene = floor_and_caster(mesh)
    camera = (e3d.PerspectiveCamera(), e3d.look_at((0, 3, 0.001), (0, 0, 0)))
    with Renderer((64, 64)) as renderer:
        counts = []
        for change in ("none", "mesh", "material"):
            if change == "mesh":
                mesh.positions = mesh.positions * np.float32(1.5)
            elif change == "material":
                mesh.materials[0].alpha_mode = "blend"
                mesh.materials[0].color = (1, 1, 1, 0.2)
            color = renderer.render(scene, camera).color
            np.testing.assert_array_equal(color, render(scene, camera, size=(64, 64)).color)
            counts.append(int((color[..., 0] == 0).sum()))
    assert counts[1] > counts[0] > 100 > counts[2] == 0


def test_at_most_32_lights():
    scene = floor_and_caster(white(e3d.box(1.0)))
    for _ in range(31):
        scene.add(e3d.DirectionalLight((0, -1, 0), intensity=0.01 * np.pi, shadow="exact"))
    assert count_hidden(scene) > 100
    scene.add(e3d.DirectionalLight((0, -1, 0), shadow="exact"))
    with pytest.raises(e3d.InvalidArgumentError, match="at most 32 lights"):
        count_hidden(scene)


def test_lights_with_maps_and_exact_ones_side_by_side():
    scene = floor_and_caster(white(e3d.box(1.0)))
    scene.add(e3d.DirectionalLight((0.4, -1, 0), color=(0, 1, 0), shadow="map"))
    scene.add(e3d.DirectionalLight((-0.4, -1, 0), color=(0, 0, 1), shadow="exact"))
    camera = (e3d.PerspectiveCamera(), e3d.look_at((0, 3, 0.001), (0, 0, 0)))
    pictures = [
        render(scene, camera, size=(64, 64), backend=backend).color for backend in e3d.backends()
    ]
    for other in pictures[1:]:
        np.testing.assert_array_equal(pictures[0], other)


def round_body(kind, shadow, subdivisions=1):
    """A coarse ball with smooth normals."""
    scene = e3d.Scene(ambient=(0, 0, 0))
    ball = e3d.icosphere(1.0, subdivisions)
    ball.materials = [e3d.Material(color=(1, 1, 1))]
    scene.add(ball)
    add_light(scene, kind, shadow, (2.0, 3.5, -1.5))
    return scene, e3d.look_at((0.4, 0.6, 3.6), (0, 0, 0))


@pytest.mark.parametrize("subdivisions", [0, 1, 2, 3])
def test_a_round_body_shades_as_its_normals_say(kind, subdivisions):
    """R194: its faces are flat, but throw no shadows on one another."""

    def make(kind, shadow):
        return round_body(kind, shadow, subdivisions)

    changed, lit, _ = hidden_and_lit(make, kind)
    assert lit.sum() > 200
    assert not changed.any()


@pytest.mark.parametrize("inside_out", [False, True])
def test_walls_close_to_a_round_body_hide_the_light(kind, inside_out):
    """R194: rays that begin beyond walls, nearer than the roundness, find them all the same."""
    scene, pose = round_body(kind, "exact")
    ball = next(node.object for node in scene.nodes if isinstance(node.object, e3d.Mesh))
    ball.materials = [e3d.Material(color=(1, 1, 1), two_sided=True)]
    faces = ball.faces[:, ::-1] if inside_out else ball.faces
    skin = e3d.Mesh(ball.positions * np.float32(1.001), faces)
    skin.materials = [e3d.Material(color=(0, 0, 0))]
    scene.add(skin)
    camera = e3d.PerspectiveCamera(), pose
    frame = render(
        scene,
        camera,
        size=SIZE,
        outputs=("color", "face_id", "object_id"),
        cull="back" if inside_out else "front",  # the near half of the skin
    )
    shown = frame.object_id == frame.object_id[SIZE[1] // 2, SIZE[0] // 2]
    assert shown.sum() > 1000
    assert not frame.color[..., :3].any()


POINTS = 32  # of a soft light's disc


def points_of_disc(ways, cosines, size):
    """R196 and R197 in float64: from the light's middle to each point, (samples, points, 3)."""
    number = np.arange(POINTS)
    angle, radius = number * np.pi * (3 - np.sqrt(5)), np.sqrt((number + 0.5) / POINTS)
    x, y = (np.rint(1024 * radius * f(angle)) / 1024 for f in (np.cos, np.sin))
    length = np.linalg.norm(ways, axis=1)
    size = np.minimum(size, 0.5 * cosines * length)[:, None]
    axis = np.abs(ways).argmax(1)
    k, rows = np.stack([axis, (axis + 1) % 3, (axis + 2) % 3]), np.arange(len(ways))
    e = np.zeros_like(ways)
    e[rows, k[0]], e[rows, k[1]] = -ways[rows, k[1]], ways[rows, k[0]]
    f = np.cross(ways, e)
    e, f = (size * v / np.linalg.norm(v, axis=1, keepdims=True) for v in (e, f))
    return x[:, None] * e[:, None] + y[:, None] * f[:, None]


def shares(make, kind, softness, step=20, **options):
    """How much of the light reaches every so many-th pixel that it lights, positions, normals."""
    outputs = ("radiance", "world_position", "world_normal")
    frames = []
    for shadow in ("none", ("exact", softness)):
        scene, pose = make(kind, shadow)
        camera = (e3d.PerspectiveCamera(), pose)
        frames.append(render(scene, camera, size=SIZE, outputs=outputs, **options))
    lit = frames[0].radiance[..., 1] > 1e-4
    without, within = (frame.radiance[lit][::step, 1].astype(np.float64) for frame in frames)
    share = within / without
    return share, frames[0].world_position[lit][::step], frames[0].world_normal[lit][::step]


@pytest.mark.parametrize(("make", "softness"), [(still_life, 0.2), (fence, 0.06), (heap, 0.5)])
def test_soft_lights_like_rays_cast_in_float64(make, softness, kind):
    """R198: so many of a disc's points are hidden as rays to them tell."""
    share, origins, normals = shares(make, kind, softness)
    origins = origins.astype(np.float64)
    scene, _ = make(kind, "exact")
    to = np.array((0.6, 1.4, -1.6) if make is fence else (2.0, 3.5, 1.5))
    ways = np.broadcast_to(to / np.linalg.norm(to), origins.shape)
    ways = ways if kind == "sun" else to - origins
    cosines = (ways * normals).sum(1) / np.linalg.norm(ways, axis=1)
    size = np.tan(softness / 2) if kind == "sun" else softness
    ways = (ways[:, None] + points_of_disc(ways, cosines, size)).reshape(-1, 3)
    far = np.linalg.norm(ways, axis=1)
    ends = far if kind != "sun" else np.full(len(far), np.inf)
    hidden = hits(np.repeat(origins, POINTS, 0), ways / far[:, None], ends, triangles_of(scene))
    counts = POINTS - hidden.reshape(-1, POINTS).sum(1)
    differ = np.abs(np.rint(share * POINTS) - counts)
    assert np.abs(share * POINTS - np.rint(share * POINTS)).max() < 1e-3
    assert differ.max() <= 2 and (differ > 0).mean() < 0.02  # rays that graze an edge
    assert ((counts > 0) & (counts < POINTS)).sum() > 3


@pytest.mark.parametrize("softness", [0.08, 0.5])
def test_a_soft_light_throws_no_steps_on_a_round_body(kind, softness):
    """R198: where light grazes its faces, what lies behind a sample hides none of it."""

    def make(kind, shadow):
        scene = e3d.Scene(ambient=(0, 0, 0))
        ball = e3d.uv_sphere(1.0, (16, 8))
        ball.materials = [e3d.Material(color=(1, 1, 1))]
        scene.add(ball)
        scene.add(white(e3d.plane(8.0)), translation=(0, -1, 0))
        add_light(scene, kind, shadow, (3.2, 2.8, 1.2))
        return scene, e3d.look_at((1.0, 1.0, 3.6), (0, 0, 0))

    share, _, normals = shares(make, kind, softness, step=1)
    of_body = normals[:, 1] < 0.999
    assert of_body.sum() > 200
    assert share[of_body].min() == 1.0


def test_a_light_of_hardly_any_size_shades_as_one_without(kind):
    hard, soft = (picture(still_life, kind, how) for how in ("exact", ("exact", 1e-6)))
    assert (hard.color != soft.color).any(-1).mean() < 0.01


def test_a_renderer_that_drew_hard_shadows_draws_soft_ones_and_back(kind):
    """Neither grids nor trees of other lights or of earlier casters show."""
    with Renderer(SIZE) as renderer:
        for make in (still_life, heap, still_life):
            for shadow in ("exact", ("exact", 0.2), ("exact", 0.1), "exact"):
                scene, pose = make(kind, shadow)
                for height in (0.0, 0.4):
                    scene.nodes[1].translation = (0, 0.4 + height, 0)
                    seen = renderer.render(scene, (e3d.PerspectiveCamera(), pose)).color
                    fresh = render(scene, (e3d.PerspectiveCamera(), pose), size=SIZE).color
                    np.testing.assert_array_equal(seen, fresh)
