/* The preparation of a pass, before anything is drawn. */
#pragma once

#include "e3d.h"
#include "frame/cull/history.h"
#include "frame/run/renderer.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"
#include "frame/store/store.h"
#include "frame/tile/job.h"

/* Everything that the stages read; the frame hands it to them. */
typedef struct e3d_context {
    e3d_renderer *renderer; /* its memory is written by the stages */
    e3d_prepared pass;
    e3d_history *history;
    e3d_store store;
    e3d_shade_in shade;
    e3d_tiles_in tiles;
} e3d_context;

/* Prepares a pass, and the renderer's memory for it. */
e3d_status e3d_prepare(e3d_renderer *renderer, const e3d_pass *asked, e3d_context *out);
