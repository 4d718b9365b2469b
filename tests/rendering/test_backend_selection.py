"""Backends and threads: arguments, environment, errors."""

import pytest

import engine3d as e3d
from engine3d._native import rasterizer
from engine3d.base.thread_count import resolve_threads
from engine3d.rendering.backend_selection import resolve_backend


@pytest.fixture(autouse=True)
def clean_environment(monkeypatch):
    monkeypatch.delenv("ENGINE3D_BACKEND", raising=False)
    monkeypatch.delenv("ENGINE3D_THREADS", raising=False)


def test_backends_start_with_those_that_always_run():
    assert e3d.backends()[:2] == ["scalar", "portable"]
    assert set(e3d.backends()) <= {"scalar", "portable", "sse41", "avx2", "avx512", "neon"}


def test_auto_is_the_best():
    assert resolve_backend() == rasterizer.best_backend()
    assert e3d.Renderer((1, 1)).backend == e3d.backends()[-1]


@pytest.mark.parametrize("name", ["scalar", "portable"])
def test_environment_says_what_auto_means(monkeypatch, name):
    monkeypatch.setenv("ENGINE3D_BACKEND", name)
    assert e3d.Renderer((1, 1)).backend == name
    assert e3d.Renderer((1, 1), backend="portable").backend == "portable"


@pytest.mark.parametrize("name", ["mmx", "", None, 3, "AVX2"])
def test_unknown_backend(name):
    with pytest.raises(e3d.errors.BackendError, match="is unknown: it is one of auto, scalar"):
        resolve_backend(name)


def test_unknown_backend_in_the_environment(monkeypatch):
    monkeypatch.setenv("ENGINE3D_BACKEND", "mmx")
    with pytest.raises(e3d.errors.BackendError, match="ENGINE3D_BACKEND='mmx'"):
        e3d.Renderer((1, 1))


def test_backend_that_the_machine_lacks(monkeypatch):
    monkeypatch.setattr(rasterizer, "backend_available", lambda number: number < 2)
    with pytest.raises(e3d.errors.BackendError, match="does not run on this machine"):
        resolve_backend("avx512")
    assert e3d.backends() == ["scalar", "portable"]


def test_threads(monkeypatch):
    assert resolve_threads() == 0
    assert resolve_threads(3) == 3
    monkeypatch.setenv("ENGINE3D_THREADS", "2")
    assert resolve_threads() == 2
    assert resolve_threads(5) == 5


@pytest.mark.parametrize("threads", [-1, 257, 1.5, "2", None])
def test_invalid_threads(threads):
    with pytest.raises(
        e3d.InvalidArgumentError, match=r"threads must be a whole number in 0\.\.256"
    ):
        resolve_threads(threads)


@pytest.mark.parametrize("text", ["many", "-2", "1000"])
def test_invalid_threads_in_the_environment(monkeypatch, text):
    monkeypatch.setenv("ENGINE3D_THREADS", text)
    with pytest.raises(e3d.InvalidArgumentError, match="ENGINE3D_THREADS"):
        resolve_threads()
