"""Selection of the backend.

In: the argument ``backend`` and the environment. Out: a backend's number. ``ENGINE3D_BACKEND``
defines what ``"auto"`` means. An unknown or unsupported backend is an error; there is no fallback.
"""

from __future__ import annotations

import os
from typing import cast

from .._native import rasterizer as _native
from ..base.numbers import shown
from ..choices import Backend
from ..errors import BackendError


def backends() -> list[Backend]:
    """Return the backends that this machine can run, slowest first.

    ``"scalar"`` is the reference, single-threaded and without SIMD; ``"portable"`` runs on every
    processor; the others are named after the instruction set that they need. All draw the same.
    """
    known = cast("dict[Backend, int]", _native.BACKENDS)
    return [name for name, number in known.items() if _native.backend_available(number)]


def resolve_backend(backend: Backend = "auto") -> int:
    """Return the core's number of a backend.

    Raises
    ------
    BackendError
        The backend is unknown, or this machine cannot run it.
    """
    source = "backend"
    if isinstance(backend, str) and backend == "auto":
        backend = cast(Backend, os.environ.get("ENGINE3D_BACKEND") or "auto")
        source = "ENGINE3D_BACKEND"
        if backend == "auto":
            return _native.best_backend()
    number = _native.BACKENDS.get(backend) if isinstance(backend, str) else None
    if number is None:
        known = ", ".join(["auto", *_native.BACKENDS])
        raise BackendError(f"{source}={shown(backend)} is unknown: it is one of {known}")
    if not _native.backend_available(number):
        raise BackendError(
            f"{source}={backend!r} does not run on this machine: it has {', '.join(backends())}"
        )
    return number
