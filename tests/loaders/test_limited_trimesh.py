"""What trimesh reads has a process of its own, with so much memory and time and no more."""

import json
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.errors import Engine3DWarning, FileAccessError
from engine3d.io.loaders import load_document, load_mesh
from engine3d.io.reading.linked_files import found_files

pytest.importorskip("trimesh")

MEGABYTE = 1 << 20
CIRCLE = (
    "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n0\n20\n0\n30\n0\n40\n{}\n0\nENDSEC\n0\nEOF\n"
)
MEASURE = """
import json, resource, sys, warnings
import engine3d as e3d
warnings.simplefilter("ignore")
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    told = str(len(e3d.load_mesh(sys.argv[1]).positions))
except e3d.Engine3DError as error:
    told = str(error)
own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
print(json.dumps([told, own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss]))
"""


def measured(path):
    """What loading gives, and the peaks of memory of the process and of its children, in bytes."""
    command = [sys.executable, "-c", MEASURE, str(path)]
    found = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120)
    told, own, child = json.loads(found.stdout)
    return told, own * 1024, child * 1024


def archive(path, files):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in files.items():
            file.writestr(name, text)
    return path


@pytest.mark.parametrize("radius", [1, 1e9])
def test_a_circle_has_as_many_points_at_any_size(write, radius):
    told, own, child = measured(write("a.dxf", CIRCLE.format(radius)))
    assert 10 < int(told) < 1000
    assert own < 64 * MEGABYTE and child < 400 * MEGABYTE


def test_a_small_archive_that_unpacks_to_much(tmp_path):
    path = archive(tmp_path / "a.3mf", {"3D/3dmodel.model": b"<a/>" * (8 * MEGABYTE)})
    assert path.stat().st_size < MEGABYTE // 4
    told, own, _ = measured(path)
    assert "a.3mf: unpacks to more than" in told
    assert own < 64 * MEGABYTE


def test_nothing_of_the_current_folder_is_imported(write, tmp_path, monkeypatch):
    path = write("a.xyz", "0 0 0\n1 1 1\n")
    for name in ("pickle", "trimesh", "engine3d"):
        write(f"{name}.py", "raise SystemExit(9)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [entry for entry in sys.path if entry])
    assert len(load_mesh(path).points) == 2


def test_the_document_is_what_it_would_be_here(write):
    document = load_document(write("a.xyz", "0 0 0\n1 2 3\n"))
    (entry,) = document.objects
    assert document.format == "xyz"
    assert entry.mesh.points.tolist() == [0, 1]
    assert np.array_equal(entry.pose, np.eye(4))
    entry.mesh.positions = entry.mesh.positions * 2  # still a mesh in every way
    assert entry.mesh.bounds[1].tolist() == [2, 4, 6]
    scene = e3d.Scene()
    scene.add(entry.mesh)
    assert scene.bounds[1].tolist() == [2, 4, 6]


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>
<created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified></asset>
<library_images><image id="i"><init_from>{image}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="u"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>u</source></sampler2D></newparam>
<technique sid="c"><lambert><diffuse><texture texture="s" texcoord="UV"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="t"><float_array id="ta" count="6">0 0 1 0 0 1</float_array><technique_common>
<accessor source="#ta" count="3" stride="2"><param name="S" type="float"/>
<param name="T" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="k" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#t" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="x"><node id="n"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="k" target="#m"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#x"/></scene></COLLADA>"""


def test_images_of_collada(write):
    Image.fromarray(np.full((2, 2, 3), 77, np.uint8)).save(write("a.tga", b""))
    found = []
    with found_files(found.append):
        mesh = load_mesh(write("a.dae", DAE.format(image="a.tga")))
    assert mesh.materials[0].texture.pixels[0, 0].tolist() == [77, 77, 77, 255]
    assert [path.rpartition("/")[2] for path in found] == ["a.tga"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\n", "unknown image"),
        (b"\x89PNG\r\n\x1a\n", "not an image of a known format"),
        (None, "not found"),
    ],
)
def test_unreadable_images_of_collada(write, content, message):
    if content is not None:
        write("b.eps", content)
    with pytest.warns(Engine3DWarning, match=rf"a\.dae:\d+: 'b\.eps': .*{message}"):
        mesh = load_mesh(write("a.dae", DAE.format(image="b.eps")))
    assert mesh.materials[0].texture is None


BOX = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="x"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#x"/></scene></COLLADA>"""


@pytest.mark.parametrize("angle", [0.0, 0.25])
def test_the_crease_angle_is_that_of_the_caller(tmp_path, angle):
    pytest.importorskip("collada")
    path = archive(tmp_path / "a.zae", {"a.dae": BOX})
    assert load_mesh(path, crease_angle=angle).crease_angle == angle
    (entry,) = load_document(path, crease_angle=angle).objects
    assert entry.mesh.crease_angle == angle


def test_a_missing_file_stays_an_error_of_access(tmp_path):
    with pytest.raises(FileAccessError):
        load_mesh(tmp_path / "none.xyz")
