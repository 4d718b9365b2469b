"""Clear surfaces, mixed as VTK mixes them: without an order.

In: the parts, and those that hide them. Out: colours and alphas. VTK shows the mean of each
pixel's clear colours, weighted by alpha (vtkOrderIndependentTranslucentPass.cxx). The core blends
in order; with alphas close to 0 the order does not matter, and blending is adding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import warn
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.renderer import Renderer
from ._clear_layers import Fragments, add_fragments, blended, fragments_of
from ._edges import polygon_edges
from ._lights import Lamp, add_lights
from ._line_marks import strokes
from ._parts import Paint, Part
from ._renderer_view import View

_FAINT = 2.0**-10
_BLINN = 4.0  # times the power of Phong: highlights about as wide


def mixture(
    solid: list[Part],
    clear: list[Part],
    lamps: list[Lamp],
    view: View,
    peels: bool,
    shaded: Callable[[Part], Frame],
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return what clear parts show before solid ones.

    Parameters
    ----------
    shaded : callable
        Draws a part alone, as a solid one, among the shadows of the others.

    Returns
    -------
    color : (H, W, 3) float32
        0 to 1, times the alpha.
    cover : (H, W, 1) float32
        Alpha.
    """
    clear = [each for part in clear for each in _with_edges(part, view)]
    is_plain = all(lamp.is_plain for lamp in lamps)
    unknown = [part for part in clear if not _is_known(part, is_plain)]
    draw = _Passes(solid, clear, lamps, view)
    cover = draw.radiance(is_white=True)[..., :1]
    if peels and not unknown:
        return np.minimum(draw.radiance(), cover), cover
    if peels:  # all of them have a place in the order
        found = _fragments(solid, clear, lamps, view, shaded)
        return np.minimum(blended(found, cover.shape[:2]), cover), cover
    faces = [part for part in unknown if part.is_face]
    if len(faces) < len(unknown):  # lines cross too often for sheets
        warn("clear lines and points are drawn as matt, in light without cones and attenuation")
    if faces:
        rest = [part for part in clear if not part.is_face or _is_known(part, is_plain)]
        draw = _Passes(solid, rest, lamps, view)
    weight = draw.radiance(is_white=True, is_faint=True)[..., :1]
    color = draw.radiance(is_faint=True)
    if faces:
        color, weight = color.copy(), weight.copy()
        add_fragments(_fragments(solid, faces, lamps, view, shaded), color, weight, _FAINT)
    color /= np.maximum(weight, np.float32(1e-30))
    return np.clip(color, 0.0, 1.0) * cover, cover


def _is_known(part: Part, is_plain: bool) -> bool:
    """Return whether the core knows the light of a part, of lamps that are all plain or not."""
    return part.look.is_unlit or (is_plain and not part.look.is_physical)


def _fragments(
    solid: list[Part],
    clear: list[Part],
    lamps: list[Lamp],
    view: View,
    shaded: Callable[[Part], Frame],
) -> Fragments:
    """Return what clear parts show before solid ones, layer by layer, as solid parts are lit."""

    def most_layers(part: Part) -> int:
        faint = _Passes(solid, [part.opaque()], lamps, view, blends=True)
        return round(float(faint.radiance(is_white=True, is_faint=True).max()) / _FAINT)

    def alphas(part: Part) -> NDArray[np.float32]:
        return _Passes(solid, [part], lamps, view).radiance(is_white=True)[..., 0]

    return fragments_of(clear, view.is_parallel, most_layers, alphas, shaded)


def _with_edges(part: Part, view: View) -> list[Part]:
    """Return a part, and its edges as lines."""
    look = part.look
    if not look.edge_width:
        return [part]
    ends = polygon_edges(part)
    lines = replace(
        look,
        color=look.edge_color,
        line_width=look.edge_width,
        opacity=look.opacity * look.edge_opacity,
        is_unlit=True,
        ambient=0.0,
        diffuse=1.0,
        edge_width=0.0,
        has_tubes=False,
    )
    return [part, strokes(view, part.places[ends], Paint(), lines, None)]


class _Passes:
    """Draws clear parts behind black ones, in several ways, as one scene whose colours change."""

    def __init__(
        self,
        solid: list[Part],
        clear: list[Part],
        lamps: list[Lamp],
        view: View,
        blends: bool = False,
    ) -> None:
        self._blends = blends
        self._renderer = Renderer((view.width, view.height), color_space="linear")
        self._camera = Camera(view.projection), np.eye(4)
        self._scene = Scene(background=(0, 0, 0), ambient=(0, 0, 0))
        add_lights(self._scene, lamps)
        for part in solid:
            black = replace(part, paint=Paint(), spot_colors=None)
            material = black.material(0.0)
            material.unlit = True
            black.added(self._scene, material)
        self._clear = [(part, part.added(self._scene, part.material())) for part in clear]
        for _, node in self._clear:
            node.cast_shadows = False

    def radiance(self, is_white: bool = False, is_faint: bool = False) -> NDArray[np.float32]:
        """Return the sum of the clear parts' colours.

        Parameters
        ----------
        is_white : bool
            Draw them white instead.
        is_faint : bool
            With alphas close to 0.
        """
        for part, node in self._clear:
            shown = part
            if is_white:
                shown = replace(part, paint=_white(part.paint), spot_colors=None)
            mesh: Any = node.object
            if isinstance(mesh, InstancedMesh):
                mesh.colors = shown.spot_colors
                mesh = mesh.mesh
            if part.paint.rgba is not None:
                mesh.colors = shown.paint.rgba
            material = _material(part, shown.paint, is_white, is_faint)
            if self._blends:
                material.alpha_mode = "blend"
            mesh.materials = [material]
        frame = self._renderer.render(self._scene, self._camera, outputs=("radiance",), cull="none")
        return frame.radiance


def _material(part: Part, paint: Paint, is_white: bool, is_faint: bool) -> Material:
    look = part.look
    factor = look.ambient + look.diffuse if look.is_unlit else look.diffuse
    opacity = look.opacity * (_FAINT if is_faint else 1.0)
    material = part.material(1.0 if is_white else factor, opacity)
    material.texture = paint.image
    if is_white:
        material.unlit = True
        material.color = linear([1.0, 1.0, 1.0, opacity])
        return material
    if look.specular and not look.is_unlit:
        material.specular = linear(look.specular_color * look.specular)
        material.shininess = _BLINN * look.power
    if look.ambient and not look.is_unlit:
        material.emissive = linear(np.clip(look.ambient * look.ambient_color, 0.0, 1.0))
    return material


def _white(paint: Paint) -> Paint:
    """Return white colours with the same alphas."""
    rgba, image = paint.rgba, paint.image
    if rgba is not None:
        rgba = rgba.copy()
        rgba[:, :3] = 255
    if image is not None:
        pixels = image.pixels.copy()
        pixels[..., :3] = 255
        image = Texture(pixels, color_space="linear", filter=image.filter, wrap=image.wrap)
    return replace(paint, rgba=rgba, image=image)
