"""Reads STEP, IGES and BREP files with cadquery-ocp.

In: the bytes of a file. Out: its shapes as meshes with names, colours and poses. Assemblies are
followed to their parts; a part that occurs several times is one mesh. Colours of occurrences come
before those of parts, and those of faces before both.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.files.temporary_copy import temporary_copy
from ...base.system import opening_no_files
from ...errors import FileFormatError
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ..reading.posed_parts import PosedPart
from ..reading.sources import Source
from .colors_of_shapes import Components, color_material, components_of
from .shape_meshes import pose_matrix, shape_mesh

#: Assemblies within assemblies: deeper ones only occur in damaged files.
_DEEPEST = 64


def read_parts(source: Source, split: bool, kind: str) -> list[PosedPart]:
    """Return the parts of a file of a kind: ``"step"``, ``"iges"`` or ``"brep"``.

    Raises
    ------
    FileFormatError
    """
    with temporary_copy(source.data, f"model.{kind}") as path:
        parts = _brep_parts(path) if kind == "brep" else _document_parts(path, kind)
    if not parts:
        raise FileFormatError(f"damaged, or no {kind} file: it holds no shape", source.path)
    return parts


def _brep_parts(path: str) -> list[PosedPart]:
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopoDS import TopoDS_Shape

    shape = TopoDS_Shape()
    if not BRepTools.Read_s(shape, path, BRep_Builder()) or shape.IsNull():
        return []
    return [PosedPart("shape", shape_mesh(shape, "shape"), np.eye(4))]


def _document_parts(path: str, kind: str) -> list[PosedPart]:
    """Return the parts of a file through a document of XCAF, which holds names and colours."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document

    if kind == "step":
        from OCP.STEPCAFControl import STEPCAFControl_Reader as Reader
    else:
        from OCP.IGESCAFControl import IGESCAFControl_Reader as Reader
    reader = Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    if reader.ReadFile(path) != IFSelect_RetDone:
        return []
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    with opening_no_files():  # Open CASCADE would read parts from any file that this one names
        is_whole = reader.Transfer(document)
    if not is_whole:
        return []
    return list(_Assembly(document).parts())


class _Assembly:
    """The tree of a document of XCAF."""

    def __init__(self, document: Any) -> None:
        from OCP.XCAFDoc import XCAFDoc_DocumentTool

        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
        self._colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
        self._meshes: dict[Any, Mesh] = {}

    def parts(self) -> Iterator[PosedPart]:
        """Yield all occurrences of parts."""
        for label in self._labels():
            yield from self._below(label, np.eye(4), None, 0)

    def _labels(self, of: Any = None) -> list[Any]:
        """Return the labels of an assembly's components, or those at the top."""
        try:
            from OCP.TDF import TDF_LabelSequence as Labels
        except ImportError:  # its name has depended on the version of the package
            from OCP.collections import Sequence_TDF_Label as Labels

        found = Labels()
        if of is None:
            self._shapes.GetFreeShapes(found)
        else:
            self._shapes.GetComponents_s(of, found)
        return [found.Value(n) for n in range(1, found.Length() + 1)]

    def _below(
        self, label: Any, pose: NDArray[np.float64], color: Components | None, depth: int
    ) -> Iterator[PosedPart]:
        from OCP.TDF import TDF_Label

        place = self._shapes.GetLocation_s(label).Transformation()
        pose = linalg.multiply(pose, pose_matrix(place))
        part = TDF_Label()
        if not self._shapes.IsReference_s(label):
            part = label
        else:
            self._shapes.GetReferredShape_s(label, part)
        color = color or self._color_of(label)
        if self._shapes.IsAssembly_s(part):
            if depth < _DEEPEST:
                for component in self._labels(part):
                    yield from self._below(component, pose, color, depth + 1)
            return
        name = _name_of(part) or _name_of(label) or "part"
        mesh = self._mesh(part, name, color or self._color_of(part))
        if len(mesh.positions):
            yield PosedPart(name, mesh, pose)

    def _mesh(self, part: Any, name: str, color: Components | None) -> Mesh:
        from OCP.TopLoc import TopLoc_Location

        shape = self._shapes.GetShape_s(part).Located(TopLoc_Location())
        key = shape.TShape(), color
        if key not in self._meshes:
            paints: dict[Components | None, Material] = {}

            def material_of(face: Any) -> Material:
                own = self._color_of(face) or color
                return paints.setdefault(own, color_material(own))

            self._meshes[key] = shape_mesh(shape, name, material_of)
        return self._meshes[key]

    def _color_of(self, thing: Any) -> Components | None:
        """Return the colour of a label, or of a face that has one of its own."""
        from OCP.Quantity import Quantity_ColorRGBA
        from OCP.TDF import TDF_Label
        from OCP.XCAFDoc import XCAFDoc_ColorGen, XCAFDoc_ColorSurf, XCAFDoc_ColorTool

        found = Quantity_ColorRGBA()
        is_label = isinstance(thing, TDF_Label)
        get = XCAFDoc_ColorTool.GetColor_s if is_label else self._colors.GetColor
        for kind in (XCAFDoc_ColorSurf, XCAFDoc_ColorGen):
            if get(thing, kind, found):
                return components_of(found)
        return None


def _name_of(label: Any) -> str:
    from OCP.TCollection import TCollection_AsciiString
    from OCP.TDataStd import TDataStd_Name

    name = TDataStd_Name()
    if not label.FindAttribute(TDataStd_Name.GetID_s(), name):
        return ""
    text = str(TCollection_AsciiString(name.Get()).ToCString())
    return "" if text.startswith("=>") else text
