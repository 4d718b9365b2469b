"""How an actor of VTK looks, apart from its colours: what its ``vtkProperty`` says.

In: a ``vtkProperty``, and what a block of a composite changes of it. Out: a `Property`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkProperty

_PHYSICAL = 3  # VTK_PBR
_FLAT = 0  # VTK_FLAT


@dataclass(frozen=True)
class Coat:
    """A clear coat over a physical material.

    Attributes
    ----------
    strength, roughness, reflectance : float
        0 to 1; the reflectance is that of light across the surface.
    color : (3,) float64
    """

    strength: float
    roughness: float
    reflectance: float
    color: NDArray[np.float64]


@dataclass(frozen=True)
class Property:
    """A ``vtkProperty``; colours are those that the screen shows, 0 to 1.

    Attributes
    ----------
    color, ambient_color, specular_color, edge_color : (3,) float64
    opacity, ambient, diffuse, specular, power : float
    is_unlit, is_physical, is_flat : bool
    metallic, roughness, base_reflectance, occlusion : float
        Of a physical material; ``occlusion`` is how much of its map counts.
    edge_tint, emissive : (3,) float64
        The reflectance of metal along the surface; what multiplies the map of its own light.
    coat : Coat or None
    edge_width : float
        Pixels; 0 for faces without edges.
    edge_opacity : float
    line_width, point_size : float
        Pixels.
    has_tubes, has_balls : bool
        Whether lines look like tubes, points like balls.
    round_points : bool
    style : int
        0 points, 1 wires, 2 faces.
    hides_back, hides_front : bool
    """

    color: NDArray[np.float64]
    ambient_color: NDArray[np.float64]
    specular_color: NDArray[np.float64]
    edge_color: NDArray[np.float64]
    opacity: float
    ambient: float
    diffuse: float
    specular: float
    power: float
    is_unlit: bool
    is_physical: bool
    is_flat: bool
    metallic: float
    roughness: float
    base_reflectance: float
    occlusion: float
    edge_tint: NDArray[np.float64]
    emissive: NDArray[np.float64]
    coat: Coat | None
    edge_width: float
    edge_opacity: float
    line_width: float
    point_size: float
    has_tubes: bool
    has_balls: bool
    round_points: bool
    style: int
    hides_back: bool
    hides_front: bool

    @property
    def is_matt(self) -> bool:
        """Whether the core's light of matt surfaces is all there is."""
        return self.is_unlit or not (self.ambient or self.specular or self.is_physical)


def property_of(given: Any, is_unlit: bool = False) -> Property:
    """Return what a ``vtkProperty`` says."""
    has_edges = bool(given.GetEdgeVisibility())
    width = given.GetLineWidth()
    if has_edges and not given.GetUseLineWidthForEdgeThickness():
        width = given.GetEdgeWidth()
    is_round = given.GetPoint2DShape() == 0 if hasattr(given, "GetPoint2DShape") else False
    return Property(
        color=np.array(given.GetDiffuseColor()),
        ambient_color=np.array(given.GetAmbientColor()),
        specular_color=np.array(given.GetSpecularColor()),
        edge_color=np.array(given.GetEdgeColor()),
        opacity=given.GetOpacity(),
        ambient=given.GetAmbient(),
        diffuse=given.GetDiffuse(),
        specular=given.GetSpecular(),
        power=given.GetSpecularPower(),
        is_unlit=is_unlit or not given.GetLighting(),
        is_physical=given.GetInterpolation() == _PHYSICAL,
        is_flat=given.GetInterpolation() == _FLAT,
        metallic=given.GetMetallic(),
        roughness=given.GetRoughness(),
        base_reflectance=_reflectance(given.GetBaseIOR()),
        occlusion=given.GetOcclusionStrength(),
        edge_tint=np.array(given.GetEdgeTint()),
        emissive=np.array(given.GetEmissiveFactor()),
        coat=_coat_of(given) if given.GetCoatStrength() > 0.0 else None,
        edge_width=width if has_edges else 0.0,
        edge_opacity=given.GetEdgeOpacity(),
        line_width=given.GetLineWidth(),
        point_size=given.GetPointSize(),
        has_tubes=bool(given.GetRenderLinesAsTubes()),
        has_balls=bool(given.GetRenderPointsAsSpheres()),
        round_points=is_round,
        style=given.GetRepresentation(),
        hides_back=bool(given.GetBackfaceCulling()),
        hides_front=bool(given.GetFrontfaceCulling()),
    )


def _coat_of(given: Any) -> Coat:
    return Coat(
        given.GetCoatStrength(),
        given.GetCoatRoughness(),
        _reflectance(given.GetCoatIOR()),
        np.array(given.GetCoatColor()),
    )


def _reflectance(ior: float) -> float:
    """Return how much light a surface reflects that arrives across it."""
    return ((ior - 1.0) / (ior + 1.0)) ** 2


#: White, and nothing else.
PLAIN = property_of(vtkProperty())
