/* Triangles of one polygon that may be concave: ear clipping.
 *
 * In:  the corners of a polygon in the plane. Out: triangles that cover it, wound like it.
 * Corners that lie upon each other are allowed (a hole joined to the outline by a bridge). Work is counted, so that no
 * file can hang the loader. Source: G. H. Meisters, "Polygons have ears", 1975.
 */
#include "io/loaders/ears.h"

#include <stdbool.h>

typedef struct triangle {
    int32_t a, b, c;
} triangle;

/* Positive where a point lies to the left of the line from a to b. */
static inline double side(e3d_point a, e3d_point b, e3d_point p)
{
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* Twice the area of a triangle of neighbours: positive if it turns left. */
static inline double turn(const e3d_ears *e, triangle t)
{
    const e3d_point a = e->points[t.a], b = e->points[t.b], c = e->points[t.c];
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

static inline triangle around(const e3d_ears *e, int32_t corner)
{
    return (triangle){e->before[corner], corner, e->after[corner]};
}

static double twice_area(const e3d_ears *e, int32_t count)
{
    double area = 0;
    for (int32_t i = 0; i < count; i++) {
        const e3d_point a = e->points[i], b = e->points[i + 1 < count ? i + 1 : 0];
        area += a.x * b.y - a.y * b.x;
    }
    return area;
}

static void drop_reflex(e3d_ears *e, int32_t corner)
{
    const int32_t place = e->place[corner];
    if (place < 0)
        return;
    const int32_t last = e->reflex[--e->reflex_count];
    e->reflex[place] = last;
    e->place[last] = place;
    e->place[corner] = -1;
}

static void begin(e3d_ears *e, int32_t count)
{
    if (twice_area(e, count) < 0)
        for (int32_t i = 0; i < count; i++)
            e->points[i].x = -e->points[i].x;
    e->reflex_count = 0;
    for (int32_t i = 0; i < count; i++) {
        e->before[i] = i ? i - 1 : count - 1;
        e->after[i] = i + 1 < count ? i + 1 : 0;
    }
    for (int32_t i = 0; i < count; i++) {
        const bool is_reflex = turn(e, around(e, i)) <= 0;
        e->place[i] = is_reflex ? e->reflex_count : -1;
        if (is_reflex)
            e->reflex[e->reflex_count++] = i;
    }
}

static inline bool are_same(e3d_point a, e3d_point b) { return a.x == b.x && a.y == b.y; }

/* Whether a reflex corner lies in the triangle or (if strict) on its border. Each test is counted. */
static bool holds_corner(const e3d_ears *e, triangle t, bool strict, int64_t *tests)
{
    const e3d_point a = e->points[t.a], b = e->points[t.b], c = e->points[t.c];
    for (int32_t k = 0; k < e->reflex_count; k++) {
        const e3d_point p = e->points[e->reflex[k]];
        const double ab = side(a, b, p), bc = side(b, c, p), ca = side(c, a, p);
        const bool is_inside = strict ? ab >= 0 && bc >= 0 && ca >= 0 : ab > 0 && bc > 0 && ca > 0;
        if (is_inside && !are_same(p, a) && !are_same(p, b) && !are_same(p, c)) {
            *tests -= k + 1;
            return true;
        }
    }
    *tests -= e->reflex_count;
    return false;
}

static int32_t *put(int32_t *triangles, triangle t)
{
    triangles[0] = t.a;
    triangles[1] = t.b;
    triangles[2] = t.c;
    return triangles + 3;
}

/* Cuts the remaining corners as a fan. */
static void put_fan(const e3d_ears *e, int32_t corner, int32_t left, int32_t *triangles)
{
    int32_t second = e->after[corner];
    for (; left > 2; left--) {
        const int32_t third = e->after[second];
        triangles = put(triangles, (triangle){corner, second, third});
        second = third;
    }
}

static void cut_off(e3d_ears *e, triangle ear)
{
    e->after[ear.a] = ear.c;
    e->before[ear.c] = ear.a;
    drop_reflex(e, ear.b);
    if (e->place[ear.a] >= 0 && turn(e, around(e, ear.a)) > 0)
        drop_reflex(e, ear.a);
    if (e->place[ear.c] >= 0 && turn(e, around(e, ear.c)) > 0)
        drop_reflex(e, ear.c);
}

void e3d_clip_ears(e3d_ears *ears, int32_t count, int64_t *tests, int32_t *triangles)
{
    begin(ears, count);
    *tests -= 10 + 4 * (int64_t)count;
    int32_t corner = 0, left = count, failures = 0;
    bool strict = true;
    while (left > 3) {
        const triangle t = around(ears, corner);
        const double size = turn(ears, t);
        *tests -= 1;
        if (*tests <= 0)
            break;
        const bool is_ear = (strict ? size > 0 : size >= 0) && !holds_corner(ears, t, strict, tests);
        if (!is_ear && failures <= 2 * (int64_t)left) {
            failures++;
            /* If no proper ear is left, flat corners are accepted, and points on an ear's border. */
            strict = failures <= left;
            corner = t.c;
            continue;
        }
        triangles = put(triangles, t);
        cut_off(ears, t);
        /* Continuing behind the next corner spreads the ears, instead of making one long fan. */
        corner = ears->after[t.c];
        left--;
        failures = 0;
        strict = true;
    }
    if (left > 3)
        put_fan(ears, corner, left, triangles);
    else
        put(triangles, around(ears, corner));
}
