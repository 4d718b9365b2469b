"""STEP files, where cascadio is installed, and what is said where it is not."""

import importlib.util
import subprocess
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import FileFormatError
from engine3d.io.reading.loading import whole_mesh
from engine3d.io.reading.reader_registry import find_reader
from engine3d.io.reading.sources import Source
from engine3d.loaders import load_document

HAS_CASCADIO = importlib.util.find_spec("cascadio") is not None
needs_cascadio = pytest.mark.skipif(not HAS_CASCADIO, reason="needs the package cascadio")
# The context, millimetres and the product that a shape belongs to.
FRAME = """#1=APPLICATION_CONTEXT('core');
#2=PRODUCT_CONTEXT('',#1,'mechanical');
#3=PRODUCT('box','box','',(#2));
#4=PRODUCT_DEFINITION_FORMATION('','',#3);
#5=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');
#6=PRODUCT_DEFINITION('design','',#4,#5);
#7=PRODUCT_DEFINITION_SHAPE('','',#6);
#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);
#9=FACETED_BREP_SHAPE_REPRESENTATION('',(#20),#10);
#10=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#14))
GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13))REPRESENTATION_CONTEXT('',''));
#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#12=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#14=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#11,'','');
#20=FACETED_BREP('',#21);
"""


def faceted(points, faces) -> bytes:
    """A STEP file of plane faces, whose corners are millimetres."""
    lines, shell = [FRAME], []
    for number, point in enumerate(points):
        lines.append(f"#{100 + number}=CARTESIAN_POINT('',{tuple(map(float, point))});")
    for number, face in enumerate(faces):
        first = 1000 + 10 * number
        corners = np.array([points[corner] for corner in face], float)
        along = corners[1] - corners[0]
        normal = np.cross(along, corners[2] - corners[0])
        loop = ",".join(f"#{100 + corner}" for corner in face)
        lines += [
            f"#{first}=POLY_LOOP('',({loop}));",
            f"#{first + 1}=FACE_OUTER_BOUND('',#{first},.T.);",
            f"#{first + 2}=DIRECTION('',{tuple(normal.tolist())});",
            f"#{first + 3}=DIRECTION('',{tuple(along.tolist())});",
            f"#{first + 4}=AXIS2_PLACEMENT_3D('',#{100 + face[0]},#{first + 2},#{first + 3});",
            f"#{first + 5}=PLANE('',#{first + 4});",
            f"#{first + 6}=FACE_SURFACE('',(#{first + 1}),#{first + 5},.T.);",
        ]
        shell.append(f"#{first + 6}")
    lines.append(f"#21=CLOSED_SHELL('',({','.join(shell)}));")
    head = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
    head += "FILE_NAME('','',(''),(''),'','','');\n"
    head += "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n"
    return (head + "\n".join(lines) + "\nENDSEC;\nEND-ISO-10303-21;\n").encode()


@needs_cascadio
def test_a_tetrahedron(tmp_path):
    path = tmp_path / "solid.stp"
    points = [(0, 0, 0), (30, 0, 0), (0, 20, 0), (0, 0, 10)]
    path.write_bytes(faceted(points, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]))
    document = load_document(path)
    assert (document.format, document.unit) == ("step", "mm")
    assert not any(material.is_physical for material in document.tree.materials)
    mesh = whole_mesh(document, Source(str(path), b""), None)
    assert len(mesh.faces) == 4 and mesh.warnings == []
    assert np.allclose(mesh.bounds, [(0, 0, 0), (30, 20, 10)])
    by_content = Source("a.bin", path.read_bytes())
    assert find_reader(by_content, "mesh").name == "step"


@needs_cascadio
def test_what_is_damaged(tmp_path):
    for name, content, message in [
        ("a.step", b"ISO-10303-21;\nHEADER", "damaged, or no step file"),
        ("b.stp", b"solid", "not a step file"),
    ]:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(FileFormatError, match=message):
            e3d.load_mesh(tmp_path / name)


def test_without_cascadio(tmp_path):
    path = tmp_path / "a.step"
    path.write_bytes(b"ISO-10303-21;\n")
    program = (
        "import importlib.util, sys\n"
        "importlib.util.find_spec = lambda name: None\n"
        "import engine3d.io.formats.step as step, engine3d.io.reading.sources as sources\n"
        "try:\n"
        "    step.read_step(sources.read_source(sys.argv[1]))\n"
        "except Exception as error:\n"
        "    print(error)\n"
    )
    run = subprocess.run([sys.executable, "-c", program, str(path)], capture_output=True, text=True)
    assert run.stdout == (
        f"{path}: step files need the package cascadio: pip install 'engine3d[step]'\n"
    )
