"""What is saved is drawn from its file as it was drawn from Python, where its format holds it."""

import warnings

import numpy as np
import pytest

import engine3d as e3d

SIZE = (80, 60)


@pytest.fixture(autouse=True)
def _quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        yield


def rng():
    return np.random.default_rng(3)


def dressed(mesh=None, **material):
    mesh = e3d.uv_sphere(0.5, (16, 8)) if mesh is None else mesh
    mesh.materials = [e3d.Material(**material)]
    return mesh


def image():
    return e3d.Texture(rng().integers(0, 255, (32, 32, 3)).astype(np.uint8))


def coloured():
    mesh = e3d.box()
    mesh.colors = rng().integers(0, 255, (len(mesh.positions), 3)).astype(np.uint8)
    return mesh


def two_materials():
    mesh = e3d.torus()
    mesh.materials = [e3d.Material(color=(200, 60, 30)), e3d.Material(color=(20, 60, 230))]
    mesh.material_ids = np.arange(len(mesh.faces)) % 2
    return mesh


def points(**more):
    places = rng().normal(size=(200, 3)).astype(np.float32)
    return e3d.Mesh(places, points=np.arange(200), **more)


def lines():
    places = rng().normal(size=(20, 3)).astype(np.float32)
    return e3d.Mesh(places, lines=np.arange(20).reshape(10, 2))


def turned(step):
    """Return a box some of whose faces show their back."""
    box = e3d.box()
    faces = box.faces.copy()
    faces[::step] = faces[::step, ::-1]
    return e3d.Mesh(box.positions, faces, normals=box.normals)


def placed(scale=1.0, shift=(0.0, 0.0, 0.0)):
    torus = e3d.torus()
    torus.positions = torus.positions * np.float32(scale) + np.array(shift, np.float32)
    return torus


PHYSICAL = {"metallic": 0.7, "roughness": 0.3}
#: For each thing, the formats that hold all that is drawn of it.
THINGS = {
    "textured": (lambda: dressed(e3d.torus(), texture=image()), "scene obj"),
    "textured physical": (
        lambda: dressed(e3d.torus(), texture=image(), **PHYSICAL),
        "scene glb",
    ),
    "coloured vertices": (coloured, "scene obj ply"),
    "coloured": (lambda: dressed(color=(200, 60, 30)), "scene obj"),
    "shining": (lambda: dressed(specular=(0.5, 0.5, 0.5), shininess=30), "scene obj"),
    "glowing": (lambda: dressed(emissive=(0.1, 0.3, 0.1)), "scene obj"),
    "physical": (lambda: dressed(color=(200, 60, 30), **PHYSICAL), "scene glb"),
    "two materials": (two_materials, "scene obj"),
    "transparent": (
        lambda: dressed(color=(60, 60, 200, 99), alpha_mode="blend"),
        "scene obj",
    ),
    "transparent, of two sides": (
        lambda: dressed(color=(60, 60, 200, 99), alpha_mode="blend", two_sided=True, **PHYSICAL),
        "scene glb",
    ),
    "double-sided": (lambda: dressed(e3d.plane(), two_sided=True), "scene obj ply"),
    "double-sided physical": (
        lambda: dressed(e3d.plane(), two_sided=True, **PHYSICAL),
        "scene glb",
    ),
    "open": (e3d.plane, "scene obj ply"),
    "flat": (lambda: dressed(e3d.torus(), flat_shading=True), "scene"),
    "points": (points, "scene obj ply glb"),
    "coloured points": (
        lambda: points(colors=rng().integers(0, 255, (200, 3)).astype(np.uint8)),
        "scene obj ply",
    ),
    "lines": (lines, "scene obj ply glb"),
    "turned": (lambda: turned(1), "scene obj ply"),
    "partly turned": (lambda: turned(3), "scene obj ply"),
    "off the centre": (lambda: placed(shift=(7, 3, -2)), "scene obj ply"),
    "tiny": (lambda: placed(1e-4), "scene obj ply"),
    "huge": (lambda: placed(1e4), "scene obj ply"),
    "tiny physical": (lambda: dressed(placed(1e-4), **PHYSICAL), "scene glb"),
}


@pytest.mark.parametrize("name", THINGS)
def test_saved_things_look_the_same(name, tmp_path):
    make, held = THINGS[name]
    thing = make()
    with e3d.Renderer(SIZE) as renderer:
        drawn = renderer.render(thing).color.copy()
        for kind in held.split():
            path = tmp_path / ("thing.e3d.json" if kind == "scene" else f"thing.{kind}")
            if kind == "scene":
                scene = e3d.Scene()
                scene.add(thing)
                e3d.save_scene(scene, path)
            else:
                thing.save(path)
            differ = int((renderer.render(path).color != drawn).sum())
            assert not differ, f"{differ} bytes of {kind}"


def scenes():
    """Return scenes in which several meshes stand, are turned, and are drawn at many poses."""
    dressed_scene = e3d.Scene(background=(30, 60, 90))
    dressed_scene.add(dressed(e3d.torus(), texture=image()), translation=(1, 0, 0))
    dressed_scene.add(e3d.box(), rotation=e3d.linalg.quaternion_from_axis_angle((0, 1, 0), 0.5))
    poses = np.array([(0, 2, 0, 1), (2, 2, 0, 0.5)], np.float32)
    dressed_scene.add(e3d.InstancedMesh(coloured(), poses))
    lit = e3d.Scene()
    lit.add(dressed(e3d.torus(), texture=image(), **PHYSICAL))
    lit.add(points())
    lit.add(e3d.DirectionalLight((-1, -2, -1)))
    lit.add(e3d.PerspectiveCamera(0.6), pose=e3d.look_at((2, 2, 3), (0, 0, 0)))
    clear = e3d.Scene(background=None)
    clear.add(e3d.box())
    surrounded = e3d.Scene()
    surrounded.add(dressed(**PHYSICAL))
    surrounded.environment = e3d.Environment.studio()
    return {"dressed": dressed_scene, "lit": lit, "clear": clear, "surrounded": surrounded}


@pytest.mark.parametrize("name", scenes())
def test_scene_files_look_as_their_scenes(name, tmp_path):
    scene, path = scenes()[name], tmp_path / "scene.e3d.json"
    e3d.save_scene(scene, path)
    camera = e3d.frame_scene(scene, aspect=4 / 3, direction=(-1, -1, -2))
    with e3d.Renderer(SIZE) as renderer:
        drawn = renderer.render(scene, camera).color.copy()
        for again in (path, e3d.load_scene(path)):
            assert np.array_equal(renderer.render(again, camera).color, drawn)
