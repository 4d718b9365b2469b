"""What a renderer of VTK holds, sorted by how it is drawn.

In: a ``vtkRenderer`` and its view. Out: a `Content`: parts that stand in space, and what lies on
the picture. What cannot be drawn is named.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from ._actors import parts_of
from ._images import image_parts
from ._parts import Part
from ._renderer_view import View, matrix_of
from .annotations.bars import draw_bar
from .annotations.bounds import bounds_parts, draw_bounds_texts
from .annotations.flat import draw_flat
from .annotations.labels import draw_billboard, draw_labels
from .annotations.legends import draw_legend
from .annotations.little_axes import arrows_of, draw_caption, draw_letters
from .annotations.overlay import Overlay
from .annotations.texts import draw_corners, draw_text

_Draw = Callable[[Overlay, Any], None]
_Parts = Callable[[Any, View], Iterator[Part]]


def _axes_parts(actor: Any, view: View) -> Iterator[Part]:
    for arrow in arrows_of(actor):
        if arrow.GetVisibility():
            yield from parts_of(arrow, view)


def _nested_parts(assembly: Any, view: View) -> Iterator[Part]:
    """Yield what the actors of an assembly show."""
    assembly.InitPathTraversal()
    while (path := assembly.GetNextPath()) is not None:
        node = path.GetLastNode()
        actor, matrix = node.GetViewProp(), node.GetMatrix()
        if actor.IsA("vtkActor") and actor.GetVisibility():
            yield from parts_of(actor, view, None if matrix is None else matrix_of(matrix))


#: What stands in space, by class; the first that fits counts.
_SOLID: dict[str, _Parts] = {
    "vtkCubeAxesActor": bounds_parts,
    "vtkAxesActor": _axes_parts,
    "vtkAssembly": _nested_parts,
    "vtkPropAssembly": _nested_parts,
    "vtkImageSlice": image_parts,
    "vtkActor": parts_of,
}
#: What lies on the picture.
_FLAT: dict[str, _Draw] = {
    "vtkCubeAxesActor": draw_bounds_texts,
    "vtkAxesActor": draw_letters,
    "vtkBillboardTextActor3D": draw_billboard,
    "vtkCaptionActor2D": draw_caption,
    "vtkCornerAnnotation": draw_corners,
    "vtkLegendBoxActor": draw_legend,
    "vtkScalarBarActor": draw_bar,
    "vtkTextActor": draw_text,
}
#: Mappers of `vtkActor2D`.
_FLAT_MAPPERS: dict[str, _Draw] = {"vtkPolyDataMapper2D": draw_flat}
_LABELS = "vtkLabelPlacementMapper"
#: Show nothing without a mapper, instead of something of their own.
_BARE = ("vtkActor2D", "vtkTexturedActor2D")
#: Antialiasing: four samples a pixel stand for all kinds.
_DRAWN_PASSES = ("vtkSSAAPass", "vtkOpenGLFXAAPass")
#: Effects that PyVista gives a renderer, by the classes of their passes.
_EFFECTS = {
    "vtkEDLShading": "eye-dome lighting",
    "vtkSSAOPass": "ambient occlusion",
    "vtkGaussianBlurPass": "blur",
    "vtkDepthOfFieldPass": "depth of field",
}
#: What VTK draws and engine3d does not, by class.
_UNDRAWN = {
    "vtkVolume": "volumes",
    "vtkContextActor": "charts",
    "vtkSkybox": "sky boxes",
    "vtkWidgetRepresentation": "widgets",
    "vtkTextActor3D": "texts that lie in space",
    "vtkAxisActor2D": "rulers",
    "vtkLegendScaleActor": "legend scales",
}


@dataclass
class Content:
    """What a renderer shows.

    Attributes
    ----------
    parts : list of Part
    flat : list of (function, prop)
        In VTK's order.
    labels : list of vtkActor2D
        Which something may hide.
    undrawn : list of str
        What is not drawn.
    """

    parts: list[Part] = field(default_factory=list)
    flat: list[tuple[_Draw, Any]] = field(default_factory=list)
    labels: list[Any] = field(default_factory=list)
    undrawn: list[str] = field(default_factory=list)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is drawn but bars of what may not be."""
        return not (self.parts or self.labels) and all(draw is draw_bar for draw, _ in self.flat)


def content_of(renderer: Any, view: View) -> Content:
    """Return what a renderer shows."""
    found = Content()
    for prop in _props(renderer):
        _sort_in(found, prop, view)
    found.undrawn += _effects(renderer)
    return found


def _props(renderer: Any) -> list[Any]:
    """Return the visible props of a renderer, in its order."""
    props = renderer.GetViewProps()
    props.InitTraversal()
    found = [props.GetNextProp() for _ in range(props.GetNumberOfItems())]
    return [prop for prop in found if prop.GetVisibility()]


def _sort_in(found: Content, prop: Any, view: View) -> None:
    for kind, what in _UNDRAWN.items():
        if prop.IsA(kind):
            found.undrawn.append(f"{what} ({prop.GetClassName()})")
            return
    solid = next((draw for kind, draw in _SOLID.items() if prop.IsA(kind)), None)
    flat = next((draw for kind, draw in _FLAT.items() if prop.IsA(kind)), None)
    if solid is not None:
        found.parts += solid(prop, view)
    if flat is None and solid is None and hasattr(prop, "GetMapper"):
        mapper = prop.GetMapper()
        if mapper is None:
            if prop.GetClassName() not in _BARE:
                found.undrawn.append(prop.GetClassName())
            return
        if mapper.IsA(_LABELS):
            found.labels.append(prop)
            return
        flat = next((draw for kind, draw in _FLAT_MAPPERS.items() if mapper.IsA(kind)), None)
    if flat is not None:
        found.flat.append((flat, prop))
    elif solid is None:
        found.undrawn.append(prop.GetClassName())


def passes_of(renderer: Any) -> list[str]:
    """Return the classes of the render passes that PyVista gave a renderer."""
    return list(getattr(getattr(renderer, "_render_passes", None), "_passes", {}))


def _effects(renderer: Any) -> list[str]:
    """Return the effects of a renderer that are not drawn."""
    passes = [name for name in passes_of(renderer) if name not in _DRAWN_PASSES]
    names = [f"{_EFFECTS.get(name, 'the effect')} ({name})" for name in passes]
    if renderer.GetUseHiddenLineRemoval():
        names.append("the removal of hidden lines")
    if renderer.GetUseShadows():
        names.append("shadows")
    window = renderer.GetRenderWindow()
    if window is not None and window.GetStereoRender():
        names.append("stereo")
    return names


def draw_content(overlay: Overlay, content: Content, hidden: Any) -> None:
    """Draw what lies on the picture; ``hidden`` is that of `draw_labels`."""
    for draw, prop in content.flat:
        draw(overlay, prop)
    for prop in content.labels:
        draw_labels(overlay, prop, hidden)
