"""Helpers for tests that write small files and load them."""

import pytest

from engine3d.loaders import load_document, load_mesh


@pytest.fixture
def write(tmp_path):
    """``write("a.obj", text_or_bytes) -> path``, in the test's own folder."""

    def write_file(name, content):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write_file


@pytest.fixture
def obj_mesh(write):
    """``obj_mesh(text) -> Mesh``; warnings are left to ``mesh.warnings``."""
    return lambda content: _quietly(load_mesh, write("model.obj", content))


@pytest.fixture
def obj_document(write):
    return lambda content: _quietly(load_document, write("model.obj", content))


def _quietly(load, path):
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load(path)
