from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

DONE: int
NO_MEMORY: int
TOO_LARGE: int
NO_VERTICES: int
FEW_NUMBERS: int
NOT_A_NUMBER: int
NOT_AN_INDEX: int
NO_INDEX: int
MANY_INDICES: int
OUT_OF_RANGE: int

OBJECT: int
GROUP: int
SMOOTHING: int
MATERIAL: int
LIBRARY: int
UNKNOWN: int

PLY_DONE: int
PLY_SHORT: int
PLY_BAD_LIST: int

NO_COMMENTS: int
HASH_COMMENTS: int
PLY_COMMENTS: int

ROW: int
MARKED: int
SKIPPED: int

MARK: np.dtype
SETTER: np.dtype

def large_array(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray: ...

class OwnedMemory:
    @property
    def is_frozen(self) -> bool: ...

class SealedMemory: ...

def frozen(array: NDArray) -> NDArray: ...
def is_frozen(array: np.ndarray) -> bool: ...
def exchange(held: dict, expected: dict, fresh: dict) -> bool: ...
def read_bytes(readinto: Callable[[memoryview], int], size: int) -> bytes: ...

class ObjReader:
    consumed: int
    error: tuple[int, int, int, bytes]
    def __init__(self, data: bytes | memoryview) -> None: ...
    def read(self, size: int) -> bool: ...
    def end(self) -> int: ...
    def take(self) -> dict[str, Any]: ...

def weld_corners(
    positions: NDArray[np.int32],
    uvs: NDArray[np.int32] | None,
    normals: NDArray[np.int32] | None,
    position_count: int,
) -> tuple[
    NDArray[np.int32], NDArray[np.int32], NDArray[np.int32] | None, NDArray[np.int32] | None
]: ...
def used_or_all(indices: NDArray[np.int32], total: int) -> NDArray[np.bool_] | None: ...
def number_rows(
    rows: NDArray[np.uint32], are_floats: bool
) -> tuple[NDArray[np.int32], NDArray[np.int32]]: ...
def rows_repeat(rows: NDArray[np.uint32], are_floats: bool) -> bool: ...
def weld_facets(
    pieces: Iterable[tuple[int, memoryview]], offset: int, stride: int, facets: int
) -> tuple[NDArray[np.int32], NDArray[np.float32]]: ...
def encloses(
    positions: NDArray[np.float32],
    faces: NDArray[np.int32],
    places: NDArray[np.int32] | None,
    count: int,
) -> bool: ...
def open_sides(
    positions: NDArray[np.float32],
    faces: NDArray[np.int32],
    places: NDArray[np.int32] | None,
    count: int,
    most: int,
) -> NDArray[np.int32] | None: ...
def find_creases(
    positions: NDArray[np.float32],
    faces: NDArray[np.int32],
    places: NDArray[np.int32] | None,
    visible: NDArray[np.uint8] | None,
    count: int,
    cosine: float,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.float32], bool]: ...
def find_tangents(
    positions: NDArray[np.float32],
    normals: NDArray[np.float32],
    uvs: NDArray[np.float32],
    faces: NDArray[np.int32],
    points: NDArray[np.int32],
) -> tuple[NDArray[np.int32], NDArray[np.float32]]: ...
def smooth_sums(
    positions: NDArray[np.floating],
    faces: NDArray[np.int32],
    groups: NDArray[np.int32],
    count: int,
    block: int,
) -> NDArray[np.float64]: ...
def find_edges(
    faces: NDArray[np.int32],
    points: NDArray[np.int32] | None,
    wanted: NDArray[np.uint8] | None,
    count: int,
) -> NDArray[np.uint8]: ...
def cut_polygons(
    sizes: NDArray[np.int32],
    positions: NDArray[np.floating],
    indices: NDArray[np.int32] | None,
    corners: int,
    triangles: int,
    tests: int,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.bool_] | None, bool, int]: ...
def walk_ply_rows(
    data: bytes | memoryview,
    start: int,
    is_big_endian: bool,
    lists: list[tuple[int, int, bool, int]],
    tail: int,
    rows: int,
) -> tuple[int, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], int, int]: ...
def ply_lengths_are(
    data: bytes | memoryview,
    is_big_endian: bool,
    start: int,
    stride: int,
    rows: int,
    count_size: int,
    length: int,
) -> bool: ...
def copy_ply_lists(
    data: bytes | memoryview,
    is_big_endian: bool,
    starts: NDArray[np.int64],
    sizes: NDArray[np.int64],
    number: int,
    dtype: np.dtype,
) -> NDArray: ...
def copy_even_ply_lists(
    data: bytes | memoryview, is_big_endian: bool, count_size: int, items: NDArray
) -> bool: ...
def copy_ply_rows(
    data: bytes | memoryview, is_big_endian: bool, start: int, stride: int, items: NDArray
) -> None: ...
def read_numbers(
    text: bytes | memoryview, comments: int, rows: int | None = None, with_widths: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.int64] | None, int, int | None]: ...
def walk_number_rows(
    values: NDArray[np.float64], start: int, skips: list[int], tail: int, rows: int
) -> tuple[int, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], int, int]: ...
def copy_numbers(
    values: NDArray[np.float64],
    starts: NDArray[np.int64],
    sizes: NDArray[np.int64],
    number: int,
) -> NDArray[np.float64]: ...
def indices_of(values: NDArray[np.float64], limit: int) -> tuple[NDArray[np.int32], int | None]: ...

class FormReader:
    def __init__(
        self,
        text: bytes | memoryview,
        forms: Iterable[tuple[bytes, int, int, int, float, int]],
        any_case: bool = False,
    ) -> None: ...
    def read(self, place: int) -> int: ...
    def add(self, form: int, numbers: Sequence[float], is_whole: bool = True) -> None: ...
    def count(self, form: int) -> tuple[int, int]: ...
    def lines(self, form: int) -> int: ...
    def take_rows(self, form: int) -> NDArray[np.float64]: ...
    def take_marks(self) -> NDArray: ...

def unpack_meshopt(
    data: bytes | memoryview, mode: str, filter: str, count: int, stride: int
) -> NDArray[np.uint8] | None: ...
