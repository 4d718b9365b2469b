/* A pass while it is drawn: the sum of what the stages read, which the frame hands to them. */
#ifndef E3D_CONTEXT_H
#define E3D_CONTEXT_H

#include "pipeline/cull/history.h"
#include "pipeline/frame/renderer.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/shade.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/store.h"
#include "pipeline/tile/tile.h"

typedef struct e3d_context {
    e3d_renderer *renderer; /* its memory is what the stages write */
    e3d_prepared pass;
    e3d_history *history;
    e3d_store store;
    e3d_blank_in blank;
    e3d_shade_in shade;
    e3d_tiles_in tiles;
} e3d_context;

#endif
