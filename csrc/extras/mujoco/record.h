/* Records: triangles as the raster takes them, their pixels and edges (R257). Inline, since most triangles end here. */
#pragma once

#include "extras/mujoco/picture.h"

static inline int32_t muj_least(const int32_t v[3])
{
    int32_t least = v[0] < v[1] ? v[0] : v[1];
    return least < v[2] ? least : v[2];
}

static inline int32_t muj_most(const int32_t v[3])
{
    int32_t most = v[0] > v[1] ? v[0] : v[1];
    return most > v[2] ? most : v[2];
}

/* Sets the pixels of a triangle with corners in 1/256 pixel; 0 if no sample can be covered. */
static inline int muj_set_pixels(const muj_view *view, const int32_t x[3], const int32_t y[3], muj_record *out)
{
    int32_t early = view->first_sample;
    int32_t x0 = (muj_least(x) + early - 1) >> 8, x1 = (muj_most(x) - early) >> 8;
    int32_t y0 = (muj_least(y) + early - 1) >> 8, y1 = (muj_most(y) - early) >> 8;
    out->x0 = x0 < view->low[0] ? view->low[0] : x0;
    out->y0 = y0 < view->low[1] ? view->low[1] : y0;
    out->x1 = x1 > view->high[0] ? view->high[0] : x1;
    out->y1 = y1 > view->high[1] ? view->high[1] : y1;
    return out->x0 <= out->x1 && out->y0 <= out->y1;
}

/* Sets the edges. The area is positive. Samples on left and lower edges are covered. */
static inline void muj_set_edges(const int32_t x[3], const int32_t y[3], muj_record *out)
{
    for (int k = 0; k < 3; k++) {
        int q = (k + 1) % 3;
        int64_t a = y[k] - y[q], b = x[q] - x[k];
        out->a[k] = (int32_t)a, out->b[k] = (int32_t)b;
        out->e[k] = a * ((int64_t)out->x0 * MUJ_SUB - x[k]) + b * ((int64_t)out->y0 * MUJ_SUB - y[k]);
        if (!(a > 0 || (a == 0 && b < 0)))
            out->e[k] -= 1;
    }
}

/* Room for one more record at the end of a list; NULL when memory is out, and then the record is left out. */
static inline muj_record *muj_new_record(e3d_array *list)
{
    if (list->count == list->room && !e3d_array_reserve(list, list->count + 1, sizeof(muj_record)))
        return NULL;
    return (muj_record *)list->data + list->count;
}
