/* Projected pieces of primitives, which become records. */
#pragma once

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
    int alpha; /* the list that it goes to (e3d_alpha_kind) */
    e3d_cull cull;
    int mirrored;
} e3d_primitive;
int e3d_project(const float v[4], int clipped, const e3d_viewport *viewport, e3d_corner *out);
/* Makes a record of a piece that shows, and bins it, unless records are sorted first. */
void e3d_emit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_corner corner[3], const e3d_primitive *primitive);
/* The chains of a set in which records of a kind of alpha are listed. */
e3d_chains *e3d_chains_of(e3d_record_set *set, int alpha);

/* Whether there are IDs and memory for `more` records. */
int e3d_records_fit(e3d_record_set *set, int id_bits, size_t more);
