# The Cython mirror of csrc/pipeline/pass/plan.h, for its test and its table in the docs.

from libc.stdint cimport uint64_t

cdef extern from "pipeline/pass/plan.h" nogil:
    enum:
        E3D_ASKED_ITEMS
        E3D_PLAN_ITEMS

    ctypedef struct e3d_plan_rule:
        int item
        uint64_t asked
        uint64_t planned
        uint64_t unless_asked
        uint64_t unless_planned

    const e3d_plan_rule E3D_PLAN_RULES[]
    const int E3D_PLAN_RULE_COUNT

    ctypedef struct e3d_plan_word:
        const char *name
        const char *text

    const e3d_plan_word E3D_ASKED_WORDS[]
    const e3d_plan_word E3D_PLAN_WORDS[]
