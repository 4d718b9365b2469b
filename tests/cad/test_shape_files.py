"""STEP, IGES and BREP files read by cadquery-ocp, against the shapes that were written."""

import importlib.util
import os
import subprocess
import sys

import numpy as np
import pytest
from cad.test_build123d import assembly, plate

import engine3d as e3d
from engine3d.base import system
from engine3d.io.cad.shape_files import read_parts
from engine3d.io.formats import step
from engine3d.io.reading import limited_process
from engine3d.io.reading.sources import Source
from engine3d.measuring import measure

b = pytest.importorskip("build123d", exc_type=ImportError)


@pytest.fixture
def alone(monkeypatch):
    """Takes cascadio away from the readers."""
    found = importlib.util.find_spec
    without = lambda name, *rest: None if name == "cascadio" else found(name, *rest)  # noqa: E731
    monkeypatch.setattr(step.importlib.util, "find_spec", without)


def test_brep_files_are_read(tmp_path):
    path, body = tmp_path / "plate.brep", plate()
    b.export_brep(body, str(path))
    document = e3d.loaders.load_document(path)
    assert (document.format, document.unit, document.up) == ("brep", "mm", "+Z")
    assert measure(e3d.load_mesh(path)).volume == pytest.approx(body.volume, rel=0.01)
    assert e3d.render(path, size=(64, 48)).color.std() > 5


def test_step_files_keep_names_colours_and_places(tmp_path, alone):
    path, made = tmp_path / "assembly.step", assembly().moved(b.Location((100, 0, 0), (0, 0, 30)))
    b.export_step(made, str(path))
    scene = e3d.load_scene(path)
    assert [node.name for node in scene.nodes] == ["plate", "pin", "ball"]
    found, expected = measure(scene).bounds, made.bounding_box()
    np.testing.assert_allclose(found[0], tuple(expected.min), atol=0.5)
    np.testing.assert_allclose(found[1], tuple(expected.max), atol=0.5)
    colors = [node.object.materials[0].color for node in scene.nodes]
    assert colors[0][:3] == pytest.approx((1, 0.376, 0), abs=0.01)
    assert colors[1][2] > colors[1][0]


def test_faces_keep_colours_of_their_own(tmp_path):
    from OCP.Quantity import Quantity_Color, Quantity_TOC_RGB
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_ColorSurf, XCAFDoc_DocumentTool

    body = b.Box(2, 2, 2)
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    label = shapes.AddShape(body.wrapped, False)
    red, green = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    colors.SetColor(label, Quantity_Color(*red, Quantity_TOC_RGB), XCAFDoc_ColorSurf)
    top = shapes.AddSubShape(label, body.faces().sort_by(b.Axis.Z)[-1].wrapped)
    colors.SetColor(top, Quantity_Color(*green, Quantity_TOC_RGB), XCAFDoc_ColorSurf)
    writer, path = STEPCAFControl_Writer(), tmp_path / "box.step"
    writer.SetColorMode(True)
    writer.Transfer(document)
    writer.Write(str(path))
    (part,) = read_parts(Source(str(path), path.read_bytes()), True, "step")
    mesh = part.mesh
    by_face = np.array([m.color[:3] for m in mesh.materials])[mesh.material_ids]
    at_top = (mesh.positions[mesh.faces][..., 2] == 1).all(axis=1)
    np.testing.assert_allclose(by_face[at_top], [green] * 2)
    np.testing.assert_allclose(by_face[~at_top], [red] * 10)


def test_iges_files_are_read(tmp_path, alone):
    from OCP.IGESControl import IGESControl_Writer

    path, writer = tmp_path / "plate.igs", IGESControl_Writer()
    writer.AddShape(plate().wrapped)
    writer.ComputeModel()
    writer.Write(str(path))
    found = e3d.load_mesh(path).bounds
    np.testing.assert_allclose(found[1] - found[0], (40, 60, 20), rtol=0.01)


@pytest.mark.parametrize("name", ["bad.brep", "bad.step", "bad.igs"])
def test_damaged_files_are_errors(tmp_path, alone, name):
    whole = {"bad.brep": b"DBRep_DrawableShape\n\nCASCADE Topology V1", "bad.igs": b"S      1\n"}
    (tmp_path / name).write_bytes(whole.get(name, b"ISO-10303-21;\nHEADER;\n") + b"\0\xff junk")
    with pytest.raises(e3d.FileFormatError, match=name):
        e3d.load_mesh(tmp_path / name)


def test_a_missing_package_is_named(tmp_path):
    (tmp_path / "a.brep").write_bytes(b"DBRep_DrawableShape\n")
    code = (
        "import sys; sys.modules['OCP'] = None\n"
        "import importlib.util as u; f = u.find_spec\n"
        "u.find_spec = lambda n, *a: None if n == 'OCP' else f(n, *a)\n"
        "import engine3d as e3d\n"
        f"try: e3d.load_mesh({str(tmp_path / 'a.brep')!r})\n"
        "except e3d.FileFormatError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pip install 'engine3d[cad]'" in done.stdout


@pytest.fixture
def in_many_files(tmp_path):
    """Write an assembly of two boxes, each in a file outside of the model's folder."""
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_AsIs
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    outside, folder = tmp_path / "outside", tmp_path / "models"
    outside.mkdir()
    folder.mkdir()
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    both = b.Compound([b.Box(1, 2, 3), b.Box(3, 2, 1).moved(b.Location((9, 0, 0)))])
    XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).AddShape(both.wrapped, True)
    writer = STEPCAFControl_Writer()
    writer.Transfer(document, STEPControl_AsIs, "part")
    writer.Write(str(outside / "whole.step"))
    text = (outside / "whole.step").read_text()
    assert "'partSOLID.stp'" in text and (outside / "partSOLID.stp").exists()
    path = folder / "whole.step"
    path.write_text(text.replace("'partSOLID", f"'{outside}/partSOLID"))
    return path


def test_no_other_files_are_read(in_many_files, alone):
    said = "holds no shape; it names other files, which are not read: '"
    with pytest.raises(e3d.FileFormatError, match=said):
        e3d.load_mesh(in_many_files)


@pytest.mark.parametrize("word", ["DOCUMENT_FILE", "DOCUMENT_FILE/* */", "DOCUMENT_FILE\n"])
@pytest.mark.parametrize("package", ["cascadio", "OCP"])
def test_no_other_file_is_opened(in_many_files, monkeypatch, request, package, word):
    """Each is a pipe that nobody writes to: whoever opened it would wait until the time is over."""
    if package == "OCP":
        request.getfixturevalue("alone")
        monkeypatch.setattr(system, "can_forbid_files", lambda: False)
    elif importlib.util.find_spec("cascadio") is None:
        pytest.skip("needs cascadio")
    monkeypatch.setattr(limited_process, "MAX_SECONDS_BASE", 10)
    monkeypatch.setattr(limited_process, "MAX_SECONDS_PER_MEGABYTE", 0)
    text = in_many_files.read_text()
    assert "DOCUMENT_FILE(" in text
    in_many_files.write_text(text.replace("DOCUMENT_FILE", word))
    for part in (in_many_files.parents[1] / "outside").glob("part*"):
        part.unlink()
        os.mkfifo(part)
    with pytest.raises(e3d.FileFormatError) as told:
        e3d.load_mesh(in_many_files)
    assert "takes longer" not in str(told.value)


def test_other_files_of_a_whole_model_are_named(tmp_path):
    path = tmp_path / "plate.step"
    b.export_step(plate(), str(path))
    text = path.read_text()
    end = text.rindex("ENDSEC;")
    path.write_text(f"{text[:end]}#99999 = DOCUMENT_FILE('manual.pdf','',$,$,'',$);\n{text[end:]}")
    with pytest.warns(e3d.Engine3DWarning, match="plate.step: names other files.*'manual.pdf'$"):
        assert len(e3d.load_mesh(path).faces)
