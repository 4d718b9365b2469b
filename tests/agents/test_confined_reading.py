"""Files that models name: whatever the format and the name, they lie in the root folder."""

import base64
import json
import os
import re
import struct
import warnings

import numpy as np
import pytest
from agents.conftest import Agent
from PIL import Image

import engine3d as e3d
from engine3d.apps.agents.server_limits import Limits
from engine3d.apps.agents.session import Session
from engine3d.io.reading import linked_files, sources

POINTS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
IN_FILE = "data:;base64," + base64.b64encode(POINTS).decode()
PAINTED = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"


def gltf(buffer, image=None):
    uvs = {"buffer": 0, "byteLength": 24}
    position = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}
    tree = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": buffer, "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, uvs],
        "accessors": [
            position | {"min": [0, 0, 0], "max": [1, 1, 0]},
            position | {"bufferView": 1, "type": "VEC2"},
        ],
        "meshes": [{"primitives": [primitive]}],
        "materials": [{}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    if image is not None:
        tree |= {"images": [{"uri": image}], "textures": [{"source": 0}]}
        tree["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    return json.dumps(tree)


def e3d_scene(scene=None, **lists):
    nodes = [{"object": 0}]
    box = {"kind": "mesh", "primitive": "box", "materials": [0] if "materials" in lists else []}
    lists = {"objects": [box], **lists}
    whole = {"format": "engine3d scene", "version": 1, "scene": scene or {}, "nodes": nodes}
    return json.dumps({**whole, **lists})


def dae(image):
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_images><image id="i"><init_from>{image}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="u"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>u</source></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="s"/></diffuse></lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="k"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#p" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="k" target="#m"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>"""


def ply(image):
    head = f"ply\nformat ascii 1.0\ncomment TextureFile {image}\nelement vertex 3\n"
    vertex = "".join(f"property float {name}\n" for name in ("x", "y", "z", "u", "v"))
    face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    return f"{head}{vertex}{face}0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"


def urdf(mesh="", texture=""):
    shape = f'<mesh filename="{mesh}"/>' if mesh else '<sphere radius="1"/>'
    look = f'<material name="m"><texture filename="{texture}"/></material>' if texture else ""
    seen = f"<visual><geometry>{shape}</geometry>{look}</visual>"
    return f'<robot name="r"><link name="a">{seen}</link></robot>'


def environment(name):
    return e3d_scene({"environment": 0}, environments=[{"file": name}])


def textured(name):
    return e3d_scene(textures=[{"file": name}], materials=[{"texture": {"texture": 0}}])


#: How each format names a file: the model's name, its text, the kind of the named file, and other
#: files that lie between the two.
NAMING = {
    "obj-mtl": ("a.obj", lambda n: f"mtllib {n}\n{PAINTED}", "mtl", {}),
    "mtl-image": (
        *("a.obj", lambda n: f"mtllib between.mtl\nusemtl m\n{PAINTED}", "png"),
        {"between.mtl": lambda n: f"newmtl m\nmap_Kd {n}\n"},
    ),
    "ply": ("a.ply", ply, "png", {}),
    "gltf-buffer": ("a.gltf", gltf, "bin", {}),
    "gltf-image": ("a.gltf", lambda n: gltf("points.bin", n), "png", {}),
    "dae": ("a.dae", dae, "png", {}),
    "scene-mesh": (
        "a.e3d.json",
        lambda n: e3d_scene(objects=[{"kind": "mesh", "file": n}]),
        "stl",
        {},
    ),
    "scene-texture": ("a.e3d.json", textured, "png", {}),
    "scene-environment": ("a.e3d.json", environment, "hdr", {}),
    "urdf-mesh": ("a.urdf", urdf, "stl", {}),
    "urdf-texture": ("a.urdf", lambda n: urdf(texture=n), "png", {}),
    "urdf-dae-image": ("a.urdf", lambda n: urdf("between.dae"), "png", {"between.dae": dae}),
}
OUTSIDE = {
    "relative": "../private/{file}",
    "absolute": "{top}/private/{file}",
    "url": "file://{top}/private/{file}",
    "linked": "link.{kind}",
    "linked-folder": "door/{file}",
    "address": "memory://private/{file}",
}
IN_PACKAGES = {
    "package-around": "package://top/private/{file}",
    "package-beside": "package://private/{file}",
    "package-listed": "package://elsewhere/{file}",
    "package-found": "$(find top)/private/{file}",
}


@pytest.fixture
def top(tmp_path, monkeypatch):
    """The root folder ``models``, and others around it, which are packages."""
    top = tmp_path / "top"
    for folder in ("models", "private", "listed/elsewhere"):
        (top / folder).mkdir(parents=True)
    for package in (top, top / "private", top / "listed/elsewhere"):
        (package / "package.xml").touch()
        _write_all(package)
    _write_all(top / "models", "inside")
    (top / "models" / "points.bin").write_bytes(POINTS)
    (top / "models" / "door").symlink_to(top / "private")
    for kind in ("mtl", "png", "bin", "stl", "hdr"):
        (top / "models" / f"link.{kind}").symlink_to(top / "private" / f"secret.{kind}")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{top / 'listed'}{os.pathsep}{top}")
    return top


def _write_all(folder, stem="secret"):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        e3d.save_mesh(e3d.box(), folder / f"{stem}.stl")
    Image.fromarray(np.full((2, 2, 3), 9, np.uint8)).save(folder / f"{stem}.png")
    (folder / f"{stem}.bin").write_bytes(POINTS)
    (folder / f"{stem}.mtl").write_text("newmtl secret\nKd 1 0 0\n")
    pixels = bytes([128, 128, 128, 129]) * 2
    (folder / f"{stem}.hdr").write_bytes(
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixels
    )


@pytest.fixture
def opened(monkeypatch):
    """The inodes of all files that readers open."""
    found = []
    plain = sources.opened_source

    def noted(path, handle):
        found.append(os.fstat(handle).st_ino)
        return plain(path, handle)

    for module in (sources, linked_files):
        monkeypatch.setattr(module, "opened_source", noted)
    return found


def _load(top, how, name, **limits):
    """Write a model that names a file, and return what an agent is told when it loads that."""
    model, text, kind, between = NAMING[how]
    name = name.format(top=top, kind=kind, file=f"secret.{kind}")
    for file, write in {**between, model: text}.items():
        (top / "models" / file).write_text(write(name))
    session = Session(Limits(root=str(top / "models"), **limits))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        try:
            told = session.load(model)
        except e3d.Engine3DError as error:
            return str(error)
    return str(told)


@pytest.mark.parametrize("how", NAMING)
def test_files_in_the_root_folder_are_read(top, opened, how):
    kind = NAMING[how][2]
    _load(top, how, f"inside.{kind}")
    assert (top / "models" / f"inside.{kind}").stat().st_ino in opened


@pytest.mark.parametrize(
    "how, where",
    [
        *((how, where) for how in NAMING for where in OUTSIDE),
        *((how, where) for how in NAMING if "urdf" in how for where in IN_PACKAGES),
    ],
)
def test_no_file_outside_of_the_root_folder_is_read(top, opened, how, where):
    told = _load(top, how, {**OUTSIDE, **IN_PACKAGES}[where])
    folders = [top, top / "private", top / "listed/elsewhere"]
    private = {file.stat().st_ino for folder in folders for file in folder.glob("secret.*")}
    assert opened and not private & set(opened)
    assert re.search("outside of the root folder|refused|not found", told)
    for folder in folders:
        for file in folder.glob("secret.*"):
            file.unlink()
    (top / "private").joinpath("package.xml").unlink()
    assert _load(top, how, {**OUTSIDE, **IN_PACKAGES}[where]) == told  # nor is looked for


@pytest.mark.parametrize("how", NAMING)
def test_the_size_of_each_named_file_is_limited(top, opened, how):
    """The named file alone is larger than the limit of a megabyte."""
    kind = NAMING[how][2]
    with open(top / "models" / f"inside.{kind}", "ab") as file:
        file.write(b"\n" * (1 << 20))
    told = _load(top, how, f"inside.{kind}", most_bytes=1 << 20)
    assert "larger than 1 MB, the limit (--max-megabytes)" in told


def test_images_beside_a_model_stay_within(top, opened):
    (top / "models" / "a.obj").write_text(PAINTED)
    (top / "models" / "a_diffuse.png").symlink_to(top / "private" / "secret.png")
    told = Session(Limits(root=str(top / "models"))).load("a.obj")
    assert (top / "private" / "secret.png").stat().st_ino not in opened
    assert not any("taken as its texture" in line for line in told["warnings"])


def test_a_package_in_the_root_folder_is_found(top):
    arm = top / "models" / "arm"
    (arm / "urdf").mkdir(parents=True)
    _write_all(arm)
    (arm / "urdf" / "a.urdf").write_text(urdf("package://arm/secret.stl"))
    told = Session(Limits(root=str(top / "models"))).load("arm/urdf/a.urdf")
    assert told["triangles"] == 12 and not told["warnings"]


def test_a_robot_in_a_folder_of_robots_finds_what_is_beside_it(top):
    """The root is called as folders within packages are: what is around it stays out."""
    (top / "models" / "a.urdf").write_text(urdf("inside.stl"))
    told = Session(Limits(root=str(top / "models"))).load("a.urdf")
    assert told["triangles"] == 12 and not told["warnings"]


def test_readers_of_plugins_stay_within(top, opened):
    e3d.plugins.register(
        "readers", "zzz", lambda file: e3d.load_mesh(file.open("../private/secret.stl"))
    )
    try:
        (top / "models" / "a.zzz").write_text("x")
        with pytest.raises(e3d.FileAccessError, match="outside of the root folder"):
            Session(Limits(root=str(top / "models"))).load("a.zzz")
    finally:
        e3d.plugins.unregister("readers", "zzz")


def test_images_are_not_copied_from_where_a_link_leads_by_now(top):
    root = top / "models"
    (root / "between.mtl").write_text("newmtl m\nmap_Kd inside.png\n")
    (root / "a.obj").write_text(f"mtllib between.mtl\nusemtl m\n{PAINTED}")
    agent = Agent(root)
    agent.told("load", path="a.obj")
    (root / "inside.png").unlink()
    Image.fromarray(np.full((2, 2, 3), 77, np.uint8)).save(top / "private" / "secret.png")
    (root / "inside.png").symlink_to(top / "private" / "secret.png")
    agent.told("export", path="a.glb")
    assert (top / "private" / "secret.png").read_bytes() not in (root / "a.glb").read_bytes()
