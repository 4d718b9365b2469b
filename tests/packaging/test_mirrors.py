"""What is written at build time: Cython's mirrors of the C headers, and the stubs of modules."""

import pytest
from own_scripts import importable

with importable("csrc"):
    import headers
    import mirrors
    import stubs

LIST = """
/* Rows. */
ROW(one, 1)
ROW(two, 2)
"""
HEADER = """
#ifndef E3D_SMALL_H
#define E3D_SMALL_H
#include <stdint.h>
#include "e3d_kind.h"
#ifdef __cplusplus
extern "C" {
#endif
enum { E3D_SIZE = 4, E3D_ROOM = 2 * E3D_SIZE }; /* room */
#define E3D_MOST 0x10u
#define E3D_NAMED(name, value) E3D_##name = value,
#define E3D_EACH_NAME(X) X(FIRST, 5) \\
    X(SECOND, E3D_ROOM)
typedef enum e3d_name { E3D_EACH_NAME(E3D_NAMED) E3D_NAMES } e3d_name;
typedef float e3d_row[E3D_SIZE];
#define ROW(name, value) int32_t name;
typedef struct e3d_small {
    const float *a, (*b)[3];
    e3d_row rows[2];
    uint8_t from, more[E3D_ROOM];
    union {
        int32_t word;
        float number;
    } either;
    struct e3d_hidden *own;
    e3d_kind kind;
#include "list.inl"
} e3d_small;
extern const float E3D_TABLE[E3D_NAMES][2];
bool e3d_do(const e3d_small *small, int (*ask)(void *), float matrix[16]);
static inline int e3d_twice(int n) { return 2 * n; }
#ifdef __cplusplus
}
#endif
#endif
"""
MIRROR = """\
from e3d_kind cimport e3d_kind
from libc.stdint cimport int32_t
from libc.stdint cimport uint8_t
cdef extern from "e3d_small.h" nogil:
    enum:
        E3D_SIZE
        E3D_ROOM
    ctypedef enum e3d_name:
        E3D_FIRST
        E3D_SECOND
        E3D_NAMES
    ctypedef float e3d_row[E3D_SIZE]
    ctypedef union e3d_small_either:
        int32_t word
        float number
    ctypedef struct e3d_small:
        const float *a
        const float (*b)[3]
        e3d_row rows[2]
        uint8_t from_ "from"
        uint8_t more[E3D_ROOM]
        e3d_small_either either
        void *own
        e3d_kind kind
        int32_t one
        int32_t two
    const float E3D_TABLE[E3D_NAMES][2]
    bint e3d_do(const e3d_small *small, int (*ask)(void *) noexcept nogil, float matrix[16])
    int e3d_twice(int n)
    enum:
        E3D_MOST
"""
MODULE = '''
from .other cimport Other

SIZE = E3D_SIZE
NAMES = {"one": 1}
PAIR: tuple[int, str] = (1, "a")

cdef int hidden(int a) except -1:
    return a

cdef class Thing(Base):
    """A thing."""

    cdef int own
    cdef readonly int32_t count, room  # of rows
    cdef public Other other

    def __cinit__(self, const float[:, ::1] rows not None, *, Other other=None):
        pass

    def __dealloc__(self):
        pass

    @property
    def name(self) -> str:
        return "thing"

    def find(
        self, const uint8_t[::1] key, double[::1] out, e3d_kind kind, bint deep=False, more=None
    ):
        def inner(x):
            x += 1
        out[0] = 1.0

def made(list parts not None, pairs: dict[str, int]) -> list[Thing]:
    def of(part):
        return part
    return [of(part) for part in parts]

def found(size_t count):
    return count
'''
STUB = """\
from .other import Other
SIZE: int
NAMES: dict[str, int]
PAIR: tuple[int, str]
class Thing:
    \"""See thing.pyx.\"""
    count: int
    room: int
    other: Other
    def __init__(self, rows: NDArray[np.float32], *, other: Other | None = None) -> None: ...
    @property
    def name(self) -> str: ...
    def find(self, key: bytes | memoryview | NDArray[np.uint8] | None, \
out: NDArray[np.float64] | None, kind: int, deep: bool = False, more: Any = None) -> None: ...
def made(parts: list[Any], pairs: dict[str, int]) -> list[Thing]: ...
def found(count: int) -> Any: ...
"""


@pytest.fixture
def small(tmp_path, monkeypatch):
    """Headers of a folder that has two and a list."""
    for module in (headers, mirrors):
        monkeypatch.setattr(module, "FOLDER", tmp_path)
    (tmp_path / "include").mkdir()
    (tmp_path / "include" / "e3d_small.h").write_text(HEADER, "utf-8")
    (tmp_path / "include" / "e3d_kind.h").write_text("typedef enum e3d_kind { E3D_ANY } e3d_kind;")
    (tmp_path / "include" / "e3d_all.h").write_text('#include "e3d_small.h"\n', "utf-8")
    (tmp_path / "list.inl").write_text(LIST, "utf-8")
    return tmp_path


def test_a_mirror_says_what_its_header_does(small):
    mirrors.write_mirrors(small / "made")
    made = {path.name: path.read_text("utf-8") for path in (small / "made").iterdir()}
    assert made.keys() == {"e3d_small.pxd", "e3d_kind.pxd", "e3d_all.pxd"}
    first, _, rest = made["e3d_small.pxd"].partition("\n")
    assert "csrc/mirrors.py" in first and "e3d_small.h" in first
    assert rest == MIRROR
    assert made["e3d_all.pxd"].splitlines()[1:] == ["from e3d_small cimport *"]


def test_constants_have_the_values_of_c(small):
    read = headers.Headers("e3d_small.h")
    names = ("E3D_ROOM", "E3D_MOST", "E3D_FIRST", "E3D_SECOND", "E3D_NAMES")
    assert [read.constants[name] for name in names] == [8, 16, 5, 8, 9]
    assert read.rows("E3D_EACH_NAME") == [["FIRST", "5"], ["SECOND", "E3D_ROOM"]]
    assert read.rows("E3D_EACH_OTHER") == []


def test_files_that_are_the_same_are_not_written_again(small):
    mirrors.write_mirrors(small / "made")
    before = {path: path.stat().st_mtime_ns for path in (small / "made").iterdir()}
    mirrors.write_mirrors(small / "made")
    assert {path: path.stat().st_mtime_ns for path in (small / "made").iterdir()} == before


def test_a_stub_says_what_its_module_does(tmp_path):
    (tmp_path / "thing.pyx").write_text(MODULE, "utf-8")
    stubs.write_stub(tmp_path / "thing.pyx", tmp_path / "thing.pyi")
    head, _, rest = (tmp_path / "thing.pyi").read_text("utf-8").partition("NDArray\n\n")
    assert "csrc/stubs.py" in head.partition("\n")[0]
    assert rest == STUB


def test_each_kernel_can_be_repeated():
    (kernel,) = headers.Headers("kernels/kernels.h").types["e3d_kernels"].members[:1]
    call = "repeated_table->face_away(clusters, count, facing, drop, clip, viewport);"
    assert mirrors.rounds(kernel).count(call) == 2
