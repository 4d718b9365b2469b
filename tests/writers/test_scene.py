"""Scenes are written, read and written again: the same pictures, the same bytes."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from loaders.robots import robot
from loaders.seeds import FILES
from plain_picture import Renderer

import engine3d as e3d
from engine3d.model.scene.placements import Placements

MTL = b"newmtl brick\nKd .8 .2 .1\nmap_Kd house.tga\n"  # without what is not drawn
VIEW = e3d.PerspectiveCamera(1.2), e3d.look_at((1, 2, 7), (0, 0, 0))
RENDERER = Renderer((64, 48))


def picture(scene):
    frame = RENDERER.render(scene, VIEW, outputs=("color", "depth"))
    return frame.color.tobytes(), frame.depth.tobytes()


def written(scene, path):
    e3d.save_scene(scene, path)
    return path.read_bytes()


def tree_of(path):
    return json.loads(path.read_text(encoding="ascii"))


def checked(scene, path):
    """Write and read a scene; return what was read, which is what was written."""
    data = written(scene, path)
    again = e3d.load_scene(path)
    assert not [line for line in again.warnings if "left out" in line]
    assert written(again, path.with_name("again.e3d.json")) == data
    assert picture(again) == picture(scene)
    assert len(again.nodes) == len(scene.nodes)
    for one, other in zip(scene.nodes, again.nodes, strict=True):
        for name in ("name", "visible", "static"):
            assert getattr(one, name) == getattr(other, name)
        assert [c.name for c in one.children] == [c.name for c in other.children]
        assert (one.parent and one.parent.name) == (other.parent and other.parent.name)
        assert one.world_pose.tobytes() == other.world_pose.tobytes()
        assert type(one.object) is type(other.object)
        assert type(one.collider) is type(other.collider)
    places = Placements(scene, scene.nodes), Placements(again, again.nodes)
    assert places[0].rotations.tobytes() == places[1].rotations.tobytes()
    assert places[0].scales.tobytes() == places[1].scales.tobytes()
    return again


@pytest.fixture
def folder(tmp_path):
    for name, data in {**FILES, "house.mtl": MTL}.items():
        (tmp_path / name).write_bytes(data)
    return tmp_path


def random_scene(random):
    scene = e3d.Scene(
        background=None if random.random() < 0.3 else random.integers(0, 255, 3).tolist(),
        ambient=random.uniform(0, 1, 3),
        light_clamp=(0.1, 1.0) if random.random() < 0.3 else None,
    )
    pixels = random.integers(0, 255, (3, 5, 4), np.uint8)
    texture = e3d.Texture(
        pixels,
        filter="nearest",
        wrap=("mirror", "clamp"),
        name="t\ud800",
        anisotropy=6,
        lod_bias=-0.25,
    )
    material = e3d.Material(
        color=(200, 30, 20),
        texture=texture,
        emissive=e3d.linear(0.1, 0.0, 0.3),
        extras={"note": [1, None]},
    )
    own = e3d.Mesh(
        random.normal(size=(9, 3)), random.integers(0, 9, (5, 3)), uvs=random.random((9, 2)),
        colors=random.integers(0, 255, (9, 3), np.uint8), materials=[material, e3d.Material()],
        material_ids=[0, 1, 0, 1, 0], lines=[[0, 1]], points=[2], name="own",
        edge_visible=random.random((5, 3)) < 0.5,
    )  # fmt: skip
    own.groups = {"some": [1, 3]}
    ball = e3d.uv_sphere(0.6, (8, 5))
    ball.materials = [material]
    objects = [
        own, ball, e3d.box((1, 2, 0.5)), e3d.icosphere(subdivisions=1),
        e3d.primitives.quad(p0=(-1, -1, 0)), e3d.torus(),
        e3d.cylinder(0.3), e3d.plane((2, 1), (3, 2)), None, None,
        e3d.InstancedMesh(ball, random.normal(size=(4, 4))),
        e3d.InstancedMesh(own, [np.eye(4)], colors=e3d.linear([(0.1, 0.9, 1.5)])),
        e3d.PointLight(e3d.linear(1.0, 0.8, 0.1), 9.0), e3d.PointLight(range=5.0, falloff="window"),
        e3d.DirectionalLight((1, -2, 0.1), intensity=0.3), e3d.PerspectiveCamera(zfar=None),
        e3d.OrthographicCamera(3.0, xmag=2.0), e3d.IntrinsicsCamera(9, 9, 8, 6),
        e3d.Camera(e3d.linalg.perspective(1.0, 1.0, 0.1)),
    ]  # fmt: skip
    nodes = []
    for k in range(40):
        obj = objects[random.integers(len(objects))]
        node = scene.add(obj, name=f"n{k}", static=bool(random.random() < 0.3))
        how = random.integers(4)
        if how == 0:
            node.pose = np.vstack([random.normal(size=(3, 4)), (0, 0, 0, 1)])
        elif how == 1:
            node.rotation, node.scale = random.normal(size=4), (0, 1, -0.5)
        elif how == 2:
            node.translation = random.normal(size=3)
        node.visible = bool(random.random() < 0.9)
        colliders = [
            None,
            e3d.colliders.SphereCollider(2, (1, 0, 0)),
            e3d.colliders.MeshCollider(own),
        ]
        colliders += [e3d.colliders.BoxCollider((0, 0, 0), (1, 2, 3))]
        colliders += (
            [e3d.colliders.BoxCollider(), e3d.colliders.MeshCollider()]
            if isinstance(obj, e3d.Mesh)
            else []
        )
        node.collider = colliders[random.integers(len(colliders))]
        nodes.append(node)
    for node in nodes:
        parent = nodes[random.integers(len(nodes))]
        if random.random() < 0.5:
            try:
                node.reparent(parent, before=parent.children[0] if parent.children else None)
            except e3d.InvalidArgumentError:
                continue
    return scene


@pytest.mark.parametrize("seed", range(6))
def test_whatever_a_scene_holds_is_read_again(seed, tmp_path):
    checked(random_scene(np.random.default_rng(seed)), tmp_path / "a.e3d.json")


def moving_scene():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), name="top", rotation=(0.1, 0.2, 0.3, 0.9))
    below = scene.add(e3d.box(), name="below", parent=node, translation=(0, 1, 0))
    scene.add(e3d.DirectionalLight())
    scene.animator = e3d.Animator(scene, full_rate_distance=12.5)
    scene.animator.spin([node, below], period=3.7, axis=(0, 2, 0.3), phase=0.15)
    times, places = (0.0, 0.3, 1.1), [(0, 0, 0), (0.1, 0.7, 0), (1, 0, 0)]
    turns = [(0, 0, 0, 1), (0, 1, 0, 0.3), (0, 0, 3, 1)]
    scene.animator.track(below, times, translations=places, rotations=turns, repeat=False)
    scene.animator.track(node, times, scales=[(1, 1, 1), (2, 1, 1), (1, 1, 2)])
    return scene


def test_how_nodes_move_goes_with_the_scene(tmp_path):
    scene = moving_scene()
    scene.animator.seek(0.8)
    again = checked(scene, tmp_path / "moving.e3d.json")
    for time in (0.0, 0.8, 5.3, -2.1, 1e9):
        scene.animator.seek(time)
        again.animator.seek(time)
        assert picture(again) == picture(scene)
    assert e3d.load_scene(FILES["a.json"]).animator is None
    again.animator = None
    assert b"spins" not in written(again, tmp_path / "still.e3d.json")
    with pytest.raises(e3d.InvalidArgumentError, match="of this scene"):
        again.animator = scene.animator


def test_what_is_shared_stays_shared(tmp_path):
    scene = e3d.Scene()
    mesh, lamp = e3d.Mesh(e3d.box().positions, e3d.box().faces), e3d.PointLight()
    other = e3d.Mesh(mesh.positions, mesh.faces, materials=mesh.materials)
    for obj in (mesh, mesh, other, lamp, lamp, e3d.InstancedMesh(mesh, [(0, 0, 0, 1)])):
        scene.add(obj)
    first, second, third, *lamps, crowd = (
        node.object for node in checked(scene, tmp_path / "a.e3d.json").nodes
    )
    assert first is second is crowd.mesh and lamps[0] is lamps[1]
    assert third is not first and third.materials[0] is first.materials[0]


def test_files_in_the_folder_are_named(folder):
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(folder / "house.obj"), name="whole")
    for node in e3d.load_scene(folder / "a.gltf").nodes:
        scene.add(node.object, name=node.name, pose=node.pose)
    texture = e3d.load_texture(folder / "house.tga", wrap="clamp")
    scene.add(e3d.box(), name="box").object.materials = [e3d.Material(texture=texture)]
    (folder / "below").mkdir()
    shutil.copy(folder / "a.ply", folder / "below" / "b.ply")
    scene.add(e3d.load_mesh(folder / "below" / "b.ply"))
    again = checked(scene, folder / "a.e3d.json")
    tree = tree_of(folder / "a.e3d.json")
    files = [entry.get("file") for entry in tree["objects"]]
    assert files[0] == "house.obj" and files[-1] == "below/b.ply" and "a.gltf" in files
    assert tree["textures"] == [{"file": "house.tga", "wrap": "clamp", "name": "house.tga"}]
    assert len((folder / "a.e3d.json").read_bytes()) < 2000
    assert again.find("whole").object.materials[0].texture is not None
    # What was moved together still finds its parts.
    moved = folder / "moved"
    moved.mkdir()
    for name in ("a.e3d.json", "house.obj", "house.mtl", "house.tga", "a.gltf", "below"):
        shutil.move(folder / name, moved / name)
    assert picture(e3d.load_scene(moved / "a.e3d.json")) == picture(scene)


def test_changed_materials_go_with_the_scene(folder):
    mesh, same = (e3d.load_mesh(folder / "house.obj") for _ in range(2))
    old = mesh.materials[0].color
    mesh.materials[0].color = (0, 0, 255)
    scene = e3d.Scene()
    scene.add(mesh), scene.add(same)
    again = checked(scene, folder / "a.e3d.json")
    first, second = tree_of(folder / "a.e3d.json")["objects"]
    assert first["file"] == second["file"] and "materials" in first and "materials" not in second
    colors = [node.object.materials[0].color for node in again.nodes]
    assert colors == [(0, 0, 255), old]
    mesh.materials[0].color = old  # by value, not by version
    e3d.save_scene(scene, folder / "a.e3d.json")
    assert "materials" not in tree_of(folder / "a.e3d.json")["objects"][0]


def test_changed_and_foreign_arrays_go_with_the_scene(folder, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    mesh = e3d.load_mesh(folder / "house.obj")
    ball = e3d.icosphere()
    ball.positions = ball.positions * 2
    grouped = e3d.load_mesh(folder / "house.obj")
    grouped.groups = {"mine": [0]}
    scene = e3d.Scene()
    scene.add(mesh), scene.add(ball), scene.add(grouped)
    checked(scene, elsewhere / "a.e3d.json")
    tree = tree_of(elsewhere / "a.e3d.json")
    assert all("arrays" in entry for entry in tree["objects"])
    assert all("png" in entry for entry in tree["textures"])
    checked(scene, folder / "a.e3d.json")
    assert ["arrays" in e for e in tree_of(folder / "a.e3d.json")["objects"]] == [
        False,
        True,
        True,
    ]


def test_what_is_missing_keeps_its_place(folder):
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(folder / "a.ply"), name="gone")
    texture = e3d.load_texture(folder / "house.tga", wrap="clamp")
    box = e3d.box()
    box.materials = [e3d.Material(texture=texture)]
    scene.add(box, name="box")
    data = written(scene, folder / "a.e3d.json")
    shown = picture(scene)
    for name in ("a.ply", "house.tga"):
        (folder / name).rename(folder / f"{name}.away")
    with pytest.warns(e3d.Engine3DWarning, match="left out: not found"):
        again = e3d.load_scene(folder / "a.e3d.json")
    assert len(again.warnings) == 2 and "objects[0]" in again.warnings[1]
    assert again.find("gone").object.positions.shape == (0, 3)
    assert written(again, folder / "a.e3d.json") == data
    for name in ("a.ply", "house.tga"):
        (folder / f"{name}.away").rename(folder / name)
    assert picture(e3d.load_scene(folder / "a.e3d.json")) == shown


def test_what_files_have_no_word_for_is_told(tmp_path):
    class Sun(e3d.DirectionalLight):
        """Not one of ours."""

    scene = e3d.Scene()
    scene.add(Sun(), name="sun")
    scene.add(e3d.box(), name="box").object.materials[0].extras = {"key": object()}
    with pytest.warns(e3d.Engine3DWarning) as told:
        e3d.save_scene(scene, tmp_path / "a.e3d.json")
    texts = sorted(str(warning.message).partition("json: ")[2] for warning in told)
    assert texts == ["material '': its extras are left out", "node 'sun': no word for a Sun"]
    assert [node.name for node in e3d.load_scene(tmp_path / "a.e3d.json").nodes] == ["sun", "box"]
    with pytest.raises(e3d.InvalidArgumentError, match="scene must be a Scene"):
        e3d.save_scene(scene.nodes[0], tmp_path / "b.e3d.json")
    with pytest.raises(e3d.FileAccessError, match="cannot write"):
        e3d.save_scene(scene, tmp_path / "none" / "b.e3d.json")


def test_meshes_of_scenes_are_joined_and_listed(folder):
    scene = e3d.Scene()
    top = scene.add(translation=(5, 0, 0))
    scene.add(e3d.box(), parent=top, scale=2.0, name="box")
    scene.add(
        e3d.InstancedMesh(e3d.primitives.quad(), [(0, 0, 1, 1), (0, 0, 2, 0.5)]), name="crowd"
    )
    scene.add(e3d.box(), name="hidden").visible = False
    e3d.save_scene(scene, folder / "a.e3d.json")
    mesh = e3d.load_mesh(folder / "a.e3d.json")
    assert len(mesh.faces) == 16 and mesh.bounds.tolist() == [[-0.5, -1, -1], [6, 1, 2]]
    document = e3d.loaders.load_document(folder / "a.e3d.json")
    assert [entry.name for entry in document.objects] == ["box", "crowd", "crowd"]
    assert document.counts["nodes"] == 4
    assert document.objects[0].pose[0].tolist() == [2, 0, 0, 5]


def test_a_scene_of_39304_nodes_is_written_and_read(tmp_path):
    scene, mesh = e3d.Scene(), e3d.box()
    top = scene.add()
    for k in range(39_303):
        scene.add(mesh, parent=top, name=f"node {k}", translation=(k % 34, k // 34 % 34, k // 1156))
    data = written(scene, tmp_path / "a.e3d.json")
    again = e3d.load_scene(tmp_path / "a.e3d.json")
    assert written(again, tmp_path / "b.e3d.json") == data
    assert again.bounds.tolist() == scene.bounds.tolist()


def test_the_file_is_plain_text_that_compares_line_by_line(tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box((1, 2, 3)), name="Kiste \u00e4")
    assert written(scene, tmp_path / "a.e3d.json").decode("ascii").splitlines() == [
        "{",
        '"format": "engine3d scene",',
        '"version": 1,',
        '"scene": {"background":[0,0,0],"ambient":[0.1,0.1,0.1]},',
        '"textures": [],',
        '"materials": [],',
        '"objects": [',
        '{"kind":"mesh","primitive":"box","arguments":{"size":[1,2,3]}}',
        "],",
        '"nodes": [',
        '{"name":"Kiste \\u00e4","object":0}',
        "]",
        "}",
    ]


def test_the_commands_open_scenes(tmp_path, monkeypatch, capsys):
    from engine3d.apps.cli import main

    monkeypatch.chdir(tmp_path)
    scene = e3d.Scene(background=(255, 0, 0))
    scene.add(e3d.box(), name="box")
    e3d.save_scene(scene, Path("a.e3d.json"))
    assert main(["info", "a.e3d.json"]) == 0
    assert "a.e3d.json: e3d" in capsys.readouterr().out
    assert main(["render", "a.e3d.json", "-o", "a.png", "--size", "32x24"]) == 0
    assert e3d.load_texture("a.png").pixels[0, 0].tolist() == [255, 0, 0, 255]


def test_what_moves_is_told_to_be_lost(folder):
    scene = e3d.load_scene(FILES["moving.gltf"])
    with pytest.warns(
        e3d.Engine3DWarning, match="hold no skins, morph targets, animations: glTF does"
    ):
        e3d.save_scene(scene, folder / "a.e3d.json")
    again = e3d.load_scene(folder / "a.e3d.json")
    assert len(again.nodes) == len(scene.nodes) and again.nodes[0].object.joints is None


@pytest.mark.parametrize("name", ["a.e3d.json", "a.gltf", "a.glb"])
def test_lost_joints_are_told(folder, name):
    scene = e3d.load_scene(robot(1).text.encode())
    with pytest.warns(e3d.Engine3DWarning, match=r"hold.* joints"):
        e3d.save_scene(scene, folder / name)
    assert not e3d.load_scene(folder / name).robots
