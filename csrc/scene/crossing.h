/* Where a ray crosses a triangle, in the world: what casting a ray and looking through a lens share.
 *
 * Method: Woop, Benthin and Wald 2013. Along the ray the triangle is flat, and the sign of a difference of two products is right
 * or zero, which counts as inside: no ray slips between neighbours.
 */
#pragma once

#include <math.h>

#include "e3d_scene.h"

typedef struct e3d_crossing {
    double weight[3], sum; /* weight / sum: barycentric */
    double place[3];       /* from the ray's origin */
    double distance;
} e3d_crossing;

/* A ray, and how to look along it: by its greatest axis. */
typedef struct e3d_aim {
    double origin[3], direction[3];
    int along, across, upward;
    double across_slope, upward_slope;
} e3d_aim;

static inline double e3d_dot3(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* The place of a corner of a shape's face at a pose. */
static inline void e3d_place_corner(const e3d_shape *shape, const double world[12], int32_t face, int corner,
                                    double out[3])
{
    const float *p = shape->positions + 3 * (size_t)shape->faces[3 * (size_t)face + corner];
    for (int r = 0; r < 3; r++) {
        const double *m = world + 4 * r;
        out[r] = ((m[0] * p[0] + m[1] * p[1]) + m[2] * p[2]) + m[3];
    }
}

static inline e3d_aim e3d_aim_of(const double origin[3], const double d[3])
{
    e3d_aim aim;
    int along = fabs(d[1]) > fabs(d[0]) ? 1 : 0;
    aim.along = along = fabs(d[2]) > fabs(d[along]) ? 2 : along;
    aim.across = (along + 1) % 3;
    aim.upward = (along + 2) % 3;
    aim.across_slope = d[aim.across] / d[along];
    aim.upward_slope = d[aim.upward] / d[along];
    for (int k = 0; k < 3; k++) {
        aim.origin[k] = origin[k];
        aim.direction[k] = d[k];
    }
    return aim;
}

/* Returns whether the line of the ray crosses the triangle; the distance may be negative. */
static inline int e3d_cross_triangle(const e3d_aim *aim, const double corners[3][3], e3d_crossing *at)
{
    double from[3][3], flat[3][2];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            from[i][k] = corners[i][k] - aim->origin[k];
        flat[i][0] = from[i][aim->across] - aim->across_slope * from[i][aim->along];
        flat[i][1] = from[i][aim->upward] - aim->upward_slope * from[i][aim->along];
    }
    double *weight = at->weight;
    for (int i = 0; i < 3; i++) {
        const double *one = flat[(i + 1) % 3], *two = flat[(i + 2) % 3];
        weight[i] = one[0] * two[1] - one[1] * two[0];
    }
    int plus = weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0;
    int minus = weight[0] <= 0 && weight[1] <= 0 && weight[2] <= 0;
    at->sum = (weight[0] + weight[1]) + weight[2];
    if (!(plus || minus) || at->sum == 0)
        return 0;
    for (int k = 0; k < 3; k++)
        at->place[k] =
            ((weight[0] * from[0][k] + weight[1] * from[1][k]) + weight[2] * from[2][k]) / at->sum;
    at->distance = e3d_dot3(at->place, aim->direction);
    return 1;
}
