"""Time limits for pictures drawn by workers that cannot be killed, such as Dask's threads.

In: tasks. Out: an `Outcome` for each. Each thread lets its own process draw them one by one; if a
picture takes too long, that process is killed and replaced.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence

from .drawing import How, Outcome, draw_chunk
from .processes import ProcessPool, TimeLimitError
from .task import Task

_IDLE = 30.0  # seconds: other programs' workers outlive the batch, and our processes would too
_kept = threading.local()


def draw_limited(tasks: Sequence[Task], how: How) -> list[Outcome]:
    """Draw some pictures, each for ``how.timeout`` seconds at most."""
    pool, alone = _pool(how.timeout), how._replace(timeout=None)
    return [_outcome(pool, task, alone) for task in tasks]


def _outcome(pool: ProcessPool, task: Task, how: How) -> Outcome:
    try:
        (outcome,) = pool.submit(draw_chunk, [task], how).result()
    except TimeLimitError as error:
        return Outcome(task.index, str(error), False, error.seconds, ())
    return outcome


def _pool(limit: float | None) -> ProcessPool:
    """Return the process of this thread."""
    if getattr(_kept, "limit", None) != limit:
        if getattr(_kept, "pool", None) is not None:
            _kept.pool.stop()
        _kept.limit, _kept.pool = limit, ProcessPool(1, limit, _IDLE)
    return _kept.pool
