/* A prepared pass: everything that stays constant while it is drawn. */
#pragma once

#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/bending.h"
#include "kernels/types/casters.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"

typedef struct e3d_prepared {
    const e3d_kernels *kernels;
    int32_t threads;
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_plan plan;
    const e3d_draws *draws; /* geometry finishes some instances, here and in the view */
    const e3d_view *view;
    const e3d_caster_index *casters; /* the casters, if lights have exact shadows */
    e3d_behind_view behind;            /* the picture behind glass, if there is one */
    const e3d_sample_pattern *pattern; /* the sample pattern; NULL: no multisampling */
    const e3d_view *frustum; /* the view whose frustum decides what is drawn: `view` itself, or that of a frozen camera */
} e3d_prepared;

static inline int e3d_plans(const e3d_prepared *pass, e3d_plan_item item) { return e3d_plan_has(pass->plan, item); }
