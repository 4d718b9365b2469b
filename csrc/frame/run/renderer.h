/* A renderer: its threads, and the memory that its stages keep from frame to frame. */
#pragma once

#include "base/grow.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "frame/cast/casters.h"
#include "frame/cull/cull.h"
#include "frame/cull/history.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/view.h"
#include "frame/store/queue.h"
#include "frame/tile/job.h"
#include "frame/tile/kept.h"
#include "frame/tile/memory.h"

/* A thread. Each stage has a pointer to its own part of all threads. */
typedef struct e3d_worker {
    e3d_cull_state cull;
    e3d_geometry_memory geometry;
    e3d_queue_state queue;
    e3d_tile_memory tile;
} e3d_worker;

typedef struct e3d_renderer {
    e3d_backend backend;
    int32_t threads;
    const e3d_kernels *kernels;
    e3d_worker **workers;
    e3d_draws draws;
    e3d_view view;
    e3d_view frozen; /* the view of a camera that stands still while another camera draws what it sees */
    e3d_cull_memory cull;
    e3d_histories histories;
    e3d_bins bins;
    e3d_tiles_out tiles;
    e3d_kept_memory kept;
    e3d_caster_memory casters;
    e3d_array marks;         /* a byte for each instance: E3D_MARK_UNOCCLUDED, E3D_MARK_DRAWN */
    e3d_array tile_progress; /* e3d_tile_progress */
    e3d_array gradient;      /* uint32_t[E3D_DITHER] for each row of the picture */
    e3d_poll poll;
} e3d_renderer;
