"""Clear surfaces, mixed as VTK mixes them: without an order, weighted by nearness.

In: the parts, and those that hide them. Out: colours and alphas. VTK adds up each pixel's clear
colours, times alpha and a weight that falls with depth (vtkOrderIndependentTranslucentPass.cxx).
The core blends in order; with alphas close to 0 the order does not matter, and blending is adding.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...model.materials.linear_colors import linear
from ...model.materials.textures import Texture
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...rendering.renderer import Renderer
from ._edges import polygon_edges
from ._lights import Lamp, add_lights
from ._parts import Paint, Part
from ._strokes import strokes
from ._view import View

_FAINT = 2.0**-10
_BLINN = 4.0  # times the power of Phong: highlights about as wide

def mixture(
    solid: list[Part],
    clear: list[Part],
    lamps: list[Lamp],
    view: View,
    peels: bool,
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return what clear parts show before solid ones.

    Returns
    -------
    color : (H, W, 3) float32
        0 to 1, times the alpha.
    cover : (H, W, 1) float32
        Alpha.
    """
    clear = [each for part in clear for each in _with_edges(part, view)]
    draw = _Passes(solid, clear, lamps, view)
    cover = draw.radiance(is_white=True)[..., :1]
    if peels:
        return np.minimum(draw.radiance(), cover), cover
    weight = draw.radiance(is_white=True, is_weighted=True)[..., :1]
    color = draw.radiance(is_weighted=True) / np.maximum(weight, np.float32(1e-30))
    return np.clip(color, 0.0, 1.0) * cover, cover


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
    """Draws clear parts behind black ones, in several ways."""

    def __init__(
        self,
        solid: list[Part],
        clear: list[Part],
        lamps: list[Lamp],
        view: View,
    ) -> None:
        self._solid, self._clear, self._lamps = solid, clear, lamps
        self._renderer = Renderer((view.width, view.height), color_space="linear")
        self._camera = Camera(view.projection), np.eye(4)
        self._weights = [_weights(part, view) for part in clear]
        self._most = max((float(one.max()) for one in self._weights if len(one)), default=1.0)

    def radiance(self, is_white: bool = False, is_weighted: bool = False) -> NDArray[np.float32]:
        """Return the sum of the clear parts' colours.

        Parameters
        ----------
        is_white : bool
            Draw them white instead.
        is_weighted : bool
            With faint alphas, times their weights; the sum is divided by nothing.
        """
        scene = Scene(background=(0, 0, 0), ambient=(0, 0, 0))
        add_lights(scene, self._lamps)
        for part in self._solid:
            black = replace(part, paint=Paint(), spot_colors=None)
            material = black.material(0.0)
            material.unlit = True
            black.added(scene, material)
        for part, weights in zip(self._clear, self._weights, strict=True):
            self._add(scene, part, weights, is_white, is_weighted)
        frame = self._renderer.render(scene, self._camera, outputs=("radiance",), cull="none")
        return frame.radiance

    def _add(
        self,
        scene: Scene,
        part: Part,
        weights: NDArray[np.float64],
        is_white: bool,
        is_weighted: bool,
    ) -> None:
        look = part.look
        factor = look.ambient + look.diffuse if look.is_unlit else look.diffuse
        opacity = look.opacity * (_FAINT if is_weighted else 1.0)
        material = part.material(1.0 if is_white else factor, opacity)
        if is_white:
            material.unlit = True
            material.color = linear([1.0, 1.0, 1.0, opacity])
            part = replace(part, paint=_white(part.paint), spot_colors=None)
            material.texture = part.paint.image
        elif look.specular and not look.is_unlit:
            material.specular = linear(look.specular_color * look.specular)
            material.shininess = _BLINN * look.power
        if not is_white and look.ambient and not look.is_unlit:
            material.emissive = linear(np.clip(look.ambient * look.ambient_color, 0.0, 1.0))
        if is_weighted and part.spots is None:
            part = replace(part, paint=_weighted(part.paint, weights / self._most))
        part.added(scene, material)


def _weights(part: Part, view: View) -> NDArray[np.float64]:
    """Return the weights of a part's vertices by their depth."""
    places = part.places if part.spots is None else part.spots[:, :3]
    z = places[:, 2]
    m = view.projection
    w = m[3, 2] * z + m[3, 3]
    depth = 0.5 + 0.5 * (m[2, 2] * z + m[2, 3]) / np.where(np.abs(w) < 1e-30, 1e-30, w)
    near = np.maximum(1.1 - np.clip(depth, 0.0, 1.0), 0.0)
    return near * near


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


def _weighted(paint: Paint, weights: NDArray[np.float64]) -> Paint:
    """Return colours whose alphas are multiplied; floats, which the mesh keeps."""
    rgba = np.ones((len(weights), 4)) if paint.rgba is None else paint.rgba / 255.0
    rgba[:, 3] *= weights
    return replace(paint, rgba=linear(rgba))
