"""The core's insides for tests and benchmarks; the engine itself never imports it.

Out: addresses of kernels and functions, which tests/kernels/ calls as the C headers declare them;
     the rules of a frame's plan; the calling thread's floating-point control register.
Always: nothing is checked here. The kernels that repeat are for one thread at a time.
"""

from libc.stdint cimport uint64_t, uintptr_t

from e3d cimport *

cdef extern from *:
    """
    #include "core/helping.h"
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

cdef extern from "pipeline/pass/plan.h" nogil:
    ctypedef enum e3d_plan_item:
        E3D_PLAN_FIRST
        E3D_PLAN_ITEMS

    ctypedef struct e3d_plan_rule:
        e3d_plan_item item
        uint64_t all
        uint64_t none

    const e3d_plan_rule E3D_PLAN_RULES[]
    const int E3D_PLAN_RULE_COUNT
    const char *e3d_plan_name(e3d_plan_item item)
    const char *e3d_plan_text(e3d_plan_item item)

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


def plan_rules() -> list[tuple[str, list[str], list[str]]]:
    """The rules of a frame's plan: (item, the items that it needs, those that it must not have).

    Each item is named, and has its meaning in plan_items().
    """
    cdef const e3d_plan_rule *rule

    def names(bits):
        return [e3d_plan_name(<e3d_plan_item>k).decode() for k in range(E3D_PLAN_ITEMS) if bits >> k & 1]

    rules = []
    for r in range(E3D_PLAN_RULE_COUNT):
        rule = &E3D_PLAN_RULES[r]
        rules.append((e3d_plan_name(rule.item).decode(), names(rule.all), names(rule.none)))
    return rules


def plan_items() -> list[tuple[str, str, bool]]:
    """What may be asked for and what is planned, in their order: (name, meaning, is planned)."""
    return [
        (
            e3d_plan_name(<e3d_plan_item>k).decode(),
            e3d_plan_text(<e3d_plan_item>k).decode(),
            k >= E3D_PLAN_FIRST,
        )
        for k in range(E3D_PLAN_ITEMS)
    ]


def dfg_table(int kind) -> list[list[float]]:
    """A table of albedos: `E3D_DFG_SIZE` rows of as many numbers."""
    return [[E3D_DFG_TABLE[kind][E3D_DFG_SIZE * i + j] for j in range(E3D_DFG_SIZE)] for i in range(E3D_DFG_SIZE)]


include "float_control.pxi"
