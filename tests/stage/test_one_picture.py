"""The command, `render` and a kept `Renderer` draw the same picture of the same thing."""

import io
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.io.scenes.upright_loading import _upright_pose
from engine3d.rendering.options import MODES
from engine3d.stage.near_origin import pose_in_file

DATA = Path(__file__).parents[2] / "data" / "models"
SHARED = Path(__file__).parents[3] / "shared" / "models"
FILES = [
    *(DATA / name for name in ("globe.obj", "island.obj", "nautilus.obj", "teapot.obj")),
    DATA / "train.asc",
    *(SHARED / name for name in ("cow.obj", "fandisk.obj", "suzanne.obj", "teapot.obj")),
    SHARED / "spot" / "spot.obj",
    SHARED / "spot" / "spot_quadrangulated.obj",
]
GLTF = Path(__file__).parents[3] / "shared" / "gltf" / "models"
FILES += [
    SHARED / "african_head" / "african_head.obj",
    *(
        GLTF / name
        for name in (
            "Box/Box.glb",
            "BoxVertexColors/BoxVertexColors.gltf",
            "Suzanne/Suzanne.gltf",
            "PmndrsSuzi/suzi.glb",
            "AnimatedTriangle/AnimatedTriangle.gltf",
            "Cameras/Cameras.gltf",
            "KhrLightsExample/lights.gltf",
            "PlayCanvasLights/Lights.glb",
            "LumaQuantizedPoints/quantized-point-cloud.glb",
            "Bio_01_alpha_blend/01_alpha_blend.gltf",
            "Bio_15_transmission/15_transmission.gltf",
            "SimpleInstancing/simple-instancing.glb",
        )
    ),
]
MADE = ["obj", "ply", "stl", "gltf", "glb", "points.ply", "cameras.glb", "json"]
SIZE = (160, 90)


@pytest.fixture(autouse=True)
def _quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        yield


def save(kind, folder):
    """Save something of a kind; return its path."""
    path = folder / f"thing.{kind}"
    if kind == "points.ply":
        points = np.random.default_rng(5).normal(size=(400, 3))
        e3d.Mesh(points, points=np.arange(400)).save(path)
    elif kind in ("cameras.glb", "json"):
        scene = e3d.Scene()
        scene.add(e3d.torus())
        scene.add(e3d.DirectionalLight((-1, -2, -1)))
        scene.add(e3d.PerspectiveCamera(0.5), pose=e3d.look_at((3, 3, 3), (0, 0, 0)))
        e3d.save_scene(scene, path)
    else:
        e3d.torus(0.6, 0.25).save(path)
    return path


def by_command(path, folder, *options):
    out = folder / "out.png"
    size = f"{SIZE[0]}x{SIZE[1]}"
    assert main(["render", str(path), "--size", size, *options, "-o", str(out)]) == 0
    return e3d.load_texture(out).pixels


def same(command, *functions):
    for picture in functions:
        assert np.array_equal(command, picture)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_files_look_as_with_the_command(path, tmp_path):
    if not path.exists():
        pytest.skip("needs the shared models")
    same(by_command(path, tmp_path), e3d.render(path, size=SIZE).color)


@pytest.mark.parametrize("mode", MODES)
def test_modes_are_those_of_the_command(mode, tmp_path):
    """For a model, which wears a look, and for a scene with light of its own."""
    path, lit = DATA / "teapot.obj", save("json", tmp_path)
    same(by_command(path, tmp_path, "--mode", mode), e3d.render(path, size=SIZE, mode=mode).color)
    picture = by_command(lit, tmp_path, "--mode", mode)
    same(picture, e3d.render(lit, size=SIZE, mode=mode).color)
    scene = e3d.load_scene(lit)
    options = e3d.RenderOptions(mode=mode)
    with e3d.Renderer(SIZE) as renderer:
        renderer.prepare(scene, options=options)
        framed = e3d.frame_scene(scene, aspect=SIZE[0] / SIZE[1])
        frame = renderer.render(scene, framed, options=options)
        shown, unlit = frame.color.copy(), renderer.render(scene, framed, mode="unlit").color
        assert (mode == "unlit") == np.array_equal(shown, unlit)
        same(shown, renderer.render(scene, framed, options=options, out=frame).color)


def test_changes_of_a_look_are_those_of_the_command(tmp_path):
    path = DATA / "teapot.obj"
    options = ("--ground", "mirror", "--feature-edges")
    look = e3d.Look.studio(ground="mirror", feature_edges=True)
    same(by_command(path, tmp_path, *options), e3d.render(path, size=SIZE, look=look).color)
    plain = by_command(path, tmp_path, "--ground", "none", "--no-feature-edges")
    look = e3d.Look.studio(ground=False, feature_edges=False)
    same(plain, e3d.render(path, size=SIZE, look=look).color)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_sheets_show_files_as_render_does(path):
    if not path.exists():
        pytest.skip("needs the shared models")
    sheet = e3d.sheets.contact_sheet(path, views="iso", size=(360, 280))
    frame = sheet.frame("iso")
    size = frame.width, frame.height
    same(frame.color, e3d.render(path, sheet.camera("iso"), size=size).color)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_views_show_files_as_render_does(path):
    notebook = pytest.importorskip("engine3d.notebook", exc_type=ImportError)
    if not path.exists():
        pytest.skip("needs the shared models")
    view = notebook.View(path, size=SIZE)
    drawn = view._view_renderer
    seen = view._viewer.view
    camera = drawn.camera(seen), pose_in_file(drawn.viewed, seen.pose())
    still = e3d.loaders.load_texture(io.BytesIO(view._still())).pixels
    view.close()
    same(still[..., :3], e3d.render(path, camera, size=SIZE).color[..., :3])


def test_notebooks_show_meshes_and_scenes_as_render_does(tmp_path):
    dressed, lit = e3d.Scene(), e3d.Scene()
    for scene in (dressed, lit):
        scene.add(e3d.torus())
    lit.add(e3d.DirectionalLight((-1, -2, -1)))
    for thing in (e3d.torus(), e3d.load_mesh(DATA / "teapot.obj"), dressed, lit):
        frame = e3d.render(thing, size=(400, 300))
        assert thing._repr_png_() == frame._repr_png_() == frame.encode()


@pytest.mark.parametrize("kind", MADE)
def test_files_of_each_kind_look_as_with_the_command(kind, tmp_path):
    path = save(kind, tmp_path)
    with e3d.Renderer(SIZE) as kept:
        for _ in range(2):
            same(by_command(path, tmp_path), kept.render(str(path)).color)


@pytest.mark.parametrize("kind", ["obj", "glb", "stl"])
def test_the_plain_look_and_samples_are_the_commands(kind, tmp_path):
    path = save(kind, tmp_path)
    plain = by_command(path, tmp_path, "--look", "plain")
    same(plain, e3d.render(path, size=SIZE, look="plain").color)
    same(plain, e3d.render(path, size=SIZE, look=e3d.Look.plain()).color)
    one = by_command(path, tmp_path, "--samples", "1")
    same(one, e3d.render(path, size=SIZE, samples=1).color)
    mode = by_command(path, tmp_path, "--mode", "normal")
    same(mode, e3d.render(path, size=SIZE, mode="normal").color)


def test_a_program_and_a_shell_agree(tmp_path):
    path, out, own = save("obj", tmp_path), tmp_path / "a.png", tmp_path / "b.png"
    command = [sys.executable, "-m", "engine3d", "render", str(path), "-o", str(out)]
    subprocess.run(command, check=True)
    e3d.render(path).save(own)
    assert out.read_bytes() == own.read_bytes()


@pytest.mark.parametrize("kind", ["obj", "ply"])
def test_a_mesh_looks_as_the_file_it_is_saved_to(kind, tmp_path):
    path = tmp_path / f"ball.{kind}"
    mesh = e3d.uv_sphere(0.7, (24, 12))
    mesh.save(path)
    with e3d.Renderer(SIZE) as renderer:
        picture = renderer.render(e3d.load_mesh(path)).color.copy()
        same(picture, renderer.render(path).color)


def things():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), translation=(1, 0, 0))
    poses = np.array([(0, 0, 0, 1), (2, 0, 0, 0.5)], np.float32)
    points = np.random.default_rng(1).normal(size=(50, 3))
    return [e3d.torus(), scene, node, e3d.InstancedMesh(e3d.box(), poses), points]


@pytest.mark.parametrize("thing", things(), ids=lambda thing: type(thing).__name__)
def test_a_kept_renderer_draws_as_a_fresh_one(thing):
    with e3d.Renderer(SIZE) as kept:
        kept.prepare(thing)
        kept.render(e3d.box())
        for options in ({}, {"mode": "unlit"}, {}):
            picture = kept.render(thing, **options).color.copy()
            same(e3d.render(thing, size=SIZE, **options).color, picture)
        camera = e3d.frame_scene(thing, aspect=SIZE[0] / SIZE[1], direction=(1, -1, -1))
        seen = kept.render(thing, camera).color.copy()
        same(e3d.render(thing, camera, size=SIZE).color, seen)
        for size in ((80, 80), (300, 60), (40, 200), SIZE):
            kept.resize(size)
            same(e3d.render(thing, size=size).color, kept.render(thing).color)


def test_changes_of_things_show(tmp_path):
    mesh, scene, path = e3d.box(), e3d.Scene(), tmp_path / "box.obj"
    node = scene.add(mesh)
    mesh.save(path)
    with e3d.Renderer(SIZE) as kept:
        before = [kept.render(thing).color.copy() for thing in (mesh, scene, path)]
        mesh.positions = mesh.positions * (1, 2, 1)
        node.scale = (2, 1, 1)
        mesh.save(path)
        after = [kept.render(thing).color.copy() for thing in (mesh, scene, path)]
    for thing, old, new in zip((mesh, scene, path), before, after, strict=True):
        assert not np.array_equal(old, new)
        same(e3d.render(thing, size=SIZE).color, new)


def test_a_kept_renderer_stages_a_thing_once(monkeypatch):
    from engine3d.stage import kept_stages

    calls = []
    opened = kept_stages.viewed_of
    monkeypatch.setattr(kept_stages, "viewed_of", lambda thing: calls.append(1) or opened(thing))
    mesh = e3d.torus()
    with e3d.Renderer(SIZE) as renderer:
        for size in (SIZE, SIZE, (80, 80), SIZE):
            renderer.resize(size)
            renderer.render(mesh)
    assert len(calls) == 1


def test_scenes_with_light_of_their_own_wear_no_look():
    for light in (e3d.DirectionalLight((0, -1, 0)), e3d.PointLight(), e3d.HemisphereLight()):
        scene = e3d.Scene()
        scene.add(e3d.torus())
        scene.add(light)
        same(e3d.render(scene, size=SIZE, look="plain").color, e3d.render(scene, size=SIZE).color)
    scene = e3d.Scene()
    scene.add(e3d.torus())
    dressed = e3d.render(scene, size=SIZE).color.copy()
    scene.environment = e3d.Environment.studio()
    assert not np.array_equal(dressed, e3d.render(scene, size=SIZE).color)


def test_a_scene_keeps_its_background():
    scene = e3d.Scene(background=(10, 200, 30))
    scene.add(e3d.torus())
    assert e3d.render(scene, size=SIZE).color[0, 0].tolist() == [10, 200, 30, 255]
    scene.background = None
    assert not e3d.render(scene, size=SIZE).color[0, 0].any()
    chosen = e3d.Look.studio(background=(1, 2, 3))
    assert e3d.render(scene, size=SIZE, look=chosen).color[0, 0].tolist() == [1, 2, 3, 255]


def test_the_plain_look_with_one_sample_is_the_renderers_own_picture():
    from engine3d.rendering.renderer import Renderer

    mesh, scene = e3d.torus(), e3d.Scene()
    scene.add(mesh)
    camera = e3d.frame_scene(scene, aspect=SIZE[0] / SIZE[1])
    with Renderer(SIZE) as renderer:
        exact = renderer.render(scene, camera, cull="back").color.copy()
    options = {"size": SIZE, "look": "plain", "samples": 1, "cull": "back"}
    same(exact, e3d.render(mesh, camera, **options).color)
    same(exact, e3d.render(mesh, **options).color)
    same(exact, e3d.render(scene, camera, **options).color)


def test_looks_are_values():
    look = e3d.Look.studio(ground=False)
    assert look == e3d.Look.studio().replace(ground=False) != e3d.Look.studio()
    assert {look, look.replace()} == {look} and look.lights == "studio"
    thing = e3d.Mesh.concatenate([e3d.plane((3.0, 3.0)), e3d.box()])
    pictures = [
        e3d.render(thing, size=SIZE, look=one).color
        for one in (
            e3d.Look.studio(),
            look,
            look.replace(background="dark"),
            look.replace(lights="sun"),
            look.replace(lights=None),
            look.replace(light_intensity=0.5),
            look.replace(tone_mapping="none"),
            look.replace(ambient_occlusion=False),
            look.replace(shadow="none"),
            look.replace(environment=False),
            look.replace(feature_edges=False),
        )
    ]
    assert len({picture.tobytes() for picture in pictures}) == len(pictures)
    with pytest.raises(AttributeError):
        look.ground = True
    with pytest.raises(TypeError, match="shadows"):
        look.replace(shadows="map")
    wrongs = [{"lights": "moon"}, {"light_intensity": -1}, {"background": "x"}]
    for wrong in (*wrongs, {"shadow": "soft"}, {"feature_edges": "all"}):
        with pytest.raises(e3d.InvalidArgumentError):
            e3d.Look.studio(**wrong)
    with pytest.raises(e3d.InvalidArgumentError, match='"studio", "plain"'):
        e3d.render(e3d.torus(), look="nice")


def test_a_material_replaces_those_of_the_model(tmp_path):
    path = DATA / "teapot.obj"
    red = e3d.Material(color=(255, 0, 0))
    mesh = e3d.load_mesh(path)
    before = list(mesh.materials)
    picture = e3d.render(mesh, size=SIZE, material=red, mode="unlit", samples=1).color
    assert mesh.materials == before
    shown = e3d.render(mesh, size=SIZE, samples=1, outputs=("object_id",)).object_id >= 0
    assert shown.any() and (picture[shown] == (255, 0, 0, 255)).all()
    lit = e3d.Scene()
    lit.add(mesh)
    lit.add(e3d.DirectionalLight((0, 0, -1)))
    options = {"size": SIZE, "mode": "unlit", "samples": 1, "outputs": ("color", "object_id")}
    frame = e3d.render(lit, material=red, **options)
    assert (frame.color[frame.object_id >= 0] == (255, 0, 0, 255)).all()
    with pytest.raises(e3d.InvalidArgumentError, match="material must be a Material"):
        e3d.render(mesh, material="red")
    command = by_command(path, tmp_path, "--color", "red")
    same(command, e3d.render(path, size=SIZE, material=red).color)


def test_files_are_loaded_upright_and_in_metres(tmp_path):
    mesh = e3d.box((1.0, 2.0, 3.0))
    mesh.save(tmp_path / "box.stl")
    mesh.save(tmp_path / "box.obj")
    size = {
        name: np.ptp(e3d.load(tmp_path / name).bounds, axis=0) for name in ("box.stl", "box.obj")
    }
    np.testing.assert_allclose(size["box.stl"], (1, 3, 2))
    pose = _upright_pose("+Z", "mm")
    np.testing.assert_allclose(pose[:3, :3] @ (1, 2, 3), (0.001, 0.003, -0.002))
    np.testing.assert_allclose(size["box.obj"], (1, 2, 3))
    raw = e3d.load_mesh(tmp_path / "box.stl").bounds
    np.testing.assert_allclose(np.ptp(raw, axis=0), (1, 2, 3))
    for name in ("box.stl", "box.obj"):
        path = tmp_path / name
        seen = (e3d.render(thing, size=SIZE).color for thing in (path, e3d.load(path)))
        same(*seen)


def test_the_longer_side_has_one_lens():
    for aspect, across in ((1.0, 38.0), (16 / 9, 38.0), (4.0, 38.0)):
        camera, _ = e3d.frame_scene(e3d.torus(), aspect=aspect)
        wide = 2 * np.arctan(np.tan(camera.yfov / 2) * aspect)
        assert np.degrees(wide) == pytest.approx(across)
    assert np.degrees(e3d.frame_bounds(e3d.torus(), aspect=0.5)[0].yfov) == pytest.approx(38.0)
    with pytest.raises(e3d.InvalidArgumentError, match="not int"):
        e3d.frame_scene(5)


@pytest.mark.parametrize("count", [30, 3000])
def test_white_points_have_a_dark_background(count):
    points = np.random.default_rng(1).normal(size=(count, 3))
    assert e3d.render(points, size=(120, 80)).color[0, 0, :3].max() < 160


def test_a_look_names_its_theme():
    lights = {}
    for theme in ("auto", "light", "dark"):
        look = e3d.Look.studio(ground=False, background=theme)
        lights[theme] = e3d.render(e3d.box(), size=(16, 16), look=look).color[0, 0, 0]
    assert lights["auto"] == lights["light"] > lights["dark"] + 50
