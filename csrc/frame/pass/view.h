/* An eye: everything in a pass that depends on where it is seen from. */
#pragma once

#include <stdint.h>

#include "base/grow.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/types/fog.h"
#include "kernels/types/shading.h"
#include "kernels/types/vertices.h"
#include "frame/pass/draws.h"

/* An instance as the eye sees it (R1, R2). */
typedef struct e3d_view_instance {
    float clip[16];
    int32_t shows;    /* its mesh's box may be in view */
    int32_t ready;    /* more than its clip matrix is known */
    int32_t mirrored; /* either its own matrix or the camera's mirrors, not both */
    e3d_facing facing;
} e3d_view_instance;

/* A tile's place in the picture. */
typedef struct e3d_tile {
    int32_t x, y;          /* first sample */
    int32_t width, height; /* the samples inside the viewport */
} e3d_tile;

typedef struct e3d_view {
    e3d_viewport viewport;
    int32_t tiles_x, tiles_y; /* the grid of tiles */
    e3d_box apertures[E3D_MAX_APERTURES]; /* in samples: backs that reach into one are not culled (R9) */
    int32_t aperture_count;
    float rows[12];           /* the rows of view_from_world, in f32 */
    int mirrors;              /* the camera mirrors: R2 */
    e3d_lighting lighting, unshadowed; /* unshadowed: for surfaces that receive no shadows */
    e3d_fog_view fog[2]; /* for colours that are not lit, and for lit ones */
    e3d_view_instance *instances;
    e3d_array instance_memory, reach_memory;
} e3d_view;

/* Finds the view of draws that have their places. The instances that `frustum` shows are drawn; it is the same view, or one that
 * is prepared already. Returns 0 when memory is out. */
int e3d_view_prepare(e3d_view *view, const e3d_view *frustum, const double clip_from_world[16], e3d_draws *draws, const e3d_frame *frame,
                     int threads);
/* Finds what drawing an instance needs besides its clip matrix, here and in the draws. */
void e3d_view_finish_instance(e3d_view *view, e3d_draws *draws, uint32_t number);
void e3d_view_free(e3d_view *view);

/* The lights, with or without their shadows. */
static inline const e3d_lighting *e3d_lighting_of(const e3d_view *view, int unshadowed)
{
    return unshadowed ? &view->unshadowed : &view->lighting;
}

/* Whether a box of samples reaches into an aperture. */
static inline int e3d_meets_aperture(const e3d_view *view, const e3d_box *box)
{
    for (int32_t i = 0; i < view->aperture_count; i++) {
        const e3d_box *aperture = &view->apertures[i];
        if (box->x0 <= aperture->x1 && box->x1 >= aperture->x0 && box->y0 <= aperture->y1 && box->y1 >= aperture->y0)
            return 1;
    }
    return 0;
}

static inline int64_t e3d_tile_count(const e3d_view *view) { return (int64_t)view->tiles_x * view->tiles_y; }

static inline e3d_tile e3d_tile_at(const e3d_view *view, int64_t number)
{
    e3d_tile tile = {.x = (int32_t)(number % view->tiles_x) * E3D_TILE, .y = (int32_t)(number / view->tiles_x) * E3D_TILE};
    int32_t width = view->viewport.width - tile.x, height = view->viewport.height - tile.y;
    tile.width = width < E3D_TILE ? width : E3D_TILE;
    tile.height = height < E3D_TILE ? height : E3D_TILE;
    return tile;
}
