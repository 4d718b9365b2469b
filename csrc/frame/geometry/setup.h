/* Projected pieces of primitives, which become records. */
#ifndef E3D_SETUP_H
#define E3D_SETUP_H

#include <stddef.h>

#include "e3d.h"
#include "kernels/types/vertices.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"

typedef struct e3d_corner {
    int32_t x, y;
    float zn, iw;
    float c[3];
} e3d_corner;
typedef struct e3d_primitive {
    uint32_t order;
    int set, face, cut;
    int alpha; /* which list it goes to (e3d_alpha_kind) */
    e3d_cull cull;
    int mirrored;
} e3d_primitive;
int e3d_project(const float v[4], int clipped, const e3d_viewport *viewport, e3d_corner *out);
/* Makes a record of a piece that shows, and bins it where records aren't sorted first. */
void e3d_emit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_corner corner[3], const e3d_primitive *primitive);
/* The bins of a set where records of such an alpha are listed. */
e3d_chains *e3d_chains_of(e3d_record_set *set, int alpha);

/* Whether `more` records have IDs and memory. */
int e3d_records_fit(e3d_record_set *set, int id_bits, size_t more);

#endif
