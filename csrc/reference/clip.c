/* Clip: rejects primitives that cannot be seen, and clips those that cross the near plane, w = E3D_W_MIN or the guard band.
 * In: the corners of a primitive in clip space.
 * Out: a verdict; the corners that are left, with their barycentrics in the original primitive.
 * Rules: R4 (non-finite), R5 (outcodes), R6 (reject), R7 (cut, in f64).
 * Source: Sutherland and Hodgman, "Reentrant polygon clipping", 1974, in homogeneous space. */
#include <math.h>
#include <string.h>

#include "reference/stages.h"

enum {
    NEAR_BIT = 1,
    FAR_BIT = 2,
    LEFT_BIT = 4,
    RIGHT_BIT = 8,
    BOTTOM_BIT = 16,
    TOP_BIT = 32,
    W_MIN_BIT = 64,
    GUARD_BIT = 128,
    FRUSTUM_BITS = NEAR_BIT | FAR_BIT | LEFT_BIT | RIGHT_BIT | BOTTOM_BIT | TOP_BIT,
    CLIP_BITS = NEAR_BIT | W_MIN_BIT | GUARD_BIT
};

enum { PLANES = 6,
       COMPONENTS = 7 }; /* a cut vertex is x, y, z, w and three barycentrics */

/* The greatest power of two that keeps factor * samples / 2 within E3D_GUARD. */
float ref_guard_factor(int32_t samples)
{
    float factor = 1.0f;
    while (factor * (float)samples <= (float)E3D_GUARD)
        factor *= 2.0f;
    return factor;
}

/* R5 */
static unsigned outcode(const ref_scene *scene, const float p[4])
{
    float x = p[0], y = p[1], z = p[2], w = p[3];
    float gw = scene->guard_x * w, gh = scene->guard_y * w;
    unsigned code = 0;
    code |= z < -w ? NEAR_BIT : 0;
    code |= z > w ? FAR_BIT : 0;
    code |= x < -w ? LEFT_BIT : 0;
    code |= x > w ? RIGHT_BIT : 0;
    code |= y < -w ? BOTTOM_BIT : 0;
    code |= y > w ? TOP_BIT : 0;
    code |= w < E3D_W_MIN ? W_MIN_BIT : 0;
    code |= x > gw || x < -gw || y > gh || y < -gh ? GUARD_BIT : 0;
    return code;
}

static int corner_count(ref_kind kind)
{
    if (kind == REF_FACE)
        return 3;
    return kind == REF_POINT ? 1 : 2;
}

/* R4 and R6 */
ref_verdict ref_test_primitive(const ref_scene *scene, ref_kind kind, const ref_corner *corners)
{
    unsigned any = 0, all = ~0u;
    for (int k = 0; k < corner_count(kind); k++) {
        for (int c = 0; c < 4; c++)
            if (!isfinite(corners[k].position[c]))
                return REF_REJECTED;
        unsigned code = outcode(scene, corners[k].position);
        any |= code;
        all &= code;
    }
    if (kind == REF_POINT)
        return any & (CLIP_BITS | FAR_BIT) ? REF_REJECTED : REF_ACCEPTED;
    if (all & (kind == REF_FACE ? FRUSTUM_BITS : NEAR_BIT | FAR_BIT))
        return REF_REJECTED;
    return any & CLIP_BITS ? REF_NEEDS_CLIPPING : REF_ACCEPTED;
}

/* The distance from a plane; not negative inside. */
static double distance(const ref_scene *scene, int plane, const double v[COMPONENTS])
{
    double gx = (double)scene->guard_x, gy = (double)scene->guard_y;
    switch (plane) {
    case 0: return v[2] + v[3];
    case 1: return v[3] - (double)E3D_W_MIN;
    case 2: return gx * v[3] + v[0];
    case 3: return gx * v[3] - v[0];
    case 4: return gy * v[3] + v[1];
    default: return gy * v[3] - v[1];
    }
}

/* Cuts an edge from its inside to its outside end, so that both primitives of the edge get the same bits. */
static void cut(const double inside[COMPONENTS], double d_inside, const double outside[COMPONENTS],
                double d_outside, double out[COMPONENTS])
{
    double t = d_inside / (d_inside - d_outside);
    for (int c = 0; c < COMPONENTS; c++)
        out[c] = inside[c] + (outside[c] - inside[c]) * t;
}

static void widen(const ref_corner *corner, double out[COMPONENTS])
{
    for (int c = 0; c < 4; c++)
        out[c] = (double)corner->position[c];
    for (int c = 0; c < 3; c++)
        out[4 + c] = (double)corner->barycentric[c];
}

static void narrow(const double v[COMPONENTS], ref_corner *out)
{
    for (int c = 0; c < 4; c++)
        out->position[c] = (float)v[c];
    for (int c = 0; c < 3; c++)
        out->barycentric[c] = (float)v[4 + c];
}

/* Clips at one plane. Returns how many vertices are left, at most count * 3 / 2. */
static int clip_polygon(const ref_scene *scene, int plane, double in[][COMPONENTS], int count,
                        double out[][COMPONENTS])
{
    int left = 0;
    for (int i = 0; i < count; i++) {
        double *a = in[i], *b = in[(i + 1) % count];
        double da = distance(scene, plane, a), db = distance(scene, plane, b);
        if (da >= 0.0)
            memcpy(out[left++], a, sizeof in[0]);
        if (da >= 0.0 && db < 0.0)
            cut(a, da, b, db, out[left++]);
        else if (da < 0.0 && db >= 0.0)
            cut(b, db, a, da, out[left++]);
    }
    return left;
}

/* R7 */
int ref_clip_triangle(const ref_scene *scene, const ref_corner in[3], ref_corner out[REF_MAX_CORNERS])
{
    double polygons[2][REF_MAX_CORNERS][COMPONENTS];
    int count = 3;
    for (int k = 0; k < 3; k++)
        widen(&in[k], polygons[0][k]);
    for (int plane = 0; plane < PLANES; plane++)
        count = clip_polygon(scene, plane, polygons[plane % 2], count, polygons[(plane + 1) % 2]);
    for (int k = 0; k < count; k++)
        narrow(polygons[PLANES % 2][k], &out[k]);
    return count;
}

/* Returns 2, or 0 if nothing is left. */
int ref_clip_line(const ref_scene *scene, const ref_corner in[2], ref_corner out[2])
{
    double a[COMPONENTS], b[COMPONENTS];
    widen(&in[0], a);
    widen(&in[1], b);
    for (int plane = 0; plane < PLANES; plane++) {
        double da = distance(scene, plane, a), db = distance(scene, plane, b);
        if (da < 0.0 && db < 0.0)
            return 0;
        if (db < 0.0)
            cut(a, da, b, db, b);
        else if (da < 0.0)
            cut(b, db, a, da, a);
    }
    narrow(a, &out[0]);
    narrow(b, &out[1]);
    return 2;
}
