"""Files rebuilt from what people report of viewers and loaders: each loads, and with a word or not.

The corpus is no part of the project: see shared_corpus.py.
"""

import warnings

import pytest
from shared_corpus import SHARED

from engine3d.errors import FileFormatError
from engine3d.loaders import load_mesh

REPORTS = SHARED / "reports"
pytestmark = pytest.mark.skipif(
    not REPORTS.is_dir(), reason="needs the reports in ../shared (or ENGINE3D_SHARED)"
)
#: Files -> vertices, faces, the first material's colour, whether it has a texture, warnings.
LOADED = {
    "01-off-joined-header/m.off": (8, 12, (1, 1, 1), False, 0),
    "04-off-tokens/m.off": (8, 12, (1, 1, 1), False, 0),
    "111-mtl-case-names/m.obj": (4, 2, (1, 0, 0), False, 0),
    "113-gltf-u8-colors-not-normalized/m.gltf": (4, 2, (1, 1, 1), False, 0),
    "119-mtl-nfd-name/m.obj": (4, 2, (1, 1, 1), True, 0),
    "121-obj-vt-underflow/m.obj": (3, 1, (1, 1, 1), False, 0),
    "123-mtl-sjis-plain/m.obj": (4, 2, (1, 1, 1), True, 0),
    "13-stl-solid-binary-tail/m.stl": (8, 12, (1, 1, 1), False, 1),
    "14-stl-one-line-facets/m.stl": (8, 12, (1, 1, 1), False, 0),
    "16-stl-vertex-4-lines/m.stl": (8, 12, (1, 1, 1), False, 0),
    "20-ply-double-01/m.ply": (8, 12, (1, 1, 1), False, 0),
    "22-ply-splats/m.ply": (500, 0, (1, 1, 1), False, 1),
    "24-ply-cloud-face0/m.ply": (8, 0, (1, 1, 1), False, 0),
    "26-ply-uv-vertex/m.ply": (4, 2, (1, 1, 1), True, 0),
    "28-ply-face-first/m.ply": (36, 12, (1, 1, 1), False, 0),
    "30-obj-no-usemtl/textured.obj": (4, 2, (0.8, 0.8, 0.8), True, 1),
    "31-obj-parent-images/models/model_normalized.obj": (4, 2, (1, 1, 1), False, 1),
    "32-mtl-tr-one/m.obj": (8, 12, (0.8, 0.2, 0.2), False, 1),
    "37-mtl-lower-case/m.obj": (4, 2, (0.9, 0.9, 0.9), True, 0),
    "39-mtl-drive-path/m.obj": (4, 2, (1, 1, 1), True, 1),
    "40-mtl-drive-path-sub/m.obj": (4, 2, (1, 1, 1), True, 1),
    "42-obj-w-one/m.obj": (8, 12, (1, 1, 1), False, 0),
    "43-obj-w-two/m.obj": (8, 12, (1, 1, 1), False, 0),
    "46-obj-bezier-only/m.obj": (16, 0, (1, 1, 1), False, 5),
    "47-obj-mrgb/m.obj": (8, 12, (1, 1, 1), False, 0),
    "51-mtl-utf16/m.obj": (4, 2, (0, 0.5, 1), False, 0),
    "54-obj-curves-2d/m.obj": (8, 12, (1, 1, 1), False, 6),
    "55-mtl-illum-glass/m.obj": (8, 12, (0.3, 0.5, 0.9), False, 0),
    "61-gltf-two-skins/m.gltf": (12, 8, (0.2, 0.6, 0.9), False, 0),
    "67-gltf-anim-one-key/m.gltf": (24, 12, (0.8, 0.3, 0.1), False, 0),
    "75-gltf-mirror/m.gltf": (24, 12, (0.8, 0.3, 0.1), False, 0),
    "77-glb-black-colors/m.glb": (4, 2, (1, 1, 1), True, 0),
    "80-glb-image-1bit/m.glb": (4, 2, (1, 1, 1), True, 0),
    "81-glb-image-16bit/m.glb": (4, 2, (1, 1, 1), True, 0),
    "82-glb-jpeg-exif/m.glb": (4, 2, (1, 1, 1), True, 0),
    "90-3mf-no-default-pid/m.3mf": (16, 12, (255, 255, 255), False, None),
    "92-3mf-vertex-colors/m.3mf": (15, 12, (255, 255, 255), False, None),
    "95-3mf-dangling-pid/m.3mf": (8, 12, (1, 1, 1), False, 1),
    "97-3mf-bom-utf16/m.3mf": (8, 12, (1, 1, 1), False, 0),
    "98-3mf-no-rels-other-name/m.3mf": (8, 12, (1, 1, 1), False, 0),
    "99-3mf-support-hidden/m.3mf": (16, 24, (1, 1, 1), False, None),
}
#: Files that hold nothing to show.
REFUSED = {
    "08-stl-80-bytes/m.stl": "no triangles",
    "09-stl-empty-text/m.stl": "no triangles",
    "11-stl-count-zero/m.stl": "no triangles",
    "71-glb-empty-bin/m.glb": "no vertices",
}


@pytest.mark.parametrize("name", LOADED)
def test_what_loads(name):
    vertices, faces, color, textured, told = LOADED[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mesh = load_mesh(REPORTS / name)
    material = mesh.materials[0]
    assert (len(mesh.positions), len(mesh.faces)) == (vertices, faces)
    assert tuple(material.rgb) == color and (material.texture is not None) == textured
    assert told is None or len(mesh.warnings) == told, mesh.warnings


@pytest.mark.parametrize("name", REFUSED)
def test_what_holds_nothing(name):
    with pytest.raises(FileFormatError, match=REFUSED[name]):
        load_mesh(REPORTS / name)


def test_a_root_above_the_model():
    folder = REPORTS / "31-obj-parent-images"
    mesh = load_mesh(folder / "models" / "model_normalized.obj", root=folder)
    assert mesh.materials[0].texture is not None and not mesh.warnings


def test_splats_have_their_colours():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mesh = load_mesh(REPORTS / "22-ply-splats" / "m.ply")
    assert len(set(map(tuple, mesh.colors[:, :3].tolist()))) > 1
