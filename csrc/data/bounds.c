/* The box of many points, found at the speed of memory.
 * In: (points, 3) float32. Out: the box of those that are finite.
 * Always: a run of points is bounded twelve floats at a time; only if one of its floats isn't finite, point by point. */
#include "data/bounds.h"

#include "base/vectors.h"
#include "e3d.h"

enum { RUN = 128,
       ROWS = 3 }; /* RUN: points; ROWS: vectors for four points, so that each lane keeps to one axis */

/* Finds the box of a run of points; 0 if one of them isn't finite. */
static int bound_run(const float *p, float lo[3], float hi[3])
{
    float4 least[ROWS], most[ROWS];
    int4 infinite = {0, 0, 0, 0};
    for (int r = 0; r < ROWS; r++)
        least[r] = most[r] = load4(p + 4 * r);
    for (int i = 0; i < RUN / 4; i++)
        for (int r = 0; r < ROWS; r++, p += 4) {
            float4 now = load4(p);
            infinite |= ((int4)now & 0x7F800000) == 0x7F800000;
            least[r] = less_of(now, least[r]);
            most[r] = more_of(now, most[r]);
        }
    for (int i = 0; i < 4 * ROWS; i++) {
        float low = least[i / 4][i % 4], high = most[i / 4][i % 4];
        lo[i % 3] = i < 3 || low < lo[i % 3] ? low : lo[i % 3];
        hi[i % 3] = i < 3 || high > hi[i % 3] ? high : hi[i % 3];
    }
    return !(infinite[0] | infinite[1] | infinite[2] | infinite[3]);
}

int e3d_bound_points(const float *points, int64_t count, float lo[3], float hi[3])
{
    int32_t any = 0;
    float a[3], b[3];
    memset(lo, 0, 3 * sizeof *lo);
    memset(hi, 0, 3 * sizeof *hi);
    for (int64_t i = 0; i < count; i += RUN) {
        const float *p = points + 3 * i;
        if (count - i >= RUN && bound_run(p, a, b)) {
            e3d_grow_bounds(a, lo, hi, &any);
            e3d_grow_bounds(b, lo, hi, &any);
        } else {
            for (int64_t k = 0; k < RUN && i + k < count; k++)
                e3d_grow_bounds(p + 3 * k, lo, hi, &any);
        }
    }
    return any;
}
