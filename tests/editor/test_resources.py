"""What panels list of meshes, materials and textures, and their pictures."""

import time

import numpy as np
from loaders.seeds import FILES

import engine3d as e3d
from engine3d.apps.editor import thumbnails
from engine3d.apps.editor.resource_list import ResourceList
from engine3d.apps.editor.thumbnails import Thumbnails


def test_all_that_nodes_use_is_listed_once(tmp_path):
    for name in ("house.obj", "house.mtl", "house.tga"):
        (tmp_path / name).write_bytes(FILES[name])
    scene = e3d.Scene()
    house = e3d.load_mesh(tmp_path / "house.obj")
    nodes = [scene.add(house), scene.add(e3d.InstancedMesh(house, [(0, 0, 0, 1)]))]
    scene.add(e3d.PointLight())
    listing = ResourceList(scene)
    entries = listing.entries()
    assert [(e.kind, e.name, e.users) for e in entries] == [
        ("material", "brick", 2),
        ("mesh", "walls", 2),
        ("texture", "house.tga", 2),
        ("texture", "house.tga as normals", 2),  # its map_Bump
    ]
    assert entries[1].path == str(tmp_path / "house.obj")
    assert entries[2].path == str(tmp_path / "house.tga")
    assert listing.users(house) == listing.users(entries[2].thing) == tuple(nodes)
    nodes[0].translation = (1, 2, 3)
    assert listing.entries() is entries
    house.materials[0].name = "stone"
    assert listing.entries()[0].name == "stone"
    scene.remove(nodes[1])
    assert [e.users for e in listing.entries()] == [1, 1, 1, 1]
    box = e3d.box()
    listing.keep(box)
    assert [(e.name, e.users) for e in listing.entries() if e.kind == "mesh"] == [
        ("box", 0),
        ("walls", 1),
    ]
    assert listing.find("box") is box and listing.find("box", "texture") is None
    nodes[0].object = box
    house.materials[0].texture = None
    assert [(e.name, e.users) for e in listing.entries()] == [("unnamed", 1), ("box", 1)]
    listing.drop(box)
    scene.remove(nodes[0])
    assert listing.entries() == ()


def test_a_large_list_costs_nothing_while_nothing_changes():
    scene, mesh = e3d.Scene(), e3d.box()
    for _ in range(39_304):
        node = scene.add(mesh)
    listing = ResourceList(scene)
    listing.entries()
    times = []
    for k in range(5):
        node.translation = (k, 0, 0)
        start = time.process_time()
        listing.entries()
        times.append(time.process_time() - start)
    assert min(times) < 0.002


def test_pictures_show_what_they_are_of():
    pictures = Thumbnails(48)
    ball = e3d.icosphere(3, 2)
    red = e3d.Material(color=(255, 0, 0))
    of_ball, of_red = pictures.get(ball), pictures.get(red)
    assert of_ball.shape == (48, 48, 4) and not of_ball.flags.writeable
    assert of_ball[0, 0].tolist() == [43, 46, 53, 255] and of_ball[24, 24, 0] > 100
    assert of_red[24, 24, 0] > 100 > of_red[24, 24, 1]
    assert pictures.get(ball) is of_ball
    red.color = (0, 255, 0)
    assert pictures.get(red)[24, 24, 1] > 100
    ball.materials = [red]
    assert pictures.get(ball) is not of_ball
    assert pictures.get(e3d.Mesh([[0, 0, 0]])).shape == (48, 48, 4)  # of nothing


def test_textures_are_shown_whole_over_a_chequerboard():
    pixels = np.zeros((50, 100, 4), np.uint8)
    pixels[:, :50] = 200, 100, 50, 255
    texture = e3d.Texture(pixels)
    picture = Thumbnails(48).get(texture)
    assert picture[24, 4].tolist() == [200, 100, 50, 255]
    assert picture[24, 44, 0] == picture[24, 44, 2]  # grey, through the clear half
    assert picture[4, 4].tolist() == [90, 90, 90, 255] and picture[4, 12, 0] == 140
    tiny = Thumbnails(48).get(e3d.Texture(np.full((1, 1, 3), 7, np.uint8)))
    assert (tiny[:, :, :3] == 7).all()


def test_pictures_are_drawn_while_there_is_time(monkeypatch):
    monkeypatch.setattr(thumbnails, "MOST", 3)
    pictures = Thumbnails(16)
    materials = [e3d.Material(color=(k, 0, 0)) for k in range(5)]
    past, future = time.perf_counter() - 1, time.perf_counter() + 100
    assert pictures.get_if_time(materials[0], past) is None
    drawn = [pictures.get_if_time(material, future) for material in materials]
    assert all(picture is not None for picture in drawn)
    assert pictures.get_if_time(materials[4], past) is drawn[4]
    assert pictures.get_if_time(materials[0], past) is None  # given up
    pictures.clear()
    assert pictures.get_if_time(materials[4], past) is None
