"""Where the optional corpus of real and hostile files is, and how a test asks for it.

It is no part of the project: a folder ``shared`` beside the checkout, or wherever the environment
variable ENGINE3D_SHARED points. Tests that need it are skipped where it is absent.
"""

from __future__ import annotations

import functools
import json
import os
from pathlib import Path

import pytest

_NEIGHBOUR = Path(__file__).resolve().parents[1].parent / "shared"
SHARED = Path(os.environ.get("ENGINE3D_SHARED") or _NEIGHBOUR)
CONFORMANCE = SHARED / "conformance"
MODELS = SHARED / "models"
GLTF = SHARED / "gltf"

needs_conformance = pytest.mark.skipif(
    not (CONFORMANCE / "expected.json").is_file(),
    reason="needs the conformance corpus in ../shared (or ENGINE3D_SHARED)",
)
needs_models = pytest.mark.skipif(
    not MODELS.is_dir(), reason="needs the models in ../shared (or ENGINE3D_SHARED)"
)
needs_gltf = pytest.mark.skipif(
    not (GLTF / "expected.json").is_file(),
    reason="needs the corpus in ../shared (or ENGINE3D_SHARED)",
)


@functools.cache
def conformance_cases() -> tuple[dict, ...]:
    """The corpus's table of expected outcomes, empty where the corpus is absent."""
    try:
        return tuple(json.loads((CONFORMANCE / "expected.json").read_text()))
    except FileNotFoundError:
        return ()


def cases_of(*formats: str) -> list:
    """The cases of some formats, as parameters whose ids are their files."""
    return [
        pytest.param(case, id=case["file"])
        for case in conformance_cases()
        if case["fmt"] in formats
    ]
