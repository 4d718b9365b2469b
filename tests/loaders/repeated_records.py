"""Files that say one thing very often: what each record of each format costs, byte by byte.

``python tests/loaders/repeated_records.py`` prints the table of docs/reliability.md.
"""

import base64
import io
import json
import struct
import sys
import time
import tracemalloc
import warnings
import zipfile

import numpy as np
from PIL import Image

TRIANGLE = np.float32([(0, 0, 0), (1, 0, 0), (0, 1, 0)])


def png():
    file = io.BytesIO()
    Image.new("RGB", (2, 2)).save(file, "PNG")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


PICTURE = png()


def gltf(change):
    """A glTF file of a triangle that ``change(tree, n)`` repeats something in."""

    def made(n):
        data = (
            TRIANGLE.tobytes()
            + np.float32([0, 1]).tobytes()
            + np.float32([(0, 0, 0, 1)] * 2).tobytes()
            + np.uint8([(0, 0, 0, 0)] * 3).tobytes()
            + np.float32([(1, 0, 0, 0)] * 3).tobytes()
        )
        uri = "data:;base64," + base64.b64encode(data).decode()
        ranges = [(0, 36), (36, 8), (44, 32), (76, 12), (88, 48)]
        kinds = [(5126, "VEC3", 3), (5126, "SCALAR", 2), (5126, "VEC4", 2), (5121, "VEC4", 3)]
        kinds += [(5126, "VEC4", 3)]
        tree = {
            "asset": {"version": "2.0"},
            "extensions": {},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": uri, "byteLength": len(data)}],
            "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": b} for a, b in ranges],
            "accessors": [
                {"bufferView": k, "componentType": c, "type": kind, "count": count}
                for k, (c, kind, count) in enumerate(kinds)
            ],
        }
        change(tree, n)
        return json.dumps(tree, separators=(",", ":")).encode()

    return made


def primitive(tree):
    return tree["meshes"][0]["primitives"][0]


def set_all(**lists):
    """Put lists into the tree, of each entry as many as asked for."""

    def change(tree, n):
        for name, entry in lists.items():
            tree[name] = [entry] * n

    return change


def extended(name, part):
    """Materials with an extension each."""
    return set_all(materials={"extensions": {name: part}})


def nodes_of(**said):
    def change(tree, n):
        tree["nodes"] += [said] * n
        tree["scenes"][0]["nodes"] += list(range(1, n + 1))

    return change


def chain(tree, n):
    tree["nodes"] += [{"children": [k + 2]} for k in range(n)] + [{}]
    tree["scenes"][0]["nodes"].append(1)


def primitives(tree, n):
    tree["meshes"][0]["primitives"] *= n


def other_primitives(tree, n):
    tree["accessors"] += [tree["accessors"][0]] * n
    entries = [{"attributes": {"POSITION": 5 + k}} for k in range(n)]
    tree["meshes"][0]["primitives"] = entries


def attributes(tree, n):
    primitive(tree)["attributes"] |= {f"_{k}": 0 for k in range(n)}


def targets(tree, n):
    primitive(tree)["targets"] = [{"POSITION": 0}] * n


def weights(tree, n):
    targets(tree, n)
    tree["meshes"][0]["weights"] = [0] * n


def bent(tree):
    primitive(tree)["attributes"] |= {"JOINTS_0": 3, "WEIGHTS_0": 4}


def joints(tree, n):
    bent(tree)
    tree["skins"] = [{"joints": [0] * n}]
    tree["nodes"][0]["skin"] = 0


def skins(tree, n):
    bent(tree)
    tree["skins"] = [{"joints": [0]}] * n
    tree["nodes"] += [{"mesh": 0, "skin": k} for k in range(n)]
    tree["scenes"][0]["nodes"] += list(range(1, n + 1))


def channels_of(target):
    def change(tree, n):
        tree["materials"] = [{"pbrMetallicRoughness": {}}]
        primitive(tree)["material"] = 0
        channels = [{"sampler": 0, "target": target}] * n
        tree["animations"] = [{"samplers": [{"input": 1, "output": 1}], "channels": channels}]

    return change


def turning(tree, n):
    channels_of({"node": 0, "path": "rotation"})(tree, n)
    tree["animations"][0]["samplers"][0]["output"] = 2


def long_channels(tree, n):
    """Half of the file a long accessor, half channels that all name it."""
    keys = n // 2
    data = np.arange(keys, dtype=np.float32).tobytes() + bytes(12 * keys)
    uri = "data:;base64," + base64.b64encode(data).decode()
    tree["buffers"].append({"uri": uri, "byteLength": len(data)})
    tree["bufferViews"] += [
        {"buffer": 1, "byteLength": 4 * keys},
        {"buffer": 1, "byteOffset": 4 * keys, "byteLength": 12 * keys},
    ]
    tree["accessors"] += [
        {"bufferView": 5, "componentType": 5126, "type": "SCALAR", "count": keys},
        {"bufferView": 6, "componentType": 5126, "type": "VEC3", "count": keys},
    ]
    tree["nodes"] += [{}] * n
    tree["scenes"][0]["nodes"] += list(range(1, n + 1))
    channels = [{"sampler": 0, "target": {"node": k, "path": "scale"}} for k in range(n)]
    tree["animations"] = [{"samplers": [{"input": 5, "output": 6}], "channels": channels}]


def animations(tree, n):
    turning(tree, 1)
    tree["animations"] *= n


def animation_samplers(tree, n):
    turning(tree, 1)
    tree["animations"][0]["samplers"] *= n


def pointer(text):
    said = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": text}}}
    return channels_of(said)


def mesh_weights_pointers(tree, n):
    targets(tree, 1)
    tree["nodes"] += [{"mesh": 0}] * n
    tree["scenes"][0]["nodes"] += list(range(1, n + 1))
    materials = channels_of(
        {
            "path": "pointer",
            "extensions": {"KHR_animation_pointer": {"pointer": "/meshes/0/weights"}},
        }
    )
    materials(tree, n)


def many_parts_weights(tree, n):
    """A mesh of as many kinds of primitives as channels that move its weights."""
    few = max(n // 8, 1)
    entries = []
    for k in range(few):
        entry = {
            "attributes": {"POSITION": 0},
            "mode": 0,
            "material": k,
            "targets": [{"POSITION": 0}],
        }
        entries.append(entry)
    channels_of({"node": 0, "path": "weights"})(tree, n)
    tree["meshes"][0]["primitives"] = entries
    tree["materials"] = [{"alphaCutoff": k / few} for k in range(few)]


def lights(tree, n):
    tree["extensions"]["KHR_lights_punctual"] = {"lights": [{"type": "point"}] * n}
    nodes_of(extensions={"KHR_lights_punctual": {"light": 0}})(tree, n)


def variant_names(tree, n):
    tree["materials"] = [{}]
    tree["extensions"]["KHR_materials_variants"] = {"variants": [{"name": "a"}] * n}


def variants(tree, n):
    """As many names as mappings of a primitive."""
    variant_names(tree, n)
    mappings = [{"material": 0, "variants": [k]} for k in range(n)]
    primitive(tree)["extensions"] = {"KHR_materials_variants": {"mappings": mappings}}


def variants_of_parts(tree, n):
    """A primitive that names many variants, beside as many that name none."""
    variant_names(tree, n)
    mappings = [{"material": 0, "variants": list(range(n))}]
    named = {**primitive(tree), "extensions": {"KHR_materials_variants": {"mappings": mappings}}}
    tree["meshes"][0]["primitives"] = [named, *[primitive(tree)] * n]


def instances(tree, n):
    data = bytes(12 * n)
    uri = "data:;base64," + base64.b64encode(data).decode()
    tree["buffers"].append({"uri": uri, "byteLength": len(data)})
    tree["bufferViews"].append({"buffer": 1, "byteLength": len(data)})
    said = {"bufferView": 5, "componentType": 5126, "type": "VEC3", "count": n}
    tree["accessors"].append(said)
    tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 5}}}


def instanced_nodes(tree, n):
    instances(tree, 100)
    tree["nodes"] *= n
    tree["scenes"][0]["nodes"] = list(range(n))


def sparse(tree, n):
    tree["accessors"] += [
        {**tree["accessors"][0], "sparse": {
            "count": 1,
            "indices": {"bufferView": 3, "componentType": 5121},
            "values": {"bufferView": 0},
        }}
    ] * n  # fmt: skip
    entries = [{"attributes": {"POSITION": 5 + k}} for k in range(n)]
    tree["meshes"][0]["primitives"] = entries


def textured(info):
    def change(tree, n):
        tree["images"], tree["textures"] = [{"uri": PICTURE}], [{"source": 0}]
        part = {"baseColorTexture": info}
        tree["materials"] = [{"pbrMetallicRoughness": part}] * n

    return change


def percent(tree, n):
    data = "%00" * n
    tree["buffers"].append({"uri": f"data:,{data}", "byteLength": n})
    tree["bufferViews"].append({"buffer": 1, "byteLength": n})
    tree["accessors"].append(
        {"bufferView": 5, "componentType": 5121, "type": "SCALAR", "count": n, "normalized": True}
    )
    primitive(tree)["mode"] = 0


def used_percent(tree, n):
    percent(tree, 12 * n)
    tree["accessors"][-1] |= {"componentType": 5126, "type": "VEC3", "count": n}
    primitive(tree)["attributes"]["POSITION"] = 5


GLTF = {
    "nodes": nodes_of(),
    "nodes that show a mesh": nodes_of(mesh=0),
    "nodes with matrices": nodes_of(matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
    "nodes below one another": chain,
    "scenes": set_all(scenes={"nodes": [0]}),
    "meshes": lambda tree, n: tree["meshes"].extend([tree["meshes"][0]] * n),
    "primitives, all the same": primitives,
    "primitives of other accessors": other_primitives,
    "attributes": attributes,
    "targets": targets,
    "weights": weights,
    "accessors": lambda tree, n: tree["accessors"].extend([tree["accessors"][0]] * n),
    "sparse accessors": sparse,
    "bufferViews": lambda tree, n: tree["bufferViews"].extend([{"buffer": 0, "byteLength": 0}] * n),
    "buffers": lambda tree, n: tree["buffers"].extend([{"uri": "data:,a", "byteLength": 1}] * n),
    "percent-encoded data, not used": percent,
    "percent-encoded data": used_percent,
    "images": lambda tree, n: (
        set_all(images={"uri": PICTURE})(tree, n),
        tree.update(
            textures=[{"source": k} for k in range(n)],
            materials=[{"emissiveTexture": {"index": k}} for k in range(n)],
        ),
    ),
    "textures": set_all(textures={}),
    "samplers": set_all(samplers={}),
    "materials": set_all(materials={}),
    "materials with a texture": textured({"index": 0}),
    "KHR_texture_transform": textured(
        {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}
    ),
    "cameras": set_all(cameras={"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}),
    "skins": skins,
    "joints": joints,
    "animations": animations,
    "channels": turning,
    "channels of one long accessor": long_channels,
    "channels of weights of many parts": many_parts_weights,
    "samplers of animations": animation_samplers,
    "KHR_animation_pointer": pointer("/materials/0/pbrMetallicRoughness/roughnessFactor"),
    "KHR_animation_pointer, not played": pointer("/x/0/y"),
    "KHR_animation_pointer, weights of a mesh": mesh_weights_pointers,
    "KHR_lights_punctual": lights,
    "KHR_node_visibility": nodes_of(extensions={"KHR_node_visibility": {"visible": False}}),
    "KHR_materials_variants, names": variant_names,
    "KHR_materials_variants, mappings": variants,
    "KHR_materials_variants, primitives": variants_of_parts,
    "EXT_mesh_gpu_instancing, instances": instances,
    "EXT_mesh_gpu_instancing, nodes": instanced_nodes,
    "extensionsUsed": set_all(extensionsUsed="KHR_x"),
    "extras": lambda tree, n: tree.update(extras=[0] * n),
    **{
        name: extended(name, part)
        for name, part in {
            "KHR_materials_anisotropy": {"anisotropyStrength": 1},
            "KHR_materials_clearcoat": {"clearcoatFactor": 1},
            "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 1},
            "KHR_materials_emissive_strength": {"emissiveStrength": 2},
            "KHR_materials_ior": {"ior": 2},
            "KHR_materials_iridescence": {"iridescenceFactor": 1},
            "KHR_materials_pbrSpecularGlossiness": {"glossinessFactor": 0},
            "KHR_materials_sheen": {"sheenRoughnessFactor": 1},
            "KHR_materials_specular": {"specularFactor": 0},
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_unlit": {},
            "KHR_materials_volume": {"thicknessFactor": 1},
        }.items()
    },
}


def lines(head, line, tail=""):
    """Text of a line for each number."""

    def made(n):
        body = "\n".join(line(k) if callable(line) else line for k in range(n))
        return f"{head}\n{body}\n{tail}".encode()

    return made


def ply(head, row, binary=False):
    def made(n):
        header = f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\n"
        header += head(n) + "end_header\n"
        return header.encode() + (row * n if binary else (row * n).encode())

    return made


def stl(n):
    return bytes(80) + struct.pack("<I", n) + struct.pack("<12fH", *range(12), 0) * n


FACET = (
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet"
)
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
ONE = (
    '<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
    '<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/>'
    "</triangles></mesh>"
)


def threemf(resources, build='<item objectid="1"/>'):
    """A package that is stored, not packed, so that its size is that of its records."""

    def made(n):
        text = f'<model unit="millimeter" xmlns="{CORE}"><resources>{resources(n)}</resources>'
        text += f"<build>{build(n) if callable(build) else build}</build></model>"
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w") as archive:
            archive.writestr("a.model", text)
        return file.getvalue()

    return made


BALL = '<geometry><sphere radius=".1"/></geometry>'
MISSING = '<geometry><mesh filename="none.stl"/></geometry>'


def robot(part):
    """A robot with a link and a number of parts."""

    def made(n):
        text = f'<robot name="r"><link name="a"><visual>{BALL}</visual></link>'
        return (text + "".join(map(part, range(n))) + "</robot>").encode()

    return made


PART = (
    '<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>'
)
GEOMETRY = (
    '<geometry id="{}"><mesh><source id="p"><float_array>0 0 0 1 0 0 0 1 0</float_array></source>'
    f'<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{PART}</mesh></geometry>'
)


def collada(geometries, nodes=""):
    """A COLLADA file with a number of geometries, or of nodes that show one."""

    def made(n):
        shown = nodes * n or '<node><instance_geometry url="#g"/></node>'
        text = f"<COLLADA><library_geometries>{GEOMETRY.format('g')}{geometries(n)}"
        text += "</library_geometries><library_visual_scenes><visual_scene id='s'>"
        text += f"{shown}</visual_scene></library_visual_scenes><scene>"
        return (text + "<instance_visual_scene url='#s'/></scene></COLLADA>").encode()

    return made


def one(n):
    return f'<object id="1">{ONE}</object>'


def mesh_of(vertices, triangles):
    head = '<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/>'
    return f'{head}<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>{vertices}</vertices>' + (
        f'<triangles><triangle v1="0" v2="1" v3="2"/>{triangles}</triangles></mesh></object>'
    )


def scene(**lists):
    def made(n):
        tree = {"format": "engine3d scene", "version": 1, "scene": {}}
        tree |= {"objects": [{"kind": "mesh", "primitive": "box"}], "nodes": [{"object": 0}]}
        for name, entry in lists.items():
            tree[name] = [entry(k) if callable(entry) else entry for k in range(n)]
        return json.dumps(tree, separators=(",", ":")).encode()

    return made


QUAD = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1"
OTHERS = {
    "obj": {
        "v": lines("", "v 0 0 0", "f 1 2 3"),
        "vt": lines(QUAD, "vt 0 0", "f 1 2 3"),
        "vn": lines(QUAD, "vn 0 0 1", "f 1 2 3"),
        "f": lines(QUAD, "f 1 2 3"),
        "f of many corners": lambda n: f"{QUAD}\nf {'1 2 3 ' * n}".encode(),
        "l": lines(QUAD, "l 1 2", "f 1 2 3"),
        "p": lines(QUAD, "p 1", "f 1 2 3"),
        "o": lines(QUAD, lambda k: f"o {k}\nf 1 2 3"),
        "g": lines(QUAD, lambda k: f"g {k}\nf 1 2 3"),
        "usemtl": lines(QUAD, lambda k: f"usemtl {k}\nf 1 2 3"),
        "s": lines(QUAD, lambda k: f"s {k}\nf 1 2 3"),
        "mtllib": lines(QUAD, lambda k: f"mtllib {k}", "f 1 2 3"),
        "unknown": lines(QUAD, lambda k: f"x{k}", "f 1 2 3"),
    },
    "ply": {
        "vertex": ply(lambda n: f"element vertex {n}\n" + "".join(
            f"property float {c}\n" for c in "xyz"), "0 0 0\n"),
        "vertex, binary": ply(lambda n: f"element vertex {n}\n" + "".join(
            f"property float {c}\n" for c in "xyz"), bytes(12), True),
        "face": ply(lambda n: "element vertex 1\n" + "".join(
            f"property float {c}\n" for c in "xyz") + f"element face {n}\n"
            "property list uchar int vertex_indices\n", "3 0 0 0\n"),
        "property": lambda n: (
            "ply\nformat ascii 1.0\nelement vertex 1\n"
            + "".join(f"property float {c}\n" for c in "xyz")
            + "".join(f"property uchar p{k}\n" for k in range(n))
            + "end_header\n0 0 0" + " 0" * n + "\n"
        ).encode(),
        "element": lambda n: (
            "ply\nformat ascii 1.0\nelement vertex 1\n"
            + "".join(f"property float {c}\n" for c in "xyz")
            + "".join(f"element e{k} 0\nproperty int i\n" for k in range(n))
            + "end_header\n0 0 0\n"
        ).encode(),
        "comment": lambda n: (
            "ply\nformat ascii 1.0\n" + "comment a\n" * n + "element vertex 1\n"
            + "".join(f"property float {c}\n" for c in "xyz") + "end_header\n0 0 0\n"
        ).encode(),
    },
    "stl": {
        "facet": lines("solid a", FACET, "endsolid a"),
        "facet, binary": stl,
        "solid": lines("", lambda k: f"solid {k}\n{FACET}\nendsolid {k}"),
    },
    "off": {
        "vertex": lambda n: (f"OFF\n{n} 1 0\n" + "0 0 0\n" * n + "3 0 1 2\n").encode(),
        "face": lambda n: (f"OFF\n3 {n} 0\n" + "0 0 0\n" * 3 + "3 0 1 2\n" * n).encode(),
    },
    "3mf": {
        "vertex": threemf(lambda n: mesh_of('<vertex x="0" y="0" z="0"/>' * n, "")),
        "triangle": threemf(lambda n: mesh_of("", '<triangle v1="0" v2="1" v3="2"/>' * n)),
        "object": threemf(
            lambda n: "".join(f'<object id="{k + 1}">{ONE}</object>' for k in range(n)),
            lambda n: "".join(f'<item objectid="{k + 1}"/>' for k in range(n)),
        ),
        "item": threemf(one, lambda n: '<item objectid="1"/>' * n),
        "component": threemf(
            lambda n: one(n)
            + '<object id="2"><components>'
            + '<component objectid="1"/>' * n + "</components></object>",
            '<item objectid="2"/>',
        ),
        "base": threemf(
            lambda n: '<basematerials id="9">'
            + '<base name="a" displaycolor="#FF0000"/>' * n + "</basematerials>" + one(n)
        ),
        "metadata": threemf(lambda n: '<metadata name="a">b</metadata>' * n + one(n)),
    },
    "urdf": {
        "link": robot(lambda k: f'<link name="l{k}"/>'),
        "visual": robot(lambda k: f'<link name="l{k}"><visual>{BALL}</visual></link>'),
        "missing mesh": robot(lambda k: f'<link name="l{k}"><visual>{MISSING}</visual></link>'),
        "joint": robot(
            lambda k: f'<link name="l{k}"/><joint name="j{k}" type="continuous">'
            f'<parent link="{f"l{k - 1}" if k else "a"}"/><child link="l{k}"/></joint>'
        ),
        "material": robot(lambda k: f'<material name="m{k}"><color rgba="1 0 0 1"/></material>'),
    },
    "dae": {
        "node": collada(lambda n: "", '<node><instance_geometry url="#g"/></node>'),
        "geometry": collada(lambda n: "".join(GEOMETRY.format(f"h{k}") for k in range(n))),
        "primitive": collada(lambda n: GEOMETRY.format("h").replace(PART, PART * n)),
        "index": collada(lambda n: GEOMETRY.format("h").replace("0 1 2", "0 1 2 " * n)),
    },
    "json": {
        "node": scene(nodes={"object": 0}),
        "object": scene(objects={"kind": "mesh", "primitive": "box"}),
        "object and node": scene(
            objects={"kind": "mesh", "primitive": "box"}, nodes=lambda k: {"object": k}
        ),
        "material": scene(materials={"name": "a"}),
        "light": scene(
            objects={"kind": "point light"}, nodes=lambda k: {"object": k}
        ),
        "environment": scene(environments={"built_in": "studio"}),
    },
}  # fmt: skip


def records():
    """Yield the end of a file's name, what is repeated, and what makes such a file."""
    for name, change in GLTF.items():
        yield "gltf", name, gltf(change)
    for end, made in OTHERS.items():
        for name, make in made.items():
            yield end, name, make


def sized(make, size):
    """A file of about so many bytes."""
    count, few = 64, len(make(4))
    for _ in range(3):
        count = max(int(count * (size - few) / max(len(make(count)) - few, 1)), 8)
    return make(count)


def cost(load, path, data):
    """Seconds of the processor, and bytes of memory at most, for each byte; what came of it."""
    from engine3d.errors import Engine3DError

    path.write_bytes(data)

    def loaded():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                load(path)
            except Engine3DError as error:
                return str(error).partition(": ")[2]
            return ""

    start = time.process_time()
    said = loaded()
    seconds = time.process_time() - start
    tracemalloc.start()
    loaded()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return seconds, peak, said


def main(size=300_000):
    import pathlib
    import tempfile

    from engine3d import load_scene

    with tempfile.TemporaryDirectory() as folder:
        for end, name, make in records():
            path = pathlib.Path(folder) / f"a.{end}"
            path.write_bytes(make(20))
            cost(load_scene, path, make(20))
            data = sized(make, size)
            seconds, peak, said = cost(load_scene, path, data)
            row = f"{1e6 * seconds / len(data):.2f} | {peak / len(data):.0f}"
            print(f"| {end} | {name} | {row} | {said[:60]} |", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
