/* The rows of sites, every second pixel of every second row, on which the kernels of ambient occlusion work. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "e3d_occlusion.h"

enum { E3D_OCCLUSION_HALF = 1 << E3D_OCCLUSION_QUADRANT };

/* Numbers for the sites of a row, repeated from a multiple of the cell's side on. */
typedef float e3d_occlusion_lanes[E3D_OCCLUSION_CELL + E3D_PAD];

/* The pattern of one row of a cell. */
typedef struct e3d_occlusion_pattern {
    e3d_occlusion_lanes step[2];                      /* in sites, times the distance of a place */
    e3d_occlusion_lanes side[2];                      /* the same direction in view space, of unit length */
    e3d_occlusion_lanes share[2][E3D_OCCLUSION_TAPS]; /* of the reach, to either side */
    e3d_occlusion_lanes range2;                       /* the square of the greatest distance that counts */
} e3d_occlusion_pattern;

typedef struct e3d_occlusion_plan {
    const e3d_depth_picture *picture;
    e3d_occlusion_pattern rows[E3D_OCCLUSION_CELL];
    int32_t width, height;    /* in sites */
    const float *depth;       /* of sites: the first of row 0; rows are `pitch` floats apart */
    int32_t pitch;
    float across[2], down[2]; /* as the picture's, but from site to site */
    float side;               /* the height of a site at a depth of 1; without perspective, at any depth */
    float reach;              /* sites at a nearness of 1; without perspective, at any nearness */
    float radius;             /* within which things hide light, and their thickness */
    /* The light of sets of sectors, of either right angle: what leans in the high half, what faces in the low one */
    int32_t light[2][E3D_OCCLUSION_HALF];
} e3d_occlusion_plan;

/* A row of sites, with E3D_PAD zeros before and after; a row outside the picture is 0. */
typedef struct e3d_occlusion_sites {
    float *depth, *near; /* near: nearness */
    float *change[2];    /* of nearness over the face: from site to site along the row, and from row to row */
    float *firm;         /* turns a change of nearness into a distance from the face, in sites */
    float *share;        /* of light that is hidden, or the mean of such shares */
} e3d_occlusion_sites;
