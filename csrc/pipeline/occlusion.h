/* Rounds: what the last frames showed is drawn first, and hides what is behind it. */
#ifndef E3D_OCCLUSION_H
#define E3D_OCCLUSION_H

#include "core/mesh.h"
#include "e3d.h"

typedef struct e3d_context e3d_context;

/* A turn of a frame, as the next frame finds it again. */
typedef struct e3d_memory_row {
    const e3d_mesh *mesh;
    int64_t base; /* of its groups */
    int32_t node, first, instances, groups;
} e3d_memory_row;

int e3d_occlusion_pays(const e3d_context *context);
/* After a frame of several rounds: the next ones go without where little was occluded. */
void e3d_occlusion_judge(e3d_context *context, const e3d_stats *stats);
int e3d_occlusion_begin(e3d_context *context);
/* Finds what the last frame of several rounds showed: 1 if it knows of most groups, -1 when memory is out. */
int e3d_remember(e3d_context *context);
/* Draws a round's tiles, and keeps what the next one needs of them; 0 when memory is out. */
int e3d_draw_kept_tiles(e3d_context *context);
/* Whether most tiles can be finished with what the last frames showed. */
int e3d_finishes_early(const e3d_context *context);
/* After the last round's geometry. */
void e3d_count_changed_tiles(e3d_context *context);

#endif
