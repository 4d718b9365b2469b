/* Polygons cut into triangles.
 *
 * In:  the corners of polygons. Out: triangles in the order of the polygons, each wound as its polygon; and which of
 *      their edges are the polygon's own.
 * Convex polygons become fans; a concave quad is cut from its reflex corner; other concave polygons have their ears
 * clipped in the plane of two axes that they cover most of.
 * Every operation is one of + - * in double precision, in the order written here.
 */
#include "e3d_surfaces.h"

#include "base/fpenv.h"
#include "io/loaders/ears.h"

#include <math.h>
#include <stdlib.h>

/* A corner counts as reflex if it turns back by more than this share of the polygon's area. Flat corners, and those that
 * rounding bent, are left to the fan. */
#define FLAT 1e-9
/* Polygons of more corners are cut as fans, whatever their shape. */
#define MOST_CORNERS (1 << 18)

typedef struct vector {
    double axis[3];
} vector;

/* One polygon, with room for the largest. */
typedef struct outline {
    int32_t count;
    vector *corners;
    vector area;     /* Newell's area vector, twice the area long */
    int32_t reflex;  /* the first corner that turns the other way; -1 if the polygon is convex */
    e3d_ears ears;
} outline;

static vector corner_at(const e3d_polygons *polygons, size_t corner)
{
    const size_t at = 3 * (polygons->indices ? (size_t)polygons->indices[corner] : corner);
    if (polygons->are_doubles) {
        const double *const p = (const double *)polygons->positions + at;
        return (vector){{p[0], p[1], p[2]}};
    }
    const float *const p = (const float *)polygons->positions + at;
    return (vector){{p[0], p[1], p[2]}};
}

static inline int32_t behind(int32_t corner, int32_t count) { return corner + 1 < count ? corner + 1 : 0; }

static inline vector minus(vector p, vector q)
{
    return (vector){{p.axis[0] - q.axis[0], p.axis[1] - q.axis[1], p.axis[2] - q.axis[2]}};
}

/* Returns one component of the cross product. */
static inline double cross(vector p, vector q, int axis)
{
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    return p.axis[y] * q.axis[z] - p.axis[z] * q.axis[y];
}

/* Returns Newell's area vector; zero if it is not finite. */
static vector area_of(const outline *o)
{
    vector area = {{0, 0, 0}}, p = minus(o->corners[0], o->corners[0]);
    for (int32_t i = 0; i < o->count; i++) {
        const vector q = minus(o->corners[behind(i, o->count)], o->corners[0]);
        for (int axis = 0; axis < 3; axis++)
            area.axis[axis] += cross(p, q, axis);
        p = q;
    }
    const bool is_finite = isfinite(area.axis[0]) && isfinite(area.axis[1]) && isfinite(area.axis[2]);
    return is_finite ? area : (vector){{0, 0, 0}};
}

static int32_t first_reflex(const outline *o)
{
    const double *const area = o->area.axis;
    const double size = area[0] * area[0] + area[1] * area[1] + area[2] * area[2];
    vector before = minus(o->corners[0], o->corners[o->count - 1]);
    for (int32_t i = 0; size > 0 && i < o->count; i++) {
        const vector edge = minus(o->corners[behind(i, o->count)], o->corners[i]);
        double along = 0;
        for (int axis = 0; axis < 3; axis++)
            along += cross(before, edge, axis) * area[axis];
        if (along < -FLAT * size)
            return i;
        before = edge;
    }
    return -1;
}

static void clip(outline *o, int64_t *tests, int32_t *triangles)
{
    int most = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(o->area.axis[axis]) > fabs(o->area.axis[most]))
            most = axis;
    const int x = most == 0, y = most == 2 ? 1 : 2;
    for (int32_t i = 0; i < o->count; i++)
        o->ears.points[i] = (e3d_point){o->corners[i].axis[x], o->corners[i].axis[y]};
    e3d_clip_ears(&o->ears, o->count, tests, triangles);
}

static void put_fan(int32_t count, int32_t start, int32_t *triangles)
{
    for (int32_t k = 0; k < count - 2; k++) {
        triangles[3 * k] = start;
        triangles[3 * k + 1] = (start + k + 1) % count;
        triangles[3 * k + 2] = (start + k + 2) % count;
    }
}

/* Cuts the polygon whose first corner has that number; false if no tests were left and it was cut as a fan. */
static bool cut(const e3d_polygons *polygons, size_t first, outline *o, int64_t *tests, int32_t *triangles)
{
    put_fan(o->count, 0, triangles);
    if (o->count == 3 || o->count > MOST_CORNERS)
        return o->count == 3;
    for (int32_t i = 0; i < o->count; i++)
        o->corners[i] = corner_at(polygons, first + (size_t)i);
    o->area = area_of(o);
    o->reflex = first_reflex(o);
    if (o->reflex < 0)
        return true;
    if (o->count == 4)
        put_fan(4, o->reflex, triangles);
    else if (*tests > 0)
        clip(o, tests, triangles);
    return *tests > 0;
}

/* Numbers the corners from the first one of the whole file, and finds which edges are the polygon's own. */
static bool place_triangles(int32_t count, size_t first, int32_t *triangles, uint8_t *visible)
{
    bool all = true;
    for (int32_t k = 0; k < 3 * (count - 2); k += 3) {
        const int32_t corners[3] = {triangles[k], triangles[k + 1], triangles[k + 2]};
        for (int32_t edge = 0; edge < 3; edge++) {
            const int32_t step = corners[(edge + 1) % 3] - corners[edge];
            visible[k + edge] = step == 1 || step == 1 - count;
            all &= visible[k + edge];
            triangles[k + edge] = (int32_t)first + corners[edge];
        }
    }
    return all;
}

static bool are_sound(const e3d_polygons *polygons)
{
    size_t corners = 0;
    for (size_t k = 0; k < polygons->count; k++) {
        if (polygons->sizes[k] < 0)
            return false;
        corners += (size_t)polygons->sizes[k];
    }
    bool all = corners == polygons->corner_count && corners <= INT32_MAX &&
               (polygons->indices || corners <= polygons->position_count);
    for (size_t i = 0; all && polygons->indices && i < corners; i++)
        all &= polygons->indices[i] >= 0 && (size_t)polygons->indices[i] < polygons->position_count;
    return all;
}

/* Allocates one block of memory for an outline, which begins with `corners`; false if memory is out. */
static bool make_room(const e3d_polygons *polygons, outline *o)
{
    size_t most = 3;
    for (size_t k = 0; k < polygons->count; k++)
        if (polygons->sizes[k] <= MOST_CORNERS && (size_t)polygons->sizes[k] > most)
            most = (size_t)polygons->sizes[k];
    o->corners = malloc(most * (sizeof(vector) + sizeof(e3d_point) + 4 * sizeof(int32_t)));
    if (!o->corners)
        return false;
    o->ears.points = (e3d_point *)(o->corners + most);
    o->ears.before = (int32_t *)(o->ears.points + most);
    o->ears.after = o->ears.before + most;
    o->ears.reflex = o->ears.after + most;
    o->ears.place = o->ears.reflex + most;
    return true;
}

e3d_cut_problem e3d_cut_polygons(const e3d_polygons *polygons, int64_t *tests, e3d_cut *made)
{
    outline o;
    if (!are_sound(polygons))
        return E3D_CUT_OUT_OF_RANGE;
    if (!make_room(polygons, &o))
        return E3D_CUT_NO_MEMORY;
    const e3d_fpenv saved = e3d_fpenv_enter();
    size_t first = 0, triangle = 0;
    made->all_visible = made->is_complete = true;
    for (size_t k = 0; k < polygons->count; k++) {
        o.count = polygons->sizes[k];
        if (o.count >= 3) {
            int32_t *const corners = made->corners + 3 * triangle;
            made->is_complete &= cut(polygons, first, &o, tests, corners);
            made->all_visible &= place_triangles(o.count, first, corners, made->visible + 3 * triangle);
            for (int32_t t = 0; t < o.count - 2; t++)
                made->polygons[triangle++] = (int32_t)k;
        }
        first += (size_t)o.count;
    }
    e3d_fpenv_leave(saved);
    free(o.corners);
    return E3D_CUT_DONE;
}
