/* What shows in a tile, primitive by primitive, and what each brings to its samples. */
#ifndef E3D_SURFACE_H
#define E3D_SURFACE_H

#include "e3d.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/shade.h"

/* Samples that are shaded by the same steps: all before `first` tells which. */
typedef struct e3d_bucket {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance, unshadowed;
    int8_t mapped;                          /* by more than a texture of the base colour at the mesh's own coordinates: maps.h */
    int8_t has_uvs, has_uvs1, has_tangents; /* of mapped ones */
    int8_t transmits;                       /* R133 */
    int8_t lit, hidden;                     /* light falls on it; faces that a wireframe leaves out */
    int32_t first, last; /* of its visible pieces */
} e3d_bucket;

/* A piece that shows in a tile, and its samples, or its runs (e3d_shown). */
typedef struct e3d_visible_primitive {
    const e3d_record *record;       /* or NULL: */
    const e3d_drawn_cluster *drawn; /* the piece is of fragments */
    const float *corners;           /* c[k][j] of a cut record, or NULL */
    const e3d_draw_state *draw;
    int32_t instance, local; /* in its draw, in its instance */
    int32_t vertex[3];       /* of the mesh; as many as there are */
    int32_t bucket, next;     /* the next of the same bucket, or -1 */
    int32_t first, end;
} e3d_visible_primitive;

/* What interpolation must fill for a texture of a base colour or an alpha (E3D_WANT_*). */
int e3d_texture_wanted(const e3d_texture_view *view);
/* The pieces of what shows, chained by bucket; 0 when memory is out. */
int e3d_find_pieces(const e3d_shade_in *in, e3d_shade_memory *memory);
/* The surfaces of pieces of a bucket from `first` on, without what e3d_find_surfaces adds; the first piece that is left, or -1. */
int32_t e3d_add_surfaces(const e3d_shade_in *in, const e3d_bucket *bucket, int32_t first, int wanted, e3d_shade_memory *memory);
void e3d_find_surfaces(const e3d_prepared *pass, const e3d_tile *tile, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory);

#endif
