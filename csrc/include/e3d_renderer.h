/* Drawing: a renderer takes frames and fills targets. */
#pragma once

#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_frame.h"
#include "e3d_status.h"
#include "e3d_targets.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_stats {
    int64_t draws;              /* the frame's, of which a node may have several */
    int64_t instances;          /* submitted; plain meshes count as one each */
    int64_t instances_drawn;    /* of these, those with a cluster that is drawn, or with lines or points */
    int64_t clusters, triangles; /* submitted */
    /* Each of these is at most the one before it. If a whole group of clusters is occluded, all of its clusters count as in the
     * frustum. Clusters that face away count as unoccluded, but not as drawn. */
    int64_t clusters_in_frustum, clusters_unoccluded, clusters_drawn;
    int64_t triangles_in_frustum, triangles_unoccluded, triangles_drawn; /* drawn: by a record of the raster, or by edges alone */
    int64_t nodes_unoccluded, nodes_drawn; /* nodes with such a cluster, or with lines or points */
    int64_t clusters_culled;    /* outside the frustum, or facing away */
    int64_t clusters_occluded;  /* behind what was drawn before */
    int64_t triangles_occluded; /* triangles of occluded clusters */
    int64_t triangles_culled;   /* triangles of culled clusters, and those that were rejected before setup */
    int64_t triangles_clipped;
    int64_t triangles_setup;    /* records binned, lines and points included */
    int64_t bin_entries;
    int64_t pixels_shaded;      /* samples that were shaded */
    double ms_geometry;         /* wall clock of cull, transform, clip, setup and bin */
    double ms_raster, ms_shade, ms_resolve; /* sums over threads, divided by the number of threads */
    double ms_total;            /* wall clock */
    double ms_alone;            /* of that, while fewer than two threads worked */
    int32_t threads, tiles, rounds;
    uint64_t plan;              /* the plan of the frame: e3d_plan_step() names its bits */
    e3d_backend backend;
} e3d_stats;

/* The name of a bit of e3d_stats.plan, or NULL behind the last one. docs/plan.md has the conditions. */
const char *e3d_plan_step(int32_t bit);

typedef struct e3d_renderer e3d_renderer;

/* threads: 0 is e3d_thread_count(). */
e3d_status e3d_renderer_create(e3d_backend backend, int32_t threads, e3d_renderer **out);
void e3d_renderer_destroy(e3d_renderer *renderer);
/* Allocates and touches the memory that such frames need where one thing hides another, so that the first frame doesn't wait for
 * pages. planes: 1, or msaa_samples. */
e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height, int32_t planes);
/* The calling thread calls it now and then; a result other than 0 stops the frame between tiles. */
void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *), void *user);
/* stats may be NULL. */
e3d_status e3d_render(e3d_renderer *renderer, const e3d_frame *frame, const e3d_targets *targets,
                      e3d_stats *stats);

/* A pass: one picture of one view. stats may be NULL. */
typedef struct e3d_pass {
    const e3d_frame *frame;
    const e3d_targets *targets;
    e3d_stats *stats;
} e3d_pass;

/* Draws passes one after the other; a pass may read what an earlier one wrote, for example as a texture. If a frame is invalid,
 * nothing is drawn. The first pass that fails is the last. Different views need different numbers (e3d_frame.view). */
e3d_status e3d_render_passes(e3d_renderer *renderer, const e3d_pass *passes, int32_t count);

/* The low-level door. In: vertices in clip space. Out: face_id, ndc depth (smaller is nearer, +inf where empty) and
 * perspective-correct barycentrics. */
e3d_status e3d_rasterize(const float *clip, int32_t vertices, const int32_t *faces, int32_t faces_count,
                         int32_t width, int32_t height, e3d_cull cull, e3d_backend backend, int32_t threads,
                         int32_t *face_id, float *depth, float *barycentric);

/* Triangles in clip space with colours. Blended ones lie over opaque ones and over each other, from far to near; of equal depth, the
 * later lies behind (R83). */
typedef struct e3d_clip_triangles {
    const float *clip;      /* (vertices, 4) */
    const uint8_t *colors;  /* (vertices, 4) straight RGBA */
    const float *uvs;       /* (vertices, 2) or NULL */
    int32_t vertices;
    const int32_t *faces;   /* (faces_count, 3) */
    int32_t faces_count;
    const int32_t *looks;   /* (faces_count,) 0: opaque, 1: blended by alpha, 2 + k: blended, times texture k */
    const e3d_texture *const *textures;
    int32_t texture_count;
} e3d_clip_triangles;

/* Draws them on nothing, without light: colours are mixed as they are. samples: 1, or multisampling's 2, 4, 8, 16.
 * rgba: (height, width, 4), straight alpha. */
e3d_status e3d_draw_clip(const e3d_clip_triangles *drawn, int32_t width, int32_t height, int32_t samples,
                         e3d_backend backend, int32_t threads, uint8_t *rgba);

#ifdef __cplusplus
}
#endif
