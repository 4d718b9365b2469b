"""One small file of each format that uses much of it: what damaged files are made from.

In: nothing. Out: `FILES`, from a name to bytes; files that name others (a material, a texture) name
those here. The tests of damaged files and the fuzzers start from them.
"""

import base64
import io
import json
import struct
import zipfile

OBJ = b"""# a house
mtllib house.mtl
o walls
v 0 0 0 1 .5 0
v 1 0 0 1 .5 0
v 1 1 0 1 .5 0
v .5 1.5 0
v 0 1 0
vt 0 0
vt 1 0
vt .5 1
vn 0 0 1
g front a
usemtl brick
s 1
f 1/1/1 2/2/1 3/3/1 4/1/1 5/2/1
s off
f -1 -2 \\
 -3
l 1 2 3
p 1 -1
"""
MTL = b"""newmtl brick
Kd .8 .2 .1
Ks 1 1 1
Ns 20
d .5
map_Kd -s 2 2 1 -o .5 0 house.tga
map_Bump -bm 2 house.tga
"""
ASC = b"""Ambient light color: Red=0.3 Green=0.3 Blue=0.3

Named object: "Lamp"
Direct light
Position:  X:1 Y:2 Z:3
Light color: Red=1 Green=1 Blue=1

Named object: "Eye"
Camera (50.0mm)
Position:  X:0 Y:-5 Z:1
Target:  X:0 Y:0 Z:0

Named object: "Square"
Tri-mesh, Vertices: 4     Faces: 2
Mapped
Vertex list:
Vertex 0:  X:0     Y:0     Z:0     U:0     V:0
Vertex 1:  X:2     Y:0     Z:0     U:1     V:0
Vertex 2:  X:2     Y:2     Z:0     U:1     V:1
Vertex 3:  X:0     Y:2     Z:0     U:0     V:1
Face list:
Face 0:    A:0 B:1 C:2 AB:1 BC:1 CA:0
Material:"r255g128b0a0"
Smoothing:  1, 3
Face 1:    A:0 B:2 C:3 AB:0 BC:1 CA:1
Smoothing:  2
"""
TGA = bytes([2, 1, 9, 1, 0, 2, 0, 24, 0, 0, 0, 0, 4, 0, 2, 0, 8, 0x20]) + b"id"
TGA += bytes([1, 2, 3, 4, 5, 6, 0x82, 1, 0x04, 1, 2, 1, 2, 1])
PLY = b"""ply
format ascii 1.0
comment TextureFile house.tga
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
property list uchar float texcoord
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255 0 0
1 0 0 255 0 0
1 1 0 255 0 9
0 1 0 255 0 9
3 0 1 2 6 0 0 1 0 1 1
4 0 1 2 3 8 0 0 1 0 1 1 0 1
0 2
"""
BINARY_PLY = PLY[: PLY.index(b"end_header")].replace(b"ascii", b"binary_big_endian")
BINARY_PLY += b"end_header\n" + b"".join(
    struct.pack(">3f3B", *row)
    for row in [(0, 0, 0, 9, 9, 9), (1, 0, 0, 9, 9, 9), (1, 1, 0, 9, 9, 9), (0, 1, 0, 9, 9, 9)]
)
BINARY_PLY += struct.pack(">B3iB6f", 3, 0, 1, 2, 6, 0, 0, 1, 0, 1, 1)
BINARY_PLY += struct.pack(">B4iB8f2i", 4, 0, 1, 2, 3, 8, 0, 0, 1, 0, 1, 1, 0, 1, 0, 2)

_FACET = b"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
_FACET += b"vertex 0 %d 0\nendloop\nendfacet\n"
STL = b"solid roof\n" + _FACET % 1 + _FACET % 2 + b"endsolid roof\n"
BINARY_STL = b"solid".ljust(80) + struct.pack("<I24fH", 1, *range(24), 0)[:54]
OFF = b"""COFF
4 2 0 # a roof
0 0 0 255 0 0
1 0 0 255 0 0
1 1 0 255 0 9
0 1 0 255 0 9
3 0 1 2 .5 1 0
4 0 1 2 3
"""

_NUMBERS = struct.pack("<9f3H2x", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2)
_NUMBERS += struct.pack("<6fH2x3f", *range(6), 1, 5, 6, 7)
_GLTF = {
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_texture_transform", "KHR_materials_clearcoat"],
    "scenes": [{"nodes": [0]}],
    "nodes": [
        {"children": [1], "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1]},
        {"mesh": 0, "name": "roof", "rotation": [0, 0, 0.6, 0.8], "scale": [1, 2, 3]},
    ],
    "meshes": [
        {
            "primitives": [
                {"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0},
                {"attributes": {"POSITION": 0, "COLOR_0": 0}, "mode": 3},
            ]
        }
    ],
    "materials": [
        {
            "pbrMetallicRoughness": {
                "baseColorFactor": [1, 0.5, 0.5, 1],
                "baseColorTexture": {
                    "index": 0,
                    "extensions": {"KHR_texture_transform": {"scale": [2, 2], "rotation": 0.5}},
                },
            },
            "alphaMode": "BLEND",
            "emissiveFactor": [0.5, 0, 0],
        }
    ],
    "textures": [{"source": 0, "sampler": 0}],
    "samplers": [{"wrapS": 33071, "magFilter": 9728}],
    "images": [{"uri": "house.tga"}],
    "accessors": [
        {
            "bufferView": 0,
            "componentType": 5126,
            "count": 3,
            "type": "VEC3",
            "sparse": {
                "count": 1,
                "indices": {"bufferView": 3, "componentType": 5123},
                "values": {"bufferView": 4},
            },
        },
        {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"},
    ],
    "bufferViews": [
        {"buffer": 0, "byteOffset": 0, "byteLength": 36, "byteStride": 12},
        {"buffer": 0, "byteOffset": 36, "byteLength": 6},
        {"buffer": 0, "byteOffset": 44, "byteLength": 24},
        {"buffer": 0, "byteOffset": 68, "byteLength": 2},
        {"buffer": 0, "byteOffset": 72, "byteLength": 12},
    ],
}


def _gltf(buffer: dict) -> bytes:
    text = json.dumps({**_GLTF, "buffers": [{"byteLength": len(_NUMBERS), **buffer}]}).encode()
    return text + b" " * (-len(text) % 4)


_URI = "data:application/octet-stream;base64," + base64.b64encode(_NUMBERS).decode()
GLTF = _gltf({"uri": _URI})
_JSON = _gltf({})
GLB = struct.pack("<4sIIII", b"glTF", 2, 28 + len(_JSON) + len(_NUMBERS), len(_JSON), 0x4E4F534A)
GLB += _JSON + struct.pack("<II", len(_NUMBERS), 0x4E4942) + _NUMBERS

# What moves, what lights, and what is packed: one triangle with a skin and a morph target.
_MOVING_NUMBERS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes([0, 1, 0, 0] * 3)
_MOVING_NUMBERS += struct.pack("<12f", *(0.5, 0.5, 0, 0) * 3)
_MOVING_NUMBERS += struct.pack("<32f", *(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) * 2)
_MOVING_NUMBERS += struct.pack("<11f", 0, 1, *(0, 0, 0.5) * 3)
_MOVING_NUMBERS += struct.pack("<8f2f", 0, 0, 0, 1, 0, 0, 0.6, 0.8, 0, 1)
_MOVING_NUMBERS += b"\xd1\0\4\4\0\0\0\0" + bytes([0, 255, 9, 255] * 3)
_SIZES = (36, 12, 48, 128, 8, 36, 32, 8, 8, 12)
_MOVING = {
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_lights_punctual", "EXT_meshopt_compression", "KHR_materials_sheen"],
    "extensions": {
        "KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]},
        "KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]},
    },
    "scene": 0,
    "scenes": [{"nodes": [0, 1, 4]}],
    "nodes": [
        {"mesh": 0, "skin": 0, "weights": [0.5]},
        {"children": [2], "translation": [0, 0, 1]},
        {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}, "children": [3]},
        {"camera": 1, "extensions": {"KHR_node_visibility": {"visible": False}}},
        {
            "mesh": 1,
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}},
        },
    ],
    "meshes": [
        {
            "primitives": [
                {
                    "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2},
                    "indices": 8,
                    "material": 0,
                    "targets": [{"POSITION": 5}],
                    "extensions": {
                        "KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}
                    },
                }
            ],
            "weights": [0.25],
            "extras": {"targetNames": ["up"]},
        },
        {"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 9}, "mode": 0}]},
    ],
    "materials": [
        {
            "alphaMode": "MASK",
            "normalTexture": {"index": 0, "texCoord": 1, "scale": 0.5},
            "extensions": {
                "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0]},
                "KHR_materials_clearcoat": {"clearcoatTexture": {"index": 0}},
            },
        },
        {
            "extensions": {
                "KHR_materials_pbrSpecularGlossiness": {
                    "specularGlossinessTexture": {"index": 0},
                    "glossinessFactor": 0.5,
                }
            }
        },
    ],
    "textures": [{"source": 0}],
    "images": [{"uri": "house.tga"}],
    "skins": [{"joints": [1, 2], "inverseBindMatrices": 3, "skeleton": 1}],
    "animations": [
        {
            "name": "turn",
            "samplers": [
                {"input": 4, "output": 6},
                {"input": 4, "output": 7, "interpolation": "STEP"},
            ],
            "channels": [
                {"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 0, "path": "weights"}},
            ],
        }
    ],
    "cameras": [
        {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
        {
            "type": "orthographic",
            "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9},
        },
    ],
    "accessors": [
        {"bufferView": view, "componentType": kind, "count": count, "type": shape, **more}
        for view, kind, count, shape, more in (
            (0, 5126, 3, "VEC3", {}),
            (1, 5121, 3, "VEC4", {}),
            (2, 5126, 3, "VEC4", {}),
            (3, 5126, 2, "MAT4", {}),
            (4, 5126, 2, "SCALAR", {}),
            (5, 5126, 3, "VEC3", {}),
            (6, 5126, 2, "VEC4", {}),
            (7, 5126, 2, "SCALAR", {}),
            (8, 5123, 3, "SCALAR", {}),
            (9, 5121, 3, "VEC4", {"normalized": True}),
        )
    ],
    "bufferViews": [
        {"buffer": 0, "byteOffset": sum(_SIZES[:k]), "byteLength": size}
        for k, size in enumerate(_SIZES)
    ],
}
_MOVING["bufferViews"][8] = {
    "buffer": 1,
    "byteLength": 6,
    "extensions": {
        "EXT_meshopt_compression": {
            "buffer": 0,
            "byteOffset": sum(_SIZES[:8]),
            "byteLength": 8,
            "byteStride": 2,
            "count": 3,
            "mode": "INDICES",
        }
    },
}


def _moving(buffer: dict) -> bytes:
    buffers = [{"byteLength": len(_MOVING_NUMBERS), **buffer}, {"byteLength": 6}]
    text = json.dumps({**_MOVING, "buffers": buffers}).encode()
    return text + b" " * (-len(text) % 4)


_URI = "data:application/octet-stream;base64," + base64.b64encode(_MOVING_NUMBERS).decode()
MOVING_GLTF = _moving({"uri": _URI})
_JSON = _moving({})
MOVING_GLB = struct.pack(
    "<4sIIII", b"glTF", 2, 28 + len(_JSON) + len(_MOVING_NUMBERS), len(_JSON), 0x4E4F534A
)
MOVING_GLB += _JSON + struct.pack("<II", len(_MOVING_NUMBERS), 0x4E4942) + _MOVING_NUMBERS

SCENE = b"""{
"format": "engine3d scene",
"version": 1,
"scene": {"background": [20, 30, 40], "ambient": [0.1, 0.1, 0.2], "light_clamp": [0.1, 1.0]},
"textures": [{"file": "house.tga", "wrap": "clamp"}],
"materials": [{"color": [0.5, 1.0, 0.25], "texture": 0, "extras": {"a": [1]}}, {}],
"objects": [
{"kind": "mesh", "file": "house.obj"},
{"kind": "mesh", "file": "house.obj", "part": "walls", "materials": [0, 1]},
{"kind": "mesh", "primitive": "uv_sphere", "arguments": {"segments": [8, 5]}, "materials": [1]},
{"kind": "mesh", "name": "t", "materials": [0], "groups": {},
"arrays": {"positions": {"type": "float32", "shape": [3, 3],
"base64": "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"},
"faces": {"type": "int32", "shape": [1, 3], "base64": "AAAAAAEAAAACAAAA"}}},
{"kind": "instances", "mesh": 3,
"poses": {"type": "float32", "shape": [1, 4], "base64": "AAAAAAAAwD8AAAAAAACAPw=="}},
{"kind": "point light", "intensity": 9.0, "range": 3.0, "falloff": "window"},
{"kind": "perspective camera", "zfar": null}
],
"nodes": [
{"name": "top", "scale": [0.8, 0.8, 0.8], "children": [2, 1, 3]},
{"object": 0, "rotation": [0, 1, 0, 0], "collider": {"kind": "box"}},
{"object": 2, "pose": [1, 0, 0, 0.5, 0, 2, 0, 0, 0, 0, -1, 0], "children": [4, 5]},
{"object": 3, "static": true, "collider": {"kind": "mesh", "mesh": 2}},
{"object": 4, "hidden": true},
{"object": 1, "collider": {"kind": "sphere", "radius": 2.0}},
{"object": 5, "translation": [1, 2, 3]},
{"object": 6, "translation": [0, 0, 5]}
]
}
"""

# Radiance pictures of 8 x 3 and 4 x 2 pixels: lines of the new kind, pixels with runs of the old.
_CHANNEL = bytes([128 + 5, 40, 3, 1, 2, 3])
HDR = b"#?RADIANCE\n# light\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 8\n"
HDR += 3 * (bytes([2, 2, 0, 8]) + 3 * _CHANNEL + bytes([128 + 8, 130]))
OLD_HDR = b"#?RGBE\n\n+Y 2 +X 4\n" + bytes([9, 8, 7, 128, 1, 1, 1, 3, 5, 5, 5, 127, *range(12)])

THREEMF_RELATIONS = b"""<?xml version="1.0"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/model.model" Id="r"
 Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
THREEMF_MODEL = b"""<?xml version="1.0" encoding="UTF-8"?>
<model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
 xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02">
<metadata name="Title">a roof</metadata>
<resources>
<basematerials id="1"><base name="red" displaycolor="#FF0000"/>
<base name="glass" displaycolor="#0080FF80"/></basematerials>
<m:colorgroup id="2"><m:color color="#00FF00"/><m:color color="#0000FF"/></m:colorgroup>
<m:texture2d id="3" path="/3D/house.tga" contenttype="image/png" tilestyleu="mirror"/>
<m:texture2dgroup id="4" texid="3"><m:tex2coord u="0" v="0"/><m:tex2coord u="1" v="0.5"/>
</m:texture2dgroup>
<m:compositematerials id="5" matid="1" matindices="0 1"><m:composite values="0.5 0.5"/>
</m:compositematerials>
<m:multiproperties id="6" pids="1 4"><m:multi pindices="0 1"/></m:multiproperties>
<object id="7" name="roof" pid="1" pindex="1"><mesh>
<vertices>
<vertex x="0" y="0" z="0"/>
<vertex x="2" y="0" z="0"/>
<vertex x="0" y="2.5" z="0"/>
<vertex x="0" y="0" z="1e1"/>
</vertices>
<triangles>
<triangle v1="0" v2="2" v3="1"/>
<triangle v1="0" v2="1" v3="3" pid="2" p1="0" p2="1" p3="1"/>
<triangle v1="1" v2="2" v3="3" pid="4" p1="0" p2="1" p3="0"/>
<triangle v1="0" v2="3" v3="2" pid="5" p1="0"/>
<triangle v1="0" v2="3" v3="2" pid="6" p1="0"/>
</triangles>
<b:beamlattice radius="1" minlength="0.1"><b:beams><b:beam v1="0" v2="3"/></b:beams></b:beamlattice>
</mesh></object>
<object id="8" name="pair"><components>
<component objectid="7"/>
<component objectid="7" transform="1 0 0 0 1 0 0 0 1 10 0 0"/>
</components></object>
</resources>
<build><item objectid="8" transform="0 1 0 -1 0 0 0 0 1 0 0 5"/><item objectid="7"/></build>
</model>
"""
#: What a 3MF package holds, by name; packed by `threemf_package`.
THREEMF = {
    "[Content_Types].xml": b"<Types/>",
    "_rels/.rels": THREEMF_RELATIONS,
    "3D/model.model": THREEMF_MODEL,
    "3D/house.tga": TGA,
}


def threemf_package(parts: dict[str, bytes]) -> bytes:
    """Return a 3MF file with these parts, the same bytes for the same parts."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in parts.items():
            entry = zipfile.ZipInfo(name)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return file.getvalue()


URDF = b"""<?xml version="1.0"?>
<robot name="arm">
<material name="red"><color rgba="1 0 0 1"/></material>
<link name="base"><visual><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
<collision><geometry><mesh filename="a.stl" scale="1 1 2"/></geometry></collision></link>
<link name="upper"><visual name="bone"><origin xyz="0 0 1" rpy="0 .5 0"/>
<geometry><capsule radius=".2" length="2"/></geometry>
<material name="wood"><texture filename="house.tga"/></material></visual></link>
<link name="hand"><visual><geometry><mesh filename="package://arm/house.obj"/></geometry></visual></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="upper"/>
<origin xyz="0 0 .5"/><axis xyz="0 1 0"/><limit lower="-1" upper="1.5"/></joint>
<joint name="slide" type="prismatic"><parent link="upper"/><child link="hand"/>
<axis xyz="0 0 1"/><limit lower="0" upper=".5"/><mimic joint="elbow" multiplier="2"/></joint>
</robot>
"""
DAE = b"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i"><init_from>house.tga</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="u"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>u</source></sampler2D></newparam>
<technique sid="c"><phong><diffuse><texture texture="s"/></diffuse>
<transparency><float>0.5</float></transparency></phong></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"/></technique_common></source>
<source id="t"><float_array id="ta" count="6">0 0 1 0 0 1</float_array>
<technique_common><accessor source="#ta" count="3" stride="2"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="k" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#t" offset="1"/><vcount>4 3</vcount>
<p>0 0 1 1 2 2 3 0 0 0 2 1 1 2</p></polylist>
<lines><input semantic="VERTEX" source="#v" offset="0"/><p>0 2</p></lines>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="x"><node id="n"><translate>1 2 3</translate>
<rotate>0 0 1 45</rotate><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="k" target="#m"/></technique_common></bind_material>
</instance_geometry><node><scale>2 2 2</scale><instance_geometry url="#g"/></node></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#x"/></scene></COLLADA>
"""

FILES = {
    "house.obj": OBJ,
    "house.mtl": MTL,
    "a.asc": ASC,
    "house.tga": TGA,
    "light.hdr": HDR,
    "old.hdr": OLD_HDR,
    "a.ply": PLY,
    "binary.ply": BINARY_PLY,
    "a.stl": STL,
    "binary.stl": BINARY_STL,
    "a.off": OFF,
    "a.3mf": threemf_package(THREEMF),
    "a.gltf": GLTF,
    "moving.gltf": MOVING_GLTF,
    "moving.glb": MOVING_GLB,
    "a.glb": GLB,
    "a.json": SCENE,
    "a.urdf": URDF,
    "a.dae": DAE,
}
