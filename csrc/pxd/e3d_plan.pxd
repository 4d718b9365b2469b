# The Cython mirror of csrc/pipeline/pass/plan.h, for its test and its table in the docs.

from libc.stdint cimport uint64_t

cdef extern from "pipeline/pass/plan.h" nogil:
    ctypedef uint64_t e3d_plan
    ctypedef enum e3d_plan_item:
        E3D_PLAN_FIRST
        E3D_PLAN_ITEMS

    ctypedef struct e3d_plan_rule:
        e3d_plan_item item
        e3d_plan all
        e3d_plan none

    const e3d_plan_rule E3D_PLAN_RULES[]
    const int E3D_PLAN_RULE_COUNT

    const char *e3d_plan_name(e3d_plan_item item)
    const char *e3d_plan_text(e3d_plan_item item)
