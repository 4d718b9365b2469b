"""Types of the gateway to single kernels; the docstrings are in kernels_testing.pyx."""

import numpy as np
import numpy.typing as npt

_Bytes = npt.NDArray[np.uint8]
_Words = npt.NDArray[np.uint32]
_Floats = npt.NDArray[np.float32]
_Integers = npt.NDArray[np.int32]
_Doubles = npt.NDArray[np.float64]

STRUCT_SIZES: dict[str, int]
LIMITS: dict[str, int]
FLUSH_DENORMALS: int
ROUND_UP: int

def clusters_of(
    positions: _Floats, faces: _Integers, threads: int
) -> tuple[list[int], list[tuple], list[tuple]]: ...
def pose_by_reference(
    positions: _Floats,
    normals: _Floats,
    tangents: _Floats,
    joints: npt.NDArray[np.uint16] | None,
    weights: _Floats | None,
    target_positions: _Floats | None,
    target_normals: _Floats | None,
    target_tangents: _Floats | None,
    matrices: _Floats | None,
    target_weights: _Floats | None,
    out_positions: _Floats,
    out_normals: _Floats,
    out_tangents: _Floats,
) -> None: ...
def jobs_alone(rates: _Doubles, passed: int, alone: _Bytes) -> None: ...
def dfg_table(kind: int) -> list[list[float]]: ...
def plan_rules() -> list[tuple[str, list[str], list[str]]]: ...
def asked_items() -> list[tuple[str, str]]: ...
def planned_items() -> list[tuple[str, str]]: ...
def float_control() -> int: ...
def set_float_control(value: int) -> None: ...

class Kernels:
    rounds: int
    def __init__(self, backend: int) -> None: ...
    def face_away(
        self, clusters: _Bytes, facing: _Bytes, drop: int, clip: _Floats, viewport: _Bytes
    ) -> int: ...
    def transform(
        self,
        positions: _Floats,
        stride: int,
        count: int,
        matrix: _Floats,
        viewport: _Bytes,
        inside: bool,
        out: _Bytes,
    ) -> None: ...
    def take_clip(
        self, positions: _Floats, stride: int, count: int, viewport: _Bytes, out: _Bytes
    ) -> None: ...
    def setup(
        self,
        vertices: _Bytes,
        indices: _Bytes,
        triangles: int,
        cull: int,
        fragments: bool,
        viewport: _Bytes,
        out: _Bytes,
    ) -> int: ...
    def record(
        self,
        vertices: _Bytes,
        indices: _Bytes,
        triangles: _Bytes,
        count: int,
        tiny: bool,
        cull: int,
        mirrored: bool,
        order: int,
        faces: _Integers,
        viewport: _Bytes,
        out: _Bytes,
        spans: _Bytes,
    ) -> int: ...
    def add_small(
        self,
        vertices: _Bytes,
        indices: _Bytes,
        triangles: int,
        first: int,
        bits: int,
        out: _Bytes,
    ) -> None: ...
    def fragments(
        self,
        triangles: _Bytes,
        viewport: _Bytes,
        tiles_x: int,
        blocks: _Bytes,
        bins: _Bytes,
        count: int,
    ) -> tuple[int, int, int]: ...
    def raster_depth(self, pieces: _Bytes, z: _Floats, slot: _Integers, orders: _Words) -> None: ...
    def raster_overwrite(
        self, pieces: _Bytes, z: _Floats, slot: _Integers, orders: _Words
    ) -> None: ...
    def raster_count(self, pieces: _Bytes, z: _Floats, slot: _Integers, orders: _Words) -> None: ...
    def raster_mark(self, pieces: _Bytes, z: _Floats, slot: _Integers, orders: _Words) -> None: ...
    def raster_visible(
        self, tile: _Bytes, records: _Bytes, ids: _Words, drawn: _Bytes | None = None
    ) -> None: ...
    def raster_fragments(
        self, tile: _Bytes, records: _Bytes, drawn: _Bytes, block: _Bytes
    ) -> None: ...
    def raster_settle(self, tile: _Bytes, records: _Bytes, depths: bool = True) -> None: ...
    def raster_measure(self, tile: _Bytes, columns: _Floats) -> None: ...
    def find_runs(self, tile: _Bytes, width: int, height: int, out: _Bytes) -> tuple[int, bool]: ...
    def show_records(
        self, tile: _Bytes, records: _Bytes, ids: _Integers, shown: _Bytes
    ) -> None: ...
    def show_fragments(self, tile: _Bytes, block: _Bytes, shown: _Bytes) -> None: ...
    def take_runs(self, runs: _Bytes, piece: int, batch: _Bytes) -> int: ...
    def take_shown(
        self, shown: _Bytes, first: int, count: int, piece: int, batch: _Bytes
    ) -> int: ...
    def project(self, surfaces: _Bytes, viewport: _Bytes) -> None: ...
    def surface(self, surfaces: _Bytes, tile_x: int, tile_y: int, wanted: int) -> None: ...
    def interpolate(self, batch: _Bytes, surfaces: _Bytes, wanted: int) -> None: ...
    def texture(
        self,
        batch: _Bytes,
        texels: _Bytes,
        channel_bits: int,
        sizes: _Integers,
        filter: int,
        wrap: tuple[int, int],
        base: _Floats,
        anisotropy: int = 1,
        level_scale: float = 1.0,
        surfaces: _Bytes | None = None,
    ) -> None: ...
    def tint(self, batch: _Bytes, surfaces: _Bytes, by_vertex: bool, by_instance: bool) -> None: ...
    def light(
        self,
        batch: _Bytes,
        lights: _Bytes,
        reach: _Floats,
        ambient: _Floats,
        clamp: _Floats,
        eye: _Floats,
        shininess: float,
    ) -> None: ...
    def combine(
        self,
        batch: _Bytes,
        specular: _Floats | None,
        emissive: _Floats,
        exposure: float = 1.0,
    ) -> None: ...
    def physical(
        self,
        batch: _Bytes,
        model: dict[str, _Floats],
        lights: _Bytes,
        reach: _Floats,
        ambient: _Floats,
        eye: _Floats,
        maps: _Bytes,
    ) -> None: ...
    def environment(
        self,
        pixels: _Floats,
        turn: tuple[float, float],
        intensity: float,
        direction: _Floats,
        level: _Floats,
        count: int,
        color: _Floats,
    ) -> None: ...
    def irradiance(
        self,
        pixels: _Floats,
        turn: tuple[float, float],
        intensity: float,
        normal: _Floats,
        count: int,
        color: _Floats,
    ) -> None: ...
    def backdrop(
        self,
        pixels: _Floats,
        turn: tuple[float, float],
        intensity: float,
        level: float,
        rays: _Floats,
        x: int,
        y: int,
        count: int,
        color: _Floats,
    ) -> None: ...
    def albedo(
        self, kind: int, roughness: _Floats, cosine: _Floats, count: int, out: _Floats
    ) -> None: ...
    def lobe(self, group: _Bytes, block: _Bytes) -> None: ...
    def fog(self, fog: tuple, position: _Floats, count: int, color: _Floats) -> None: ...
    def tone(self, mapping: int, color: _Floats, count: int) -> None: ...
    def encode(
        self,
        red: _Floats,
        green: _Floats,
        blue: _Floats,
        count: int,
        srgb: bool,
        rgba: _Words,
    ) -> None: ...
    def put(self, batch: _Bytes, srgb: bool, rgba: _Words) -> None: ...
    def keep(self, batch: _Bytes, samples: _Floats) -> None: ...
    def raster_alpha(
        self,
        piece: _Bytes,
        records: _Bytes,
        limit: _Floats,
        kept: _Integers,
        shown: _Bytes,
        z: _Floats,
    ) -> tuple[int, bool]: ...
    def alpha(
        self,
        batch: _Bytes,
        surfaces: _Bytes,
        texture: tuple | None,
        base: float,
        by_vertex: bool,
        by_instance: bool,
    ) -> None: ...
    def lay(self, batch: _Bytes, samples: _Floats) -> None: ...
    def blend(
        self,
        first: _Words,
        depth: _Integers,
        which: _Words,
        color: _Floats,
        samples: _Floats,
        left: npt.NDArray[np.uint16],
        through: _Floats | None = None,
        light: _Floats | None = None,
        lit: _Floats | None = None,
        axis: int = 1,
    ) -> int: ...
    def average(
        self,
        samples: _Floats,
        axis: int,
        row: int,
        width: int,
        background: _Floats,
        srgb: bool,
        rgba: _Words,
    ) -> None: ...
    def paint(
        self,
        batch: _Bytes,
        surfaces: _Bytes,
        wanted: int,
        texture: tuple[_Bytes, int, _Integers, int, int] | None,
        base: _Floats,
        by_vertex: bool,
        by_instance: bool,
        lighting: tuple[_Bytes, _Floats, _Floats, _Floats, _Floats] | None,
        shininess: float,
        specular: _Floats | None,
        emissive: _Floats | None,
        srgb: bool,
        rgba: _Words,
        samples: _Floats | None = ...,
        fog: tuple | None = ...,
        tone: int = ...,
    ) -> None: ...
    def stream(
        self, to: _Bytes, pitch: int, source: _Bytes, step: int, size: int, count: int
    ) -> None: ...
