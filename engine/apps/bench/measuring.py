"""Times the frames of one renderer.

In:  a workload, a renderer, seconds to spend.
Out: a row of figures: medians over the frames, whatever else the machine did in some of them.

The time of a frame is what a caller waits for a finished array. Frames before it warm up.
"""

from __future__ import annotations

import statistics
import time

import numpy as np

from ...rendering.renderer import Renderer
from ..scenes.workloads import Workload

#: Milliseconds: slower frames are not repeated often.
SLOW = 1500.0
LEAST, MOST = 3, 300
STAGES = ("ms_geometry", "ms_raster", "ms_shade", "ms_resolve", "ms_total")


class Drawing:
    """Draws frames of a workload.

    Parameters
    ----------
    workload : Workload
    size : (int, int)
    backend, threads, samples
        As for `Renderer`.
    options
        Beside those of the workload, for `Renderer.render`.
    """

    def __init__(
        self, workload: Workload, size, backend="auto", threads=0, samples=1, **options
    ) -> None:
        self.workload = workload
        self.renderer = Renderer(
            size,
            backend=backend,
            threads=threads,
            samples=samples,
            color_space=workload.color_space,
        )
        self._options = {"cull": "back", **workload.options, **options}

    def draw(self, frame: int) -> np.ndarray:
        """Draw a frame and return its output."""
        workload = self.workload
        drawn = self.renderer.render(workload.scene, workload.view(frame), **self._options)
        self.stats = drawn.stats
        return getattr(drawn, workload.output)

    def close(self) -> None:
        self.renderer.close()


class Timer:
    """Times the frames of an object with a method ``draw(frame)``.

    Attributes
    ----------
    milliseconds : list of float
        Of each frame timed.
    stages : list of dict
        The statistics of each, where there are any.
    picture : array
        The last that was drawn.
    """

    def __init__(self, drawing) -> None:
        self._drawing = drawing
        self._frame = 0
        self.milliseconds: list[float] = []
        self.stages: list[dict] = []

    def one(self) -> float:
        """Draw a frame; return its time in milliseconds."""
        self._frame += 1
        start = time.perf_counter()
        picture = self._drawing.draw(self._frame)
        taken = 1e3 * (time.perf_counter() - start)
        self.picture = picture  # the previous one is freed only now, as in real programs
        return taken

    def warm_up(self) -> bool:
        """Draw two frames; return whether the second already is the result, because it was slow."""
        self.one()
        second = self.one()
        if second > SLOW:
            self._keep(second)
        return second > SLOW

    def run(self, seconds: float, least: int = LEAST) -> float:
        """Time frames for a while; return their median."""
        begun, deadline = len(self.milliseconds), time.perf_counter() + seconds
        count = 0
        while count < least or (time.perf_counter() < deadline and count < MOST):
            self._keep(self.one())
            count += 1
        return statistics.median(self.milliseconds[begun:])

    def _keep(self, milliseconds: float) -> None:
        self.milliseconds.append(milliseconds)
        self.stages.append(getattr(self._drawing, "stats", None) or {})

    @property
    def median(self) -> float:
        return statistics.median(self.milliseconds)


def measure(workload: Workload, size, backend="auto", threads=0, seconds: float = 1.0) -> dict:
    """Return the figures of a workload for one backend and number of threads.

    Returns
    -------
    dict
        ``workload``, ``backend``, ``threads``, ``frames``, ``milliseconds`` per frame, those of the
        stages (``ms_geometry`` …), ``triangles_per_second``, ``pixels_per_second``.
    """
    drawing = Drawing(workload, size, backend, threads)
    try:
        timer = Timer(drawing)
        if not timer.warm_up():
            timer.run(seconds)
    finally:
        drawing.close()
    return figures(workload, size, timer)


def figures(workload: Workload, size, timer: Timer) -> dict:
    """Return the row of figures of a timer of a `Drawing`, as `measure` does."""
    stages = {name: statistics.median(one[name] for one in timer.stages) for name in STAGES}
    last, taken = timer.stages[-1], timer.median
    return {
        "workload": workload.name,
        "backend": last["backend"],
        "threads": last["threads"],
        "frames": len(timer.milliseconds),
        "milliseconds": taken,
        **stages,
        "triangles": workload.triangles,
        "triangles_per_second": 1e3 * workload.triangles / taken,
        "pixels_per_second": 1e3 * size[0] * size[1] / taken,
    }
