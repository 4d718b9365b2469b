"""The number of threads: an argument, the environment, or all CPUs.

In: the argument ``threads``. Out: a thread count for the core, 0 for all CPUs that this process may
use. ``ENGINE3D_THREADS`` defines what 0 means.
"""

from __future__ import annotations

import numbers
import os

from ..errors import InvalidArgumentError
from .numbers import shown

MAX_THREADS = 256


def resolve_threads(threads: int = 0) -> int:
    """Return a number of threads; 0 means all CPUs that this process may use.

    Raises
    ------
    InvalidArgumentError
    """
    source = "threads"
    if isinstance(threads, numbers.Integral) and threads == 0:
        text = os.environ.get("ENGINE3D_THREADS") or "0"
        source = "ENGINE3D_THREADS"
        try:
            threads = int(text)
        except ValueError:
            threads = text
    if not isinstance(threads, numbers.Integral) or not 0 <= threads <= MAX_THREADS:
        raise InvalidArgumentError(
            f"{source} must be a whole number in 0..256, not {shown(threads)}"
        )
    return int(threads)
