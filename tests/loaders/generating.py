"""Files made up at random by each format's own rules, and rules for damaging any file.

In: a `random.Random`. Out: bytes. Most of what is made up nearly holds together: counts that are
off by a little, indices about the ends of their range, numbers that are not quite numbers.
"""

from __future__ import annotations

import copy
import json
import random
import re
import struct

from loaders.seeds import GLTF, MOVING_GLTF, SCENE, THREEMF, threemf_package

WORDS = [b"f ", b"v ", b"vt", b"/", b"-", b"\n", b"1e999", b"nan", b"\\\n", b"#", b"s 3\n"]
WORDS += [b"usemtl q\n", b"mtllib .\n", b"99999999999", b"\xff", b"\0", b'"', b"o x\n"]
WORDS += [b"Face 0:", b"Vertex 9:", b"\r", b"\x1a", b"\xef\xbb\xbf", b"\xff\xfe", b"\t"]

NUMBERS = ["0", "1", "-1", "0.5", "1e9", "-0", "1e39", "-1e308", "1e-320", "nan", "inf", "-inf"]
NUMBERS += ["1e999", "2147483647", "2147483648", "4294967296", "-2147483649", "1_0", "0x10", "1."]
NUMBERS += ["", "+", ".", "1e", "1#QNAN", "1.#INF", "９", "1" * 400, "0" * 30 + "1", "1,5"]
NUMBERS += ["000000001999", "18446744073709551616", "9" * 5000]

_NUMBER = re.compile(rb"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")


def mutated(data: bytes, choice: random.Random) -> bytes:
    """Damage bytes in a few places: single ones, pieces, lines, numbers."""
    data = bytearray(data)
    for _ in range(choice.randint(1, 6)):
        at = choice.randrange(len(data) + 1)
        kind = choice.random()
        if kind < 0.2:
            data[at : at + 1] = bytes([choice.randrange(256)])
        elif kind < 0.35:
            del data[at : at + choice.randint(1, 20)]
        elif kind < 0.55:
            data[at:at] = choice.choice(WORDS)
        elif kind < 0.75:
            match = _NUMBER.search(data, at)
            if match is not None:
                data[match.start() : match.end()] = choice.choice(NUMBERS).encode()
        elif kind < 0.87:
            data[at:at] = data[max(0, at - choice.randint(1, 80)) : at]
        elif kind < 0.93:
            lines = data.split(b"\n")
            choice.shuffle(lines)
            data = bytearray(b"\n".join(lines))
        elif kind < 0.97:
            data[at : at + 4] = struct.pack("<i", choice.choice([-1, 0, 1 << 30, 255, 65535]))
        else:
            del data[at:]
    return bytes(data)


def enlarged(data: bytes, choice: random.Random, size: int) -> bytes:
    """Repeat a piece of a file until that has about so many bytes: what takes long shows here."""
    ends = [0, len(data), *(at + 1 for at, byte in enumerate(data) if byte == 10)]
    first, end = sorted(choice.choice(ends) for _ in range(2))
    piece = data[first:end] or data or b" "
    return data[:first] + piece * (size // len(piece)) + data[end:]


# ---- pieces ----


def _number(choice: random.Random) -> str:
    if choice.random() < 0.04:
        return choice.choice(NUMBERS)
    if choice.random() < 0.5:
        return str(choice.randint(-3, 3))
    return f"{choice.uniform(-2, 2):.{choice.randint(0, 9)}g}"


def _numbers(choice: random.Random, count: int) -> str:
    if choice.random() < 0.02:
        count += choice.choice([-1, 1])
    return " ".join(_number(choice) for _ in range(count))


def _count(choice: random.Random, honest: int) -> int:
    """Mostly the truth."""
    if choice.random() < 0.9:
        return honest
    return choice.choice([0, 1, honest - 1, honest + 1, -1, 10**6, 10**9, 2**31, 2**32, 2**63])


def _index(choice: random.Random, count: int) -> int:
    if choice.random() < 0.02:
        return choice.choice([-1, count, count + 1, 2**31 - 1, 2**31, -(2**31)])
    return choice.randrange(max(count, 1))


def _lines(choice: random.Random, lines: list[str]) -> bytes:
    end = choice.choice(["\n"] * 6 + ["\r\n", "\r"])
    return (end.join(lines) + choice.choice([end, ""])).encode()


# ---- formats ----


def _obj(choice: random.Random) -> bytes:
    lines, counts = ["mtllib house.mtl"], {"v": 0, "vt": 0, "vn": 0}

    def part(name: str) -> str:
        if choice.random() < 0.2 or not counts[name]:
            return ""
        index = _index(choice, counts[name])
        return str(index + 1 if choice.random() < 0.7 else index - counts[name])

    for _ in range(choice.randint(1, 60)):
        kind = choice.choice(
            ["v"] * 6 + ["vt", "vn", "f", "f", "f", "f", "l", "p", "g", "s", "u", "?"]
        )
        if kind in counts:
            columns = {"v": choice.choice([3, 3, 3, 6, 7, 4]), "vt": 2, "vn": 3}[kind]
            lines.append(f"{kind} {_numbers(choice, columns)}")
            counts[kind] += 1
        elif kind in ("f", "l", "p"):
            corners = []
            for _ in range(choice.choice([1, 2, 3, 3, 3, 4, 5, 9])):
                v = str(_index(choice, counts["v"]) + 1)
                corners.append("/".join([v, part("vt"), part("vn")][: choice.randint(1, 3)]))
            lines.append(f"{kind} {' '.join(corners)}")
        else:
            words = {"g": "g a b", "s": f"s {choice.choice(NUMBERS)}", "u": "usemtl brick"}
            lines.append(words.get(kind, choice.choice(["o q", "curv 1 2", "usemtl", "\\", "#"])))
    return _lines(choice, lines)


def _mtl(choice: random.Random) -> bytes:
    lines = []
    for k in range(choice.randint(0, 4)):
        lines.append(f"newmtl {choice.choice(['brick', 'q', '', f'm{k}'])}")
        for _ in range(choice.randint(0, 8)):
            word = choice.choice(["Kd", "Ks", "Ka", "Ke", "Ns", "d", "Tr", "illum", "Ni", "Tf"])
            map_word = choice.choice(["map_Kd", "map_Bump", "map_d", "refl", "bump", "map_Ks"])
            options = choice.choice(["", "-s 2 2 1", "-o .5", "-mm 0 1", "-clamp on", "-bm", "-t"])
            name = choice.choice(
                ["house.tga", "none.png", "../x.tga", "/etc/passwd", "", "a b.tga"]
            )
            if choice.random() < 0.4:
                lines.append(f"{map_word} {options} {_number(choice)} {name}")
            else:
                head = choice.choice(["", "", "", "spectral ", "xyz "])
                lines.append(f"{word} {head}{_numbers(choice, choice.choice([1, 3, 3]))}")
    return _lines(choice, lines)


def _asc(choice: random.Random) -> bytes:
    lines = []
    for _ in range(choice.randint(1, 4)):
        lines.append(f'Named object: "{choice.choice(["Lamp", "Eye", "Box", ""])}"')
        kind = choice.random()
        point = "X:{} Y:{} Z:{}"
        if kind < 0.25:
            lines.append(
                choice.choice(["Direct light", "Spotlight", f"Camera ({_number(choice)}mm)"])
            )
            lines += [
                f"{word}: " + point.format(*(_number(choice) for _ in range(3)))
                for word in ("Position", "Target", "Spotlight to")
            ]
            color = "Light color: Red={} Green={} Blue={}"
            lines.append(color.format(*(_number(choice) for _ in range(3))))
            lines.append(f"Falloff size: {_number(choice)}")
            lines.append(f"Bank angle: {_number(choice)}")
            continue
        vertices, faces = choice.randint(0, 8), choice.randint(0, 8)
        lines.append(
            f"Tri-mesh, Vertices: {_count(choice, vertices)}     Faces: {_count(choice, faces)}"
        )
        lines += ["Mapped", "Vertex list:"] if choice.random() < 0.5 else ["Vertex list:"]
        for k in range(vertices):
            uv = f" U:{_number(choice)} V:{_number(choice)}" if choice.random() < 0.5 else ""
            lines.append(f"Vertex {k}: " + point.format(*(_number(choice) for _ in range(3))) + uv)
        lines.append("Face list:")
        for k in range(faces):
            abc = [_index(choice, vertices) for _ in range(3)]
            lines.append("Face {}: A:{} B:{} C:{} AB:1 BC:0 CA:1".format(k, *abc))
            if choice.random() < 0.5:
                lines.append(f'Material:"{choice.choice(["r255g128b0a0", "x", ""])}"')
            if choice.random() < 0.5:
                lines.append(f"Smoothing: {choice.choice(NUMBERS)}, {choice.randint(0, 33)}")
    return _lines(choice, lines)


_PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I"}
_PLY_TYPES |= {"float": "f", "double": "d"}
_PLY_NAMES = ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "s", "t", "u", "v"]
_PLY_NAMES += ["texture_u", "quality", "vertex_indices", "vertex_index", "texcoord", "texnumber"]
_PLY_NAMES += ["material_index", "vertex1", "vertex2", "x", ""]


def _ply(choice: random.Random) -> bytes:
    encoding = choice.choice(["ascii", "binary_little_endian", "binary_big_endian"])
    header, body = ["ply", f"format {encoding} 1.0", "comment TextureFile house.tga"], []
    names = ["vertex", "face"] + choice.sample(["edge", "tristrips", "material", "x"], 1)
    if choice.random() < 0.1:
        choice.shuffle(names)
    vertices = choice.randint(0, 8)
    for name in names:
        rows = vertices if name == "vertex" else choice.randint(0, 5)
        header.append(f"element {name} {_count(choice, rows)}")
        columns = []
        if name == "vertex":
            columns = [(axis, choice.choice(["float", "double", "int"]), None) for axis in "xyz"]
        elif name in ("face", "tristrips"):
            counts = choice.choice(["uchar", "int", "uint", "ushort"])
            columns = [("vertex_indices", choice.choice(["int", "uint", "short"]), counts)]
        elif name == "edge":
            columns = [("vertex1", "int", None), ("vertex2", "int", None)]
        for _ in range(choice.choice([0, 0, 1, 2, 3])):
            counts = choice.choice([None, None, "uchar", "char", "int"])
            columns.append((choice.choice(_PLY_NAMES), choice.choice(list(_PLY_TYPES)), counts))
        for column, kind, counts in columns:
            prefix = f"list {counts} " if counts else ""
            header.append(f"property {prefix}{kind} {column}")
        for _ in range(rows):
            body += _ply_row(choice, columns, vertices, encoding)
    end = choice.choice(["\n", "\n", "\n", "\r\n"])
    return (end.join([*header, "end_header"]) + end).encode() + b"".join(body)


def _ply_row(choice: random.Random, columns, vertices: int, encoding: str) -> list[bytes]:
    order = ">" if "big" in encoding else "<"
    words: list[str] = []
    row: list[bytes] = []
    for column, kind, counts in columns:
        size = choice.choice([0, 2, 3, 3, 3, 4, 6]) if counts else 1
        if counts:
            words.append(str(size))
            row.append(struct.pack(order + _PLY_TYPES[counts], size))
        for _ in range(size):
            if kind in ("float", "double"):
                words.append(_number(choice))
                row.append(struct.pack(order + _PLY_TYPES[kind], choice.uniform(-2, 2)))
            else:
                value = _index(choice, vertices) if "vertex" in column else choice.randint(0, 9)
                words.append(str(value))
                code = _PLY_TYPES[kind]
                bits = 8 * struct.calcsize(code)
                packed = (value % (1 << bits)).to_bytes(
                    bits // 8, "big" if order == ">" else "little"
                )
                row.append(packed)
    return [(" ".join(words) + "\n").encode()] if encoding == "ascii" else row


def _threemf(choice: random.Random) -> bytes:
    """A sound package of damaged XML: what mutates a packed file rarely gets past its checksums."""
    name = choice.choice(["3D/model.model", "3D/model.model", "3D/model.model", "_rels/.rels"])
    return threemf_package({**THREEMF, name: mutated(THREEMF[name], choice)})


def _off(choice: random.Random) -> bytes:
    vertices, faces = choice.randint(0, 8), choice.randint(0, 6)
    head = choice.choice(
        ["OFF", "OFF", "COFF", "NOFF", "STOFF", "CNOFF", "4OFF", "nOFF", "OFF BINARY"]
    )
    lines = [head, f"{_count(choice, vertices)} {_count(choice, faces)} {choice.choice(NUMBERS)}"]
    if head == "nOFF":
        lines.insert(1, str(choice.randint(0, 5)))
    columns = 3 + 4 * ("C" in head) + 3 * ("N" in head) + 2 * ("ST" in head) + head.startswith("4")
    lines += [_numbers(choice, columns) for _ in range(vertices)]
    for _ in range(faces):
        size = choice.choice([1, 2, 3, 3, 4, 5])
        corners = " ".join(str(_index(choice, vertices)) for _ in range(size))
        lines.append(
            f"{_count(choice, size)} {corners} {_numbers(choice, choice.choice([0, 0, 1, 3, 4]))}"
        )
    return _lines(choice, lines)


def _stl(choice: random.Random) -> bytes:
    facets = choice.randint(0, 6)
    if choice.random() < 0.5:
        numbers = [choice.choice([0.0, 1.0, -1.0, 3e38, float("nan"), 1e-40]) for _ in range(12)]
        body = b"".join(struct.pack("<12fH", *choice.sample(numbers, 12), 0) for _ in range(facets))
        count = _count(choice, facets) & 0xFFFFFFFF
        return choice.choice([b"solid", b"binary", b""]).ljust(80) + struct.pack("<I", count) + body
    lines = ["solid a"]
    for _ in range(facets):
        lines += [f"facet normal {_numbers(choice, 3)}", "outer loop"]
        lines += [f"vertex {_numbers(choice, 3)}" for _ in range(choice.choice([3, 3, 3, 4, 2, 6]))]
        lines += ["endloop", "endfacet"]
        if choice.random() < 0.1:
            lines += ["endsolid a", "solid b"]
    return _lines(choice, [*lines, "endsolid"])


def _tga(choice: random.Random) -> bytes:
    kind = choice.choice([1, 2, 3, 9, 10, 11, 0, 32])
    mapped, bits = kind in (1, 9), choice.choice([8, 15, 16, 24, 32])
    width, height = (choice.choice([1, 2, 5, 16, 0, 300, 65535]) for _ in range(2))
    entries = choice.choice([1, 4, 256, 65535]) if mapped else choice.choice([0, 0, 3])
    id_length = choice.choice([0, 0, 5])
    first = choice.choice([0, 0, 1, 65535])
    map_bits, flags = (
        choice.choice([15, 16, 24, 32, 17]),
        choice.choice([0, 8, 0x20, 0x30, 1, 0xC0]),
    )
    head = struct.pack(
        "<BBBHHBHHHHBB", id_length, int(entries > 0), kind, first, entries, map_bits,
        0, 0, width, height, bits, flags,
    )  # fmt: skip
    honest = min(width * height, 4096) * ((bits + 7) // 8) + min(entries, 256) * 4
    return head + choice.randbytes(id_length + choice.choice([honest, honest, honest // 2, 7]))


_VALUES = [None, True, -1, 0, 1, 2, 3, 4, 7, 0.5, 3.0, 5121, 5123, 5126, 2**31, 2**53, 2**64]
_VALUES += [1e39, 1e308, "", "2.0", "BLEND", "VEC3", "\ud800", "house.tga", "data:,x", [], {}, [{}]]


def _gltf(choice: random.Random) -> bytes:
    return _other_values(json.loads(choice.choice([GLTF, MOVING_GLTF])), choice)


def _scene(choice: random.Random) -> bytes:
    return _other_values(json.loads(SCENE), choice)


def _other_values(tree: dict, choice: random.Random) -> bytes:
    """Some values of the JSON are others, some are left out or stand elsewhere."""
    for _ in range(choice.randint(1, 3)):
        places = list(_places(tree))
        parent, key = choice.choice(places)
        kind = choice.random()
        if kind < 0.15:
            del parent[key]
        elif kind < 0.3:
            other, name = choice.choice(places)
            parent[key] = copy.deepcopy(other[name])
        elif kind < 0.4 and isinstance(parent, list):
            parent.append(copy.deepcopy(parent[key]))
        else:
            parent[key] = choice.choice(_VALUES)
    return json.dumps(tree).encode()


def _places(tree):
    """Every value of a JSON tree, as what holds it and its name or number there."""
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in list(entries):
        yield tree, key
        if isinstance(value, (dict, list)):
            yield from _places(value)


GENERATORS = {
    ".gltf": _gltf,
    ".json": _scene,
    ".obj": _obj,
    ".mtl": _mtl,
    ".asc": _asc,
    ".ply": _ply,
    ".3mf": _threemf,
    ".off": _off,
    ".stl": _stl,
    ".tga": _tga,
}
