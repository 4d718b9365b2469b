/* Triangles as structure of arrays, and their areas, four at a time. */
#pragma once

#include "base/limits.h"
#include "base/vectors.h"

/* corner[k][axis][t] of up to E3D_CLUSTER_TRIANGLES triangles. */
typedef struct e3d_triangles {
    float corner[3][3][E3D_CLUSTER_TRIANGLES];
} e3d_triangles;

typedef struct e3d_areas {
    float4 normal[3]; /* its length is twice the area */
    float4 square;    /* of twice the area */
    float4 longest;   /* the longest edge, squared */
} e3d_areas;

/* The areas of triangles t to t + 3, whose edges are first multiplied by `scale`. Numbers that float32 cannot square become
 * infinite or NaN. */
static inline e3d_areas e3d_areas_of(const e3d_triangles *in, int t, float scale)
{
    e3d_areas out;
    float4 a[3], b[3], aa = splat(0), bb = aa, cc = aa;
    for (int k = 0; k < 3; k++) {
        a[k] = (load4(in->corner[1][k] + t) - load4(in->corner[0][k] + t)) * splat(scale);
        b[k] = (load4(in->corner[2][k] + t) - load4(in->corner[0][k] + t)) * splat(scale);
        float4 c = a[k] - b[k];
        aa += a[k] * a[k];
        bb += b[k] * b[k];
        cc += c * c;
    }
    out.longest = more_of(more_of(aa, bb), cc);
    out.normal[0] = a[1] * b[2] - a[2] * b[1];
    out.normal[1] = a[2] * b[0] - a[0] * b[2];
    out.normal[2] = a[0] * b[1] - a[1] * b[0];
    out.square = out.normal[0] * out.normal[0] + out.normal[1] * out.normal[1] + out.normal[2] * out.normal[2];
    return out;
}
