"""The list of all passes: which ones a picture needs, their order, and their shared arrays.

In: the options and outputs of a picture. Out: its passes, drawn one after the other. Passes reuse
their arrays from frame to frame.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from .. import options as limits
from .._frame_memory import Use
from .._output_pool import OutputPool, Shapes, shapes_of
from ..frame import OUTPUTS
from ..options import RenderOptions
from .ambient_occlusion import AmbientOcclusion
from .bloom import Bloom
from .exact_shadows import ExactShadows
from .mirrors import Mirrors
from .output_passes import SURFACE, ColorPass, SurfacePass
from .protocol import Pass, Tools
from .refraction import Refraction
from .shadow_maps import ShadowMaps

_MAX_KEPT = 16  # for programs that alternate between kinds of pictures
Arrays: TypeAlias = dict[str, np.ndarray]
#: All passes, in drawing order.
PASSES: tuple[type[Pass], ...] = (
    ShadowMaps,
    ExactShadows,
    SurfacePass,
    AmbientOcclusion,
    Mirrors,
    Refraction,
    ColorPass,
    Bloom,
)


class Plan(NamedTuple):
    """The plan of all pictures with the same options, outputs and size."""

    passes: list[Pass]
    listed: tuple[str, ...]  # outputs that the draw list is made for
    outputs: Shapes  # the frame's outputs
    others: Shapes  # outputs that passes read but the frame lacks
    arrays: Shapes  # other arrays of the passes
    uses: list[Use]  # memory that passes use


def plan_of(
    passes: list[Pass], options: RenderOptions, outputs: tuple[str, ...], size: tuple[int, int]
) -> Plan:
    """Return the passes that a picture needs, and their arrays."""
    chosen: list[Pass] = []
    wanted = set(outputs)
    for one in reversed(passes):
        if one.is_in(options, wanted):
            chosen.insert(0, one)
            wanted.update(one.reads)
    others = sorted(wanted.intersection(OUTPUTS).difference(outputs))
    surfaces = {name.removeprefix(SURFACE) for name in wanted.intersection(SurfacePass.writes)}
    listed = *outputs, *others, *sorted(surfaces.difference(outputs, others))
    plan = Plan(chosen, listed, shapes_of(outputs, *size), shapes_of(others, *size), {}, [])
    uncounted = dict(plan.others)
    for one in chosen:
        _add_arrays(plan, one, size, uncounted)
    return plan


def _add_arrays(plan: Plan, one: Pass, size: tuple[int, int], uncounted: Shapes) -> None:
    """Add the arrays and memory of a pass; passes that read the same array share it."""
    surfaces = {
        name: shapes_of((name.removeprefix(SURFACE),), *size).popitem()[1]
        for name in one.reads
        if name.startswith(SURFACE)
    }
    arrays = one.arrays(*size) | surfaces
    counted = [form for name, form in arrays.items() if name not in plan.arrays]
    counted += [uncounted.pop(name) for name in one.reads if name in uncounted]
    if counted:
        bytes_of = (dtype.itemsize * math.prod(shape) for shape, dtype in counted)
        plan.uses.append(Use(sum(bytes_of), one.name, one.advice))
    plan.arrays.update(arrays)


class Passes:
    """The passes of one renderer."""

    def __init__(self, tools: Tools) -> None:
        self._memory = tools.memory
        self._all = [make(tools) for make in PASSES]
        self._pool = OutputPool()
        # By identity of options and the other inputs: these, the plan, and its total memory.
        self._plans: dict[tuple[object, ...], tuple[RenderOptions, Plan, list[Use]]] = {}

    def plan(self, options: RenderOptions, outputs: tuple[str, ...], size: tuple[int, int]) -> Plan:
        """Return the plan of a picture, and check its memory.

        Raises
        ------
        InvalidArgumentError
            The plan exceeds a frame's memory limit.
        """
        key = id(options), outputs, size, limits.MAX_FRAME_BYTES
        kept = self._plans.get(key)
        if kept is None or kept[0] is not options:
            plan = plan_of(self._all, options, outputs, size)
            kept = options, plan, self._memory.check(outputs, size, plan.uses)
            if len(self._plans) >= _MAX_KEPT:
                self._plans.clear()
            self._plans[key] = kept
        _, plan, uses = kept
        self._memory.begin(size, uses)
        return plan

    def arrays(self, plan: Plan, outputs: Arrays) -> tuple[Arrays, Arrays]:
        """Return the arrays that colours are drawn into, and all other arrays."""
        if not plan.uses:
            return outputs, {}
        taken = self._pool.take(plan.others | plan.arrays)
        return outputs | {name: taken.pop(name) for name in plan.others}, taken

    def forget(self) -> None:
        """Free unused arrays."""
        self._pool.forget()
        for one in self._all:
            one.forget()
