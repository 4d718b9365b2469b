"""The pool gives arrays that stay the caller's own, and gets their memory back afterwards."""

import gc

import numpy as np
import pytest

from engine3d.rendering._output_pool import OutputPool


@pytest.fixture
def pool():
    return OutputPool()


def take(pool, shape, dtype):
    return pool.take({"color": (shape, np.dtype(dtype))})["color"]


def address(array):
    return array.__array_interface__["data"][0]


def test_shape_dtype_and_writable(pool):
    array = take(pool, (4, 5, 3), np.float32)
    assert array.shape == (4, 5, 3)
    assert array.dtype == np.float32
    assert array.flags.c_contiguous
    array[...] = 1


def test_memory_comes_back_when_the_array_dies(pool):
    array = take(pool, (8, 8), np.int32)
    place = address(array)
    del array
    assert address(take(pool, (8, 8), np.int32)) == place


def test_same_size_of_another_type_uses_the_same_memory(pool):
    array = take(pool, (8, 8), np.int32)
    place = address(array)
    del array
    assert address(take(pool, (8, 8, 4), np.uint8)) == place


def test_prepared_memory_has_its_pages(pool):
    """Arrays of 3 MB take no page faults when they are first written; there are 1536 pages."""
    outputs = {name: ((1024, 768), np.dtype(np.float32)) for name in ("depth", "ndc_depth")}
    pool.prepare(outputs)
    resource = pytest.importorskip("resource", reason="page faults are counted on POSIX")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for array in pool.take(outputs).values():
        array.fill(1)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before < 150


@pytest.mark.parametrize(
    "view",
    [
        lambda array: array[2:5, ::2],
        lambda array: array.T,
        lambda array: array.reshape(-1).view(np.uint8)[3:7],
        lambda array: memoryview(array),
        lambda array: np.asarray(memoryview(array))[1:],
        lambda array: array.ravel()[5:].reshape(-1, 1).view(),
        lambda array: np.ma.asarray(array),
    ],
)
def test_any_view_keeps_the_memory(pool, view):
    array = take(pool, (8, 8), np.int32)
    place = address(array)
    seen = view(array)
    del array
    gc.collect()
    assert address(take(pool, (8, 8), np.int32)) != place
    del seen
    gc.collect()


def test_a_steady_loop_allocates_nothing(pool):
    places = set()
    frame = None
    for _ in range(10):
        frame = take(pool, (64, 64, 4), np.uint8)
        places.add(address(frame))
    assert len(places) == 2


def test_a_steady_loop_of_several_outputs_allocates_nothing(pool):
    outputs = {
        "depth": ((64, 64), np.dtype(np.float32)),
        "instance_id": ((64, 64), np.dtype(np.int32)),
        "color": ((64, 64, 4), np.dtype(np.uint8)),
        "normal": ((64, 64, 3), np.dtype(np.float32)),
    }
    places = set()
    frame = None
    for _ in range(10):
        frame = pool.take(outputs)
        places.update(map(address, frame.values()))
    assert len(places) == 2 * len(outputs)


def test_few_free_blocks_are_kept(pool):
    arrays = [take(pool, (16, 16), np.uint8) for _ in range(20)]
    del arrays
    assert sum(map(len, pool._free.values())) <= 2
    assert not pool._lent


def test_arrays_outlive_the_pool():
    pool = OutputPool()
    array = take(pool, (16,), np.uint8)
    array[:] = 7
    del pool
    gc.collect()
    assert (array == 7).all()


def test_forget(pool):
    kept = take(pool, (4,), np.uint8)
    take(pool, (4,), np.uint8)
    pool.forget()
    assert not pool._free
    kept[:] = 1
