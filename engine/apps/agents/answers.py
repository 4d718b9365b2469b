"""What the tools answer, as types of which the server makes schemas.

Lengths are in the objects' unit, areas and volumes in its powers; boxes in pixels are x, y, width,
height.
"""

from __future__ import annotations

from typing import Any

from typing_extensions import TypedDict


class Named(TypedDict):
    name: str
    pixels: int
    box: list[int]


class Loaded(TypedDict):
    name: str
    format: str
    triangles: int
    parts: list[str]
    part_count: int
    bounds: list[list[float]] | None
    unit: str
    up: str
    warnings: list[str]


class Scripted(Loaded):
    printed: str


class SceneRecord(TypedDict):
    objects: list[dict[str, Any]]
    object_count: int
    bounds: list[list[float]] | None
    lights: list[str]
    up: str
    unit: str
    camera: dict[str, Any] | None
    size: list[int] | None


class _Drawn(TypedDict):
    camera: dict[str, Any]
    size: list[int]
    visible: list[Named]
    not_visible: list[str]
    blank: bool
    reason: str | None
    seconds: float


class Rendered(_Drawn, total=False):
    cut: list[dict[str, Any]]


class Grid(TypedDict):
    size: list[int]
    cells: list[dict[str, Any]]


class _Picked(TypedDict):
    object: str | None
    view: str | None


class Picked(_Picked, total=False):
    triangle: int | None
    instance: int
    position: list[float]
    normal: list[float]
    distance: float


class Measured(TypedDict):
    bounds: list[list[float]]
    size: list[float]
    center: list[float]
    area: float
    volume: float | None
    watertight: bool
    components: int
    inertia: list[list[float]] | None
    unit: str


class Gap(TypedDict):
    distance: float
    points: list[list[float]]
    touching: bool
    inside: bool
    unit: str


class Checked(TypedDict):
    degenerate: int
    duplicate: int
    flipped: int
    open_edges: int
    non_manifold: int
    not_finite: int
    inside_out: bool
    missing_textures: list[str]
    faces: list[int]
    edges: list[list[list[float]]]
    reasons: list[str]


class Compared(TypedDict):
    changed_pixels: int
    pixels: int
    largest: float | None
    box: list[int] | None
    hausdorff: dict[str, Any] | None


class Edited(TypedDict):
    name: str
    bounds: list[list[float]] | None
    objects: list[str]


class Undone(TypedDict):
    objects: list[str]
    steps_left: int


class Exported(TypedDict):
    path: str
    bytes: int


class Formats(TypedDict):
    read: list[str]
    write: list[str]


class Health(TypedDict):
    version: str
    backend: str
    threads: int
    milliseconds: float
    scripts: bool
    limits: dict[str, Any]
