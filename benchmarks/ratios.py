"""How many times as fast one way of drawing is as another: what stays when times change.

In:  the installed engine3d; for the ratios over llvmpipe also moderngl and Mesa.
Out: RATIOS, and `measure`: name -> how many times as fast the better way is, and how far the
     rounds of the measurement lie apart.

Both ways draw the same scenes in turns, a frame each, and the median of the rounds' ratios counts.
With one thread it is the process's CPU time, which other programs lengthen little.
"""

import statistics
import time
from dataclasses import dataclass, field

import llvmpipe

import engine3d as e3d
from engine3d.apps.bench import measuring
from engine3d.apps.scenes import workloads

SIZE = (1280, 720)
LEAST_ROUNDS = 5


@dataclass(frozen=True)
class Way:
    """One way of drawing a workload."""

    workload: str
    backend: str = "auto"
    threads: int = 1
    plain: bool = False
    options: dict = field(default_factory=dict)

    def drawing(self, size):
        made = workloads.make(self.workload, self.plain)
        return measuring.Drawing(made, size, self.backend, self.threads, **self.options)


@dataclass(frozen=True)
class Ratio:
    """How many times as fast `better` is as `other`; None is llvmpipe."""

    name: str
    better: Way
    other: Way | None
    quick: bool = False


def _backends():
    quick = ("textured", "fill-back")
    for workload in ("textured", "mesh", "fill-back", "city-street", "spheres-inside"):
        for backend in ("sse41", "avx2", "avx512"):
            yield Ratio(
                f"{workload}: {backend} over portable",
                Way(workload, backend),
                Way(workload, "portable"),
                workload in quick and backend == "avx2",
            )
    for workload in quick:
        better, other = Way(workload, "portable"), Way(workload, "scalar")
        yield Ratio(f"{workload}: portable over scalar", better, other)


def _options():
    forward = Way("city-lights", options={"shading": "forward"})
    yield Ratio("city-lights: deferred over forward", Way("city-lights"), forward)
    yield Ratio(
        "fill-back: deferred over forward",
        Way("fill-back", options={"mode": "lit"}),
        Way("fill-back", options={"mode": "lit", "shading": "forward"}),
        True,
    )
    for workload in ("spheres-inside", "city-street", "city-above"):
        everything = Way(workload, options={"culling": "none"})
        name = f"{workload}: culling over none"
        yield Ratio(name, Way(workload), everything, workload == "spheres-inside")
    nodes = Way("city-street", options={"culling": "tree"})
    yield Ratio("city-street: culling over that of nodes alone", Way("city-street"), nodes)
    for workload in ("textured", "city-street", "fill-front"):
        name = f"{workload}: default picture over plain"
        yield Ratio(name, Way(workload), Way(workload, plain=True), workload == "textured")

    several = ("color", "depth", "normal", "instance_id")
    for workload in ("textured", "mesh"):
        plain = Way(workload)
        name = f"{workload}: four outputs over color"
        yield Ratio(name, Way(workload, options={"outputs": several}), plain)
        name = f"{workload}: 4 samples over 1"
        yield Ratio(name, Way(workload, options={"samples": 4}), plain)


def _threads():
    for workload in ("mesh", "grid", "city-above", "fill-back"):
        better, other = Way(workload, threads=2), Way(workload, threads=1)
        yield Ratio(f"{workload}: 2 threads over 1", better, other, workload == "mesh")


def _peer():
    for workload in ("textured", "mesh", "grid", "city-street", "fill-front", "spheres-inside"):
        better = Way(workload, threads=0, plain=True)
        yield Ratio(f"{workload}: engine3d over llvmpipe", better, None, workload == "textured")


RATIOS = [*_backends(), *_options(), *_threads(), *_peer()]


def possible(ratio, available, peer):
    """Whether this machine can measure a ratio."""
    ways = [way for way in (ratio.better, ratio.other) if way is not None]
    if ratio.other is None and not peer:
        return False
    return all(way.backend == "auto" or way.backend in available for way in ways)


def peer_is_there():
    """Whether llvmpipe can be measured."""
    try:
        llvmpipe.open_context().release()
    except e3d.Engine3DError:
        return False
    return True


def measure(ratio, seconds, size=SIZE):
    """Return {"ratio", "spread"}: the median of the rounds, their interquartile range over it."""
    better = ratio.better.drawing(size)
    if ratio.other is None:
        other = llvmpipe.Peer(better.workload, size)
    else:
        other = ratio.other.drawing(size)
    one_thread = all(way is not None and way.threads == 1 for way in (ratio.better, ratio.other))
    clock = time.process_time if one_thread else time.perf_counter
    try:
        return summary(list(_rounds(better, other, clock, seconds)))
    finally:
        better.close()
        other.close()


def _rounds(better, other, clock, seconds):
    """Yield a ratio a round: a frame each, the first of the two in turns."""
    for frame in range(2):
        better.draw(frame), other.draw(frame)
    end = time.perf_counter() + seconds
    frame = 2
    while frame < 2 + LEAST_ROUNDS or time.perf_counter() < end:
        taken = {}
        for drawing in (better, other) if frame % 2 else (other, better):
            start = clock()
            drawing.draw(frame)
            taken[drawing] = clock() - start
        yield taken[other] / taken[better]
        frame += 1


def summary(ratios):
    """Return the median and the relative spread of the rounds' ratios."""
    median = statistics.median(ratios)
    low, _, high = statistics.quantiles(ratios, n=4)
    return {"ratio": median, "spread": (high - low) / median}
