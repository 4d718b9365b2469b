"""Small files, damaged at random: each loads or raises an error of the project's own."""

import random
import warnings

import numpy as np
import pytest
from loaders.seeds import FILES

from engine3d.errors import Engine3DError
from engine3d.loaders import load_document, load_mesh, load_texture

WORDS = [b"f ", b"v ", b"vt", b"/", b"-", b"\n", b"1e999", b"nan", b"\\\n", b"#", b"s 3\n"]
WORDS += [b"usemtl q\n", b"mtllib .\n", b"99999999999", b"\xff", b"\0", b'"', b"o x\n"]
WORDS += [b"Face 0:", b"Vertex 9:"]


def mutated(data, choice):
    data = bytearray(data)
    for _ in range(choice.randint(1, 6)):
        at = choice.randrange(len(data) + 1)
        kind = choice.random()
        if kind < 0.3:
            data[at : at + 1] = bytes([choice.randrange(256)])
        elif kind < 0.5:
            del data[at : at + choice.randint(1, 20)]
        elif kind < 0.8:
            data[at:at] = choice.choice(WORDS)
        elif kind < 0.95:
            data[at:at] = data[max(0, at - choice.randint(1, 80)) : at]
        else:
            del data[at:]
    return bytes(data)


def check_mesh(path):
    mesh = load_mesh(path)
    for array in (mesh.normals, mesh.face_normals, mesh.bounds):
        assert np.isfinite(array).all()
    assert mesh.uvs is None or np.isfinite(mesh.uvs).all()
    assert len(mesh.polygons) == len(mesh.faces)
    assert mesh.edges().max(initial=0) < max(len(mesh.positions), 1)
    load_document(path)


@pytest.mark.parametrize(("name", "data"), FILES.items(), ids=FILES)
def test_damaged_files_load_or_raise_our_own_error(write, name, data):
    for other, content in FILES.items():
        write(other, content)
    loaded = 0
    choice = random.Random(name)
    for _ in range(300):
        path = write(name, mutated(data, choice))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                if name.endswith("tga"):
                    load_texture(path)
                else:
                    check_mesh(path.with_name("house.obj") if name.endswith("mtl") else path)
                loaded += 1
            except Engine3DError as error:
                assert name in str(error)
                assert "\n" not in str(error)
    assert loaded > 0
