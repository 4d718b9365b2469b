"""Refraction: what is behind glass is bent and blurred, and nothing else."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg

SIZE = 160, 120
CLEAR = {"metallic": 0.0, "roughness": 0.0, "transmission": 1.0}


def material(mesh, **values):
    mesh.materials = [e3d.Material(**values)]
    return mesh


def flat(color, size=(1.0, 1.0), **values):
    """An unlit square in the plane z = 0, which faces the viewer."""
    mesh = e3d.Mesh.from_polygons(square(*size), [(0, 1, 2, 3)])
    return material(mesh, color=color, unlit=True, **values)


def square(width, height):
    x, y = width / 2, height / 2
    return np.array([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], np.float32)


def pane(size=(2.0, 2.0), **values):
    mesh = e3d.Mesh.from_polygons(square(*size), [(0, 1, 2, 3)])
    return material(mesh, **{**CLEAR, **values}, two_sided=True)


def camera(orthographic=True):
    lens = e3d.OrthographicCamera(1.5) if orthographic else e3d.PerspectiveCamera(0.6)
    return lens, e3d.look_at((0, 0, 5), (0, 0, 0))


def stripes():
    """Black to the left of x = 0, white to the right, at z = -1; seen through a pane at z = 0."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    scene.add(flat((255, 255, 255), (4, 8)), translation=(2, 0, -1))
    scene.add(e3d.DirectionalLight(direction=(0, 1, 0), intensity=1e-9))  # no headlight's gloss
    return scene


def shot(scene, orthographic=True, **options):
    return render(scene, camera(orthographic), size=SIZE, **options)


def edge(frame, row=60):
    """The first white column of a row."""
    return int(np.argmax(frame.color[row, :, 0] > 127))


def test_thin_clear_glass_keeps_its_bytes():
    scene = stripes()
    scene.add(pane(ior=1.8))
    plain = shot(scene, refraction=False, outputs=("color", "radiance"))
    frame = shot(scene, outputs=("color", "radiance"))
    assert np.array_equal(frame.color, plain.color)
    assert np.array_equal(frame.radiance, plain.radiance)


@pytest.mark.parametrize("orthographic", [True, False])
@pytest.mark.parametrize("ior", [1.0, 1.3, 1.8])
def test_an_edge_shifts_as_snell_says(orthographic, ior):
    """Behind a pane turned by 40 degrees."""
    scene, turn = stripes(), np.radians(40)
    scene.add(
        pane((1.5, 1.5), thickness=0.5, ior=ior),
        rotation=e3d.linalg.quaternion_from_axis_angle((0, 1, 0), turn),
    )
    plain, frame = shot(scene, orthographic, refraction=False), shot(scene, orthographic)
    # The ray (0, 0, -1) enters at the angle `turn`, and leaves at asin(sin(turn)/ior) from -n.
    normal = np.array([np.sin(turn), 0, np.cos(turn)])
    inside, to = np.arcsin(np.sin(turn) / ior), np.array([0, 0, -1.0])
    along = to + normal * np.cos(turn)
    ray = (along / max(np.linalg.norm(along), 1e-9)) * np.sin(inside) - normal * np.cos(inside)
    end = 0.5 * ray
    pixels = SIZE[1] / 3.0 if orthographic else SIZE[1] / (2 * np.tan(0.3)) / (5 - end[2])
    assert edge(plain) - edge(frame) == pytest.approx(end[0] * pixels, abs=1.2)
    outside = plain.color[:10]
    assert np.array_equal(frame.color[:10], outside)


def test_panes_add_up():
    """Two thin ones shift as one that is twice as thick, whatever their order in the scene."""
    frames = []
    for depths in ((0.4,), (0.2, 0.2), (0.1, 0.3)):
        scene, turn = stripes(), e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.radians(50))
        for number, depth in enumerate(depths):
            scene.add(
                pane(thickness=depth, ior=1.4), rotation=turn, translation=(0, 0, 0.1 * number)
            )
        frames.append(edge(shot(scene)))
    assert frames[0] != edge(shot(stripes()))
    assert max(frames) - min(frames) <= 1


def test_rough_glass_blurs():
    """The edge becomes a slope, wider the rougher; far from it nothing changes."""
    widths = []
    for roughness in (0.0, 0.15, 0.3):
        scene = stripes()
        scene.add(pane((3, 3), roughness=roughness, color=(255, 255, 255)))
        row = shot(scene).color[60, :, 0].astype(int)
        widths.append(int(((row > row.max() * 0.1) & (row < row.max() * 0.9)).sum()))
        assert (np.diff(row) >= -2).all()
    assert widths[0] <= 1 < widths[1] < widths[2]


def test_a_body_blurs_once_a_thin_wall_always():
    """Backs of what has a thickness do not blur."""
    for thickness, blurs in ((0.0, True), (1e-6, False)):
        scene = stripes()
        turned = e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.pi)
        scene.add(pane((3, 3), roughness=0.5, thickness=thickness), rotation=turned)
        same = np.array_equal(shot(scene).color, shot(scene, refraction=False).color)
        assert same is not blurs


def test_nothing_in_front_shows_in_glass():
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    scene.add(flat((0, 0, 255), (9, 9)), translation=(0, 0, -2))
    turn = e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.radians(45))
    scene.add(pane((1.5, 1.5), thickness=0.6), rotation=turn)
    behind = shot(scene).color
    scene.add(flat((255, 0, 0), (0.3, 0.3)), translation=(0, 0, 2))
    frame = shot(scene).color
    changed = (frame != behind).any(axis=-1)
    assert (frame[changed][:, 0] > 200).all() and changed.any()  # the red square itself, no ghost


def test_dispersion_parts_the_colours():
    scene, turn = stripes(), e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.radians(55))
    glass = pane((2.5, 2.5), thickness=1.0, ior=1.6)
    scene.add(glass, rotation=turn)
    grey = shot(scene).color[60]
    assert (grey[:, 0] == grey[:, 2]).all()
    glass.materials[0].dispersion = 8.0
    row = shot(scene).color[60].astype(int)
    red, blue = (int(np.argmax(row[:, c] > 127)) for c in (0, 2))
    assert red != blue and abs(row[:, 0] - row[:, 2]).max() > 100


def test_beyond_the_picture_is_the_environment():
    """Glass at the edge shows the sky that a picture of twice the size has there."""
    sky = np.random.default_rng(2).uniform(0, 1, (8, 16, 3)).astype(np.float32)
    scene = e3d.Scene(background=e3d.Environment(sky), ambient=(0, 0, 0))
    scene.add(material(e3d.uv_sphere(1.5, (48, 24)), **CLEAR, thickness=2.0))
    shots = []
    for tangent, side in ((0.25, 80), (0.5, 160)):
        lens = e3d.PerspectiveCamera(2 * np.arctan(tangent))
        place = e3d.look_at((0.4, 0, 5), (0.4, 0, 0))
        shots.append(render(scene, (lens, place), size=(side, side)).color.astype(int))
    small, middle = shots[0], shots[1][40:-40, 40:-40]
    rim = np.ones((80, 80), bool)
    rim[8:-8, 8:-8] = False
    assert abs(small - middle)[rim].mean() < 1.5


def test_over_a_transparent_background():
    """Alpha is bent with the colours: where a bar moves away, the picture is transparent."""
    scene = e3d.Scene(background=None, ambient=(0, 0, 0))
    scene.add(flat((255, 255, 255), (0.2, 4)), translation=(0, 0, -1))
    turn = e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.radians(50))
    scene.add(pane((2.5, 1.0), thickness=0.8), rotation=turn)
    plain, frame = shot(scene, refraction=False), shot(scene)
    bar, bent = plain.color[60, :, 3] > 200, frame.color[60, :, 3] > 200
    assert bar.any() and bent.any() and not (bar & bent).any()
    assert (frame.color[60, bent, :3] > 200).all()


@pytest.mark.parametrize(
    "options",
    [
        {"mode": "unlit"},
        {"mode": "normal"},
        {"wireframe": "only"},
        {"hidden_surfaces": "painter"},
        {"hidden_surfaces": "none"},
        {"outputs": ("depth", "normal")},
    ],
    ids=str,
)
def test_where_nothing_is_bent(options):
    scene = stripes()
    scene.add(pane(thickness=0.5, roughness=0.5))
    frame, plain = shot(scene, **options), shot(scene, **options, refraction=False)
    for name in frame.outputs:
        assert np.array_equal(getattr(frame, name), getattr(plain, name))


def test_the_picture_behind_takes_memory_only_where_glass_shows():
    scene = stripes()
    with Renderer(SIZE) as renderer:
        one = next(p for p in renderer._painter.passes._all if type(p).__name__ == "Refraction")
        renderer.render(scene, camera())
        assert not one._pool._free
        scene.add(pane(roughness=0.4))
        renderer.render(scene, camera())
        assert one._pool._free
        renderer.resize((20, 20))
        assert not one._pool._free


def test_too_large_a_picture_behind_is_refused(monkeypatch):
    from engine3d.rendering import _frame_memory, options

    scene = stripes()
    scene.add(pane(roughness=0.4))
    monkeypatch.setattr(options, "MAX_FRAME_BYTES", 20 * SIZE[0] * SIZE[1])
    monkeypatch.setattr(_frame_memory, "BYTES_A_PIXEL", 0)
    with pytest.raises(e3d.InvalidArgumentError, match="refraction=False"):
        shot(scene)
    shot(scene, refraction=False)


@pytest.mark.parametrize("antialiasing, samples", [("ssaa", 4), ("msaa", 4), ("msaa", 8)])
def test_samples_of_a_pixel(antialiasing, samples):
    """The same picture but for its edges."""
    scene = stripes()
    scene.add(pane((2.5, 2.5), roughness=0.4, thickness=0.3))
    one = shot(scene).color.astype(int)
    several = shot(scene, antialiasing=antialiasing, samples=samples).color.astype(int)
    inner = slice(20, 100), slice(40, 120)
    assert abs(one[inner] - several[inner]).max() <= 12


@pytest.mark.parametrize("antialiasing", ["ssaa", "msaa"])
def test_edges_behind_glass_are_smooth(antialiasing):
    """Through glass that shifts a slanted edge by whole pixels, or nearly, it has its steps."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    slanted = e3d.linalg.quaternion_from_axis_angle((0, 0, 1), 0.2)
    scene.add(flat((255, 255, 255), (1, 9)), translation=(0, 0, -1), rotation=slanted)
    scene.add(e3d.DirectionalLight(direction=(0, 1, 0), intensity=1e-9))
    turn = e3d.linalg.quaternion_from_axis_angle((0, 1, 0), np.radians(40))
    scene.add(pane((4, 4), thickness=0.5), rotation=turn)
    frame = shot(scene, antialiasing=antialiasing, samples=16)
    plain = shot(scene, antialiasing=antialiasing, samples=16, refraction=False)
    between = [((f.color[..., 1] > 90) & (f.color[..., 1] < 220)).sum() for f in (frame, plain)]
    assert between[0] > 0.7 * between[1] > 50


HOW = [{}, {"samples": 4}, {"samples": 16}, {"samples": 4, "antialiasing": "msaa"}]


def drawn(scene, lens, size, **how):
    with Renderer(size, **how) as renderer:
        return renderer.render(scene, (lens, e3d.look_at((0, 0, 5), (0, 0, 0)))).color


def before_a_mirror(*things, width=8.0):
    """A mirror in the plane z = 0, which shows unlit things that stand behind the camera."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    scene.add(e3d.DirectionalLight(direction=(0, 1, 0), intensity=1e-9))
    scene.add(material(e3d.Mesh.from_polygons(square(width, 8), [(0, 1, 2, 3)]), **MIRROR))
    for color, place in things:
        pose = linalg.translation(place) @ linalg.rotation_y(np.pi)
        scene.add(flat(color, (8, 8)), pose=pose)
    return scene


MIRROR = {"color": (0, 0, 0), "mirror": 1.0}


@pytest.mark.parametrize("how", HOW, ids=["one", "ssaa 4", "ssaa 16", "msaa"])
@pytest.mark.parametrize("background", [(0, 0, 0), None])
def test_a_mirror_behind_bent_glass_shows_what_it_shows_beside(how, background):
    red, blue = ((255, 0, 0), (4, 0, 6)), ((0, 0, 255), (-4, 0, 6))
    scene = before_a_mirror(red, blue)
    scene.background = background
    lens = e3d.PerspectiveCamera(0.6)
    beside = drawn(scene, lens, (64, 48), **how).astype(int)
    scene.add(pane((1.6, 1.6), thickness=0.02, ior=1.3), translation=(0.4, 0, 1))
    through = drawn(scene, lens, (64, 48), **how).astype(int)
    same = [column for column in range(64) if abs(column - 32) > 2]  # but at the colours' edge
    assert np.abs(through - beside)[24, same, :3].max() < 16
    assert (through != beside).any()


@pytest.mark.parametrize(
    "lens",
    [e3d.OrthographicCamera(1.0), e3d.IntrinsicsCamera(100, 100, 128, 32)],
    ids=["orthographic", "pinhole"],
)
def test_the_blur_in_a_mirror_is_that_of_the_picture(lens):
    """However large the mirror is; with samples its picture has more pixels."""
    shown = []
    for width, samples in ((8.0, 1), (4.0, 1), (4.0, 4), (4.0, 16)):
        scene = before_a_mirror(((255, 255, 255), (4, 0, 7)), width=width)
        scene.add(pane((8, 8), roughness=0.6), translation=(0, 0, 6))
        shown.append(drawn(scene, lens, (256, 64), samples=samples)[32, 112:148:4, 0].astype(int))
    assert np.ptp(shown[0]) > 80
    for one in shown[1:]:
        assert np.abs(one - shown[0]).max() <= 8


@pytest.mark.filterwarnings("ignore:through a lens")
def test_the_blur_through_a_lens_is_that_of_the_picture():
    """The faces of a lens have sizes of their own."""
    scene = stripes()
    scene.add(pane((8, 8), roughness=0.6))
    shown = []
    for kind in (e3d.IntrinsicsCamera, e3d.FisheyeCamera):
        color = drawn(scene, kind(40, 40, 128, 32), (256, 64))
        shown.append(color[32, 108:148:4, 0].astype(int))
    assert np.abs(shown[0] - shown[1]).max() <= 20
