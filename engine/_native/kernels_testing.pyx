"""The core's insides for tests and benchmarks; the engine itself never imports it.

Out: addresses of kernels and functions, which tests/kernels/ calls as the C headers declare them;
     the conditions of a frame's plan; the calling thread's floating-point control register.
Always: nothing is checked here. The kernels that repeat are for one thread at a time.
"""

from libc.stdint cimport uint64_t, uintptr_t

from e3d cimport *

cdef extern from *:
    """
    #include "base/helping.h"
    #include "e3d_posing.h"
    #include "kernels/kernels.h"

    static const e3d_kernels *repeated_table;
    static int repeated_rounds;
    #include "kernel_rounds.inl"
    #define E3D_KERNEL(type, name, parameters) .name = rounds_##name,
    static const e3d_kernels repeated_kernels = {
    #include "kernels/each_kernel.inl"
    };
    """
    ctypedef struct e3d_kernels:
        pass

    const e3d_kernels *e3d_kernels_for(e3d_backend backend)
    const e3d_kernels *repeated_table
    int repeated_rounds
    const e3d_kernels repeated_kernels
    void e3d_helping_note()
    void e3d_reference_pose()

cdef extern from "frame/pass/plan.h" nogil:
    ctypedef enum e3d_asked_item:
        E3D_ASKED_ITEMS
    ctypedef enum e3d_plan_item:
        E3D_PLAN_ITEMS
    ctypedef struct e3d_plan_condition:
        e3d_plan_item item
        uint64_t asked, planned, unless_asked, unless_planned
    ctypedef struct e3d_plan_word:
        const char *name
        const char *text
    const e3d_plan_condition E3D_PLAN_CONDITIONS[]
    const int E3D_PLAN_CONDITION_COUNT
    const e3d_plan_word E3D_ASKED_WORDS[]
    const e3d_plan_word E3D_PLAN_WORDS[]

# Functions of the core by their names.
ADDRESSES = {
    "e3d_environment_create": <uintptr_t>&e3d_environment_create,
    "e3d_environment_destroy": <uintptr_t>&e3d_environment_destroy,
    "e3d_helping_note": <uintptr_t>&e3d_helping_note,
    "e3d_mesh_create": <uintptr_t>&e3d_mesh_create,
    "e3d_mesh_destroy": <uintptr_t>&e3d_mesh_destroy,
    "e3d_reference_pose": <uintptr_t>&e3d_reference_pose,
}
# The table of kernels of which each calls another several times, as `repeat` says.
REPEATED = <uintptr_t>&repeated_kernels


def kernels(int backend) -> int:
    """The address of the table of kernels of a backend, by the number of `rasterizer.BACKENDS`.

    Raises
    ------
    LookupError
        This build or CPU has no such kernels.
    """
    table = <uintptr_t>e3d_kernels_for(<e3d_backend>backend)
    if not table:
        raise LookupError("this build or CPU lacks the backend")
    return table


def repeat(int backend, int rounds):
    """Let each kernel of `REPEATED` call that of a backend so often."""
    global repeated_table, repeated_rounds
    repeated_table, repeated_rounds = e3d_kernels_for(<e3d_backend>backend), rounds


def plan_conditions() -> list[tuple[str, list[str], list[str]]]:
    """The conditions of a frame's plan: (item, the items that it needs, those that it must not have).

    Each item is named, and has its meaning in asked_items() or planned_items().
    """
    cdef const e3d_plan_condition *condition
    asked, planned = asked_items(), planned_items()

    def names(items, bits):
        return [name for k, (name, _) in enumerate(items) if bits >> k & 1]

    conditions = []
    for r in range(E3D_PLAN_CONDITION_COUNT):
        condition = &E3D_PLAN_CONDITIONS[r]
        needs = names(asked, condition.asked) + names(planned, condition.planned)
        forbids = names(asked, condition.unless_asked) + names(planned, condition.unless_planned)
        conditions.append((planned[<int>condition.item][0], needs, forbids))
    return conditions


def asked_items() -> list[tuple[str, str]]:
    """What may be asked for, in the order of its bits: (name, meaning)."""
    return [(E3D_ASKED_WORDS[k].name.decode(), E3D_ASKED_WORDS[k].text.decode()) for k in range(<int>E3D_ASKED_ITEMS)]


def planned_items() -> list[tuple[str, str]]:
    """What is planned, in the order of its bits: (name, meaning)."""
    return [(E3D_PLAN_WORDS[k].name.decode(), E3D_PLAN_WORDS[k].text.decode()) for k in range(<int>E3D_PLAN_ITEMS)]


def dfg_table(int kind) -> list[list[float]]:
    """A table of albedos: `E3D_DFG_SIZE` rows of as many numbers."""
    return [[E3D_DFG_TABLE[kind][E3D_DFG_SIZE * i + j] for j in range(E3D_DFG_SIZE)] for i in range(E3D_DFG_SIZE)]


include "float_control.pxi"
