"""Types of the gateway to the rendering core; the docstrings are in rasterizer.pyx."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .scene_graph import NativeTree

_Bytes = npt.NDArray[np.uint8]
_Floats = npt.NDArray[np.float32]
_Doubles = npt.NDArray[np.float64]
_Integers = npt.NDArray[np.int32]

ALPHA_MODES: dict[str, int]
FILTERS: dict[str, int]
WRAPS: dict[str, int]
FALLOFFS: dict[str, int]
LIGHT_KINDS: dict[str, int]
LINE_SHAPES: dict[str, int]
MAP_LAYOUTS: dict[str, int]
MODES: dict[str, int]
CULLS: dict[str, int]
WIREFRAMES: dict[str | None, int]
HIDDEN_SURFACES: dict[str, int]
POINT_SHAPES: dict[str, int]
CULLINGS: dict[str, int]
SHADINGS: dict[str, int]
TEXTURE_SLOTS: dict[str, int]
PHYSICAL_NUMBERS: tuple[str, ...]
NORMALS: dict[str, int]
TONE_MAPPINGS: dict[str, int]
BACKENDS: dict[str, int]
BUILD: tuple[str, str]
OUTPUTS: dict[str, tuple[str, int]]
VERTEX_ATTRIBUTES: dict[str, tuple[str, int]]

class LightTraits(NamedTuple):
    has_position: bool
    is_turned: bool
    maps: str

LIGHT_TRAITS: dict[str, LightTraits]

def backend_available(backend: int) -> bool: ...
def best_backend() -> int: ...
def thread_count() -> int: ...
def bound_points(points: _Floats) -> tuple[list[float], list[float]]: ...
def same_objects(some: tuple, others: tuple) -> bool: ...

class NativeMesh:
    attributes: set[str]
    has_face_normals: bool
    has_edges: bool
    vertices: int
    faces_count: int
    def __init__(
        self,
        positions: _Floats,
        faces: _Integers,
        attributes: dict[str, _Floats | _Bytes],
        *,
        material_ids: _Integers | None = None,
        lines: _Integers | None = None,
        points: _Integers | None = None,
        movers: _Integers | None = None,
        threads: int = 0,
    ) -> None: ...
    def set_attribute(self, name: str, array: _Floats | _Bytes) -> None: ...
    def set_face_normals(self, normals: _Floats) -> None: ...
    def set_edges(self, edges: _Integers) -> None: ...

class NativeRest:
    mesh: NativeMesh
    joints: int
    targets: int
    def __init__(
        self,
        mesh: NativeMesh,
        normals: _Floats | None,
        tangents: _Floats | None,
        joints: npt.NDArray[np.uint16] | None,
        weights: _Floats | None,
        target_positions: _Floats | None,
        target_normals: _Floats | None,
        target_tangents: _Floats | None,
    ) -> None: ...

class NativePose:
    rest: NativeRest
    current: NativeMesh
    face_normals: bool
    has_edges: bool
    def __init__(self, rest: NativeRest, face_normals: bool) -> None: ...
    def set_skeleton(
        self, slots: _Integers, above: _Integers, ends: _Integers, inverse_binds: _Doubles
    ) -> None: ...
    def forget_skeleton(self) -> None: ...
    def set_weights(self, weights: _Floats) -> None: ...
    def want_face_normals(self) -> None: ...
    def want_edges(self, edges: _Integers) -> None: ...
    def copy_box(self, box: _Doubles) -> None: ...
    def copy_vertices(
        self, positions: _Floats, normals: _Floats | None, tangents: _Floats | None
    ) -> None: ...
    def copy_matrices(self, matrices: _Floats) -> None: ...

def pose_meshes(
    poses: list[NativePose], node_poses: _Doubles | None, threads: int
) -> list[int]: ...

class NativeTexture:
    def __init__(
        self,
        pixels: _Bytes,
        decode_srgb: bool,
        filter: int,
        wrap_u: int,
        wrap_v: int,
        anisotropy: int,
        lod_bias: float,
    ) -> None: ...

class NativeEnvironment:
    def __init__(self, pixels: _Floats, threads: int) -> None: ...
    def level(self, number: int) -> LevelTexels: ...

class LevelTexels:
    def __buffer__(self, flags: int, /) -> memoryview: ...

class NativeDrawList:
    object_count: int
    material_count: int
    light_count: int
    node_boxes_tested: int
    def __init__(self) -> None: ...
    def clear(self) -> None: ...
    def clear_lights(self) -> None: ...
    def set_ambient_light(self, terms: Sequence[Sequence[float]] | None) -> None: ...
    def set_object(
        self,
        index: int,
        mesh: NativeMesh | None,
        material_base: int,
        encloses: bool = False,
        rim_ends: _Integers | None = None,
        rims: _Doubles | None = None,
    ) -> None: ...
    def close_windows(self) -> None: ...
    def open_windows(
        self,
        count: int,
        columns: dict[str, npt.NDArray],
        clip_from_world: _Doubles,
        view_from_world: _Doubles,
        width: int,
        height: int,
    ) -> int | None: ...
    def set_meshes(self, numbers: _Integers, poses: list[NativePose]) -> None: ...
    def place(
        self,
        count: int,
        flags: _Bytes,
        object: _Integers,
        id: _Integers,
        world: _Doubles,
        anchor: _Integers,
        selection: npt.NDArray[np.uint64] | None,
        clip_from_world: _Doubles | None,
        widen: float,
        flat: bool,
        batch: bool,
        moved: bool,
    ) -> None: ...
    def set_instance_tree(self, index: int, tree: NativeTree | None) -> None: ...
    def set_instances(
        self,
        index: int,
        poses: _Floats,
        colors_u8: _Bytes | None = None,
        colors_f32: _Floats | None = None,
        ids: _Integers | None = None,
    ) -> None: ...
    def set_material(
        self,
        index: int,
        numbers: dict[str, Any],
        physical: dict[str, float | Sequence[float]] | None,
        textures: dict[str, tuple[NativeTexture, int, Sequence[float] | None]],
    ) -> None: ...
    def add_light(
        self,
        kind: int,
        color: Sequence[float],
        lux: Sequence[float],
        *,
        range: float,
        falloff: int,
        cone: Sequence[float],
    ) -> None: ...
    def turn_light(self, number: int, to_light: Sequence[float] | _Doubles) -> None: ...
    def move_light(self, number: int, position: Sequence[float] | _Doubles) -> None: ...

class NativeOptions:
    def __init__(
        self,
        numbers: dict[str, float | Sequence[float]],
        environment: NativeEnvironment | None = None,
        backdrop: NativeEnvironment | None = None,
        fog: tuple[Sequence[float], Sequence[float], tuple[float, float] | None, float]
        | None = None,
    ) -> None: ...

class NativeStats:
    def as_dict(self) -> dict[str, int | float | str]: ...

class NativeRenderer:
    def __init__(self, backend: int, threads: int) -> None: ...
    def abandon(self) -> None: ...
    def prepare(self, width: int, height: int, planes: int) -> None: ...
    def render(
        self,
        draw_list: NativeDrawList,
        targets: dict[str, np.ndarray],
        options: NativeOptions,
        width: int,
        height: int,
        samples_axis: int,
        msaa_samples: int,
        clip_from_world: _Doubles,
        view_from_world: _Doubles,
        eye: Sequence[float],
        number: int,
        depth_near: float,
        depth_far: float,
        frozen_clip_from_world: _Doubles | None = None,
        rays: _Floats | None = None,
        ambient_visibility: _Floats | None = None,
    ) -> NativeStats: ...

def shadow_ranges_side(size: int) -> int: ...
def find_shadow_ranges(
    depths: _Floats, taps: int, step: int, ranges: npt.NDArray[np.uint32]
) -> None: ...
def bloom_scratch(width: int, height: int, threads: int) -> int: ...
def add_bloom(
    radiance: _Floats,
    color: _Bytes,
    strength: float,
    srgb: bool,
    backend: int,
    threads: int,
    scratch: _Floats,
) -> None: ...
def rasterize(
    clip: _Floats,
    faces: _Integers,
    cull: int,
    backend: int,
    threads: int,
    triangle_id: _Integers,
    depth: _Floats,
    barycentric: _Floats,
) -> None: ...
def find_occlusion(
    depth: _Floats,
    across: tuple[float, float],
    down: tuple[float, float],
    is_perspective: bool,
    radius: float,
    backend: int,
    threads: int,
    scratch: _Floats,
    visibility: _Floats,
) -> None: ...
