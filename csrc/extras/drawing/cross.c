/* Finds the segments in which triangles of different parts cross.
 * In: triangles with the number of their part. Out: a segment for each pair that crosses.
 * Each triangle meets the other one's plane in a stretch of the line that both planes share; the segment is what both stretches
 * have in common (Moeller, "A Fast Triangle-Triangle Intersection Test", 1997). */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/grow.h"
#include "base/pool.h"
#include "e3d_drawing.h"
#include "extras/drawing/boxes.h"

enum { FOURS_AT_A_TIME = 64,
       STACK = 3 * DRW_LEVELS + 1 };

typedef struct triangle {
    double corners[3][3], normal[3];
    int32_t vertices[3], face, part;
    int is_flat; /* it has an area */
} triangle;

typedef struct crossings {
    double thickness;
    int has_parts;
    drw_boxes boxes;
    triangle *triangles; /* in the order of the boxes */
    e3d_array *chunks;   /* of e3d_crossing */
} crossings;

static double dot(const double *a, const double *b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }

static void cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static triangle read(const double *places, const int32_t *faces, const int32_t *parts, int32_t face)
{
    triangle t = {.face = face, .part = parts ? parts[face] : 0};
    double u[3], v[3];
    memcpy(t.vertices, faces + 3 * (size_t)face, sizeof t.vertices);
    for (int c = 0; c < 3; c++)
        memcpy(t.corners[c], places + 3 * (size_t)t.vertices[c], sizeof t.corners[c]);
    for (int k = 0; k < 3; k++) {
        u[k] = t.corners[1][k] - t.corners[0][k];
        v[k] = t.corners[2][k] - t.corners[0][k];
    }
    cross(u, v, t.normal);
    double length = sqrt(dot(t.normal, t.normal));
    t.is_flat = length > 0 && isfinite(length);
    for (int k = 0; k < 3; k++)
        t.normal[k] /= length;
    return t;
}

static int is_on_one_side(const double away[3])
{
    return (away[0] >= 0 && away[1] >= 0 && away[2] >= 0) || (away[0] <= 0 && away[1] <= 0 && away[2] <= 0);
}

/* Finds the two points in which a triangle's border meets the plane of another; 0 if there are not two. */
static int meet(const triangle *t, const triangle *plane, double thickness, double ends[2][3])
{
    double away[3];
    int found = 0;
    for (int c = 0; c < 3; c++) {
        double from[3];
        for (int k = 0; k < 3; k++)
            from[k] = t->corners[c][k] - plane->corners[0][k];
        away[c] = dot(plane->normal, from);
        away[c] = fabs(away[c]) <= thickness ? 0 : away[c];
    }
    int zeros = (away[0] == 0) + (away[1] == 0) + (away[2] == 0);
    if (zeros == 3 || (zeros < 2 && is_on_one_side(away)))
        return 0;
    for (int c = 0; c < 3; c++) {
        const double *a = t->corners[c], *b = t->corners[(c + 1) % 3];
        double at = away[c], next = away[(c + 1) % 3];
        if (at != 0 && !((at < 0 && next > 0) || (at > 0 && next < 0)))
            continue;
        double share = at == 0 ? 0 : at / (at - next);
        for (int k = 0; k < 3 && found < 2; k++)
            ends[found][k] = a[k] + (b[k] - a[k]) * share;
        found++;
    }
    return found == 2;
}

static int find(const triangle *a, const triangle *b, double thickness, double *out)
{
    double way[3], first[2][3], second[2][3];
    if (!a->is_flat || !b->is_flat || !meet(a, b, thickness, first) || !meet(b, a, thickness, second))
        return 0;
    cross(a->normal, b->normal, way);
    double at[4] = {dot(way, first[0]), dot(way, first[1]), dot(way, second[0]), dot(way, second[1])};
    const double *ends[4] = {first[0], first[1], second[0], second[1]};
    int low[2] = {at[0] <= at[1] ? 0 : 1, at[2] <= at[3] ? 2 : 3}, high[2] = {1 - low[0], 5 - low[1]};
    int from = at[low[0]] >= at[low[1]] ? low[0] : low[1], to = at[high[0]] <= at[high[1]] ? high[0] : high[1];
    if (!(at[to] > at[from]))
        return 0;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = ends[from][k];
        out[3 + k] = ends[to][k];
        square += (out[3 + k] - out[k]) * (out[3 + k] - out[k]);
    }
    return square > thickness * thickness;
}

/* Whether the boxes of two triangles, with a margin, meet. */
static int are_near(const triangle *a, const triangle *b, double margin)
{
    int near = 1;
    for (int k = 0; k < 3; k++) {
        double low[2], high[2];
        for (int i = 0; i < 2; i++) {
            const triangle *t = i ? b : a;
            low[i] = less(less(t->corners[0][k], t->corners[1][k]), t->corners[2][k]) - margin;
            high[i] = more(more(t->corners[0][k], t->corners[1][k]), t->corners[2][k]) + margin;
        }
        near &= (low[0] <= high[1]) & (low[1] <= high[0]);
    }
    return near;
}

/* Without parts, triangles with a common side don't cross. */
static int may_cross(const crossings *job, const triangle *a, const triangle *b)
{
    if (job->has_parts)
        return a->part != b->part;
    int shared = 0;
    for (int k = 0; k < 3; k++)
        shared += (a->vertices[k] == b->vertices[0]) + (a->vertices[k] == b->vertices[1]) + (a->vertices[k] == b->vertices[2]);
    return shared < 2;
}

static int cross_pair(const crossings *job, const triangle *a, const triangle *b, e3d_array *out)
{
    if (a->face > b->face) {
        const triangle *first = b;
        b = a;
        a = first;
    }
    e3d_crossing made = {{a->face, b->face}, {0}};
    if (!may_cross(job, a, b) || !find(a, b, job->thickness, made.ends) || !are_near(a, b, job->thickness))
        return 1;
    if (!e3d_array_reserve(out, out->count + 1, sizeof made))
        return 0;
    ((e3d_crossing *)out->data)[out->count++] = made;
    return 1;
}

/* Crosses the triangles of two fours, or those of one with each other. */
static int cross_fours(const crossings *job, size_t one, const drw_four own[4], size_t other, e3d_array *out)
{
    for (size_t lane = 0; lane < 4; lane++) {
        int near = drw_fours_meet(&own[lane], &job->boxes.levels[0][other]);
        near &= one == other ? 14 << lane : 15;
        for (size_t k = 0; near >> k; k++)
            if (near >> k & 1 && !cross_pair(job, &job->triangles[4 * one + lane], &job->triangles[4 * other + k], out))
                return 0;
    }
    return 1;
}

/* Crosses the triangles of a four with those that stand behind them. */
static int cross_four(const crossings *job, size_t one, e3d_array *out)
{
    const drw_boxes *boxes = &job->boxes;
    struct {
        int level;
        size_t four;
    } stack[STACK];
    int top = 0;
    drw_four around = drw_around(&boxes->levels[0][one]), own[4];
    for (int lane = 0; lane < 4; lane++)
        own[lane] = drw_one_of(&boxes->levels[0][one], lane);
    stack[top].level = boxes->depth - 1;
    stack[top++].four = 0;
    while (top) {
        int level = stack[--top].level;
        size_t four = stack[top].four;
        if (level == 0) {
            if (!cross_fours(job, one, own, four, out))
                return 0;
            continue;
        }
        int near = drw_fours_meet(&around, &boxes->levels[level][four]);
        for (size_t k = 0; k < 4; k++)
            if (near >> k & 1 && (4 * four + k + 1) << 2 * (level - 1) > one) {
                stack[top].level = level - 1;
                stack[top++].four = 4 * four + k;
            }
    }
    return 1;
}

static int by_faces(const void *a, const void *b)
{
    const e3d_crossing *first = a, *second = b;
    for (int k = 0; k < 2; k++)
        if (first->faces[k] != second->faces[k])
            return first->faces[k] < second->faces[k] ? -1 : 1;
    return 0;
}

static void cross_chunk(void *argument, int chunk)
{
    crossings *job = argument;
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_array *out = &job->chunks[chunk];
    size_t first = (size_t)chunk * FOURS_AT_A_TIME, end = first + FOURS_AT_A_TIME;
    int fits = 1;
    for (size_t four = first; four < end && four < job->boxes.fours[0] && fits; four++)
        fits = cross_four(job, four, out);
    if (!fits)
        out->count = SIZE_MAX;
    e3d_fpenv_leave(saved);
}

static e3d_status gather(const crossings *job, size_t chunks, e3d_crossing **out, size_t *found)
{
    size_t total = 0;
    for (size_t chunk = 0; chunk < chunks; chunk++) {
        if (job->chunks[chunk].count == SIZE_MAX)
            return E3D_OUT_OF_MEMORY;
        total += job->chunks[chunk].count;
    }
    e3d_crossing *all = malloc((total + 1) * sizeof *all);
    if (!all)
        return E3D_OUT_OF_MEMORY;
    *out = all;
    *found = total;
    e3d_crossing *end = all;
    for (size_t chunk = 0; chunk < chunks; chunk++) {
        if (job->chunks[chunk].count)
            memcpy(end, job->chunks[chunk].data, job->chunks[chunk].count * sizeof *all);
        end += job->chunks[chunk].count;
    }
    qsort(all, total, sizeof *all, by_faces);
    return E3D_OK;
}

static e3d_status prepare(crossings *job, const double *places, const int32_t *faces, const int32_t *parts, size_t count)
{
    e3d_status status = drw_boxes_build(&job->boxes, places, faces, count, job->thickness);
    job->triangles = status == E3D_OK ? malloc(4 * job->boxes.fours[0] * sizeof *job->triangles) : NULL;
    if (!job->triangles)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < count; i++)
        job->triangles[i] = read(places, faces, parts, job->boxes.items[i]);
    return E3D_OK;
}

e3d_status e3d_cross_surfaces(const double *places, const int32_t *faces, const int32_t *parts, size_t count, double thickness,
                              int threads, e3d_crossing **out, size_t *found)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    crossings job = {.thickness = thickness, .has_parts = parts != NULL};
    e3d_status status = prepare(&job, places, faces, parts, count);
    size_t chunks = status == E3D_OK ? (job.boxes.fours[0] + FOURS_AT_A_TIME - 1) / FOURS_AT_A_TIME : 0;
    job.chunks = calloc(chunks + 1, sizeof *job.chunks);
    status = job.chunks ? status : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK) {
        e3d_pool_share(threads, (int)chunks, cross_chunk, &job);
        status = gather(&job, chunks, out, found);
    }
    for (size_t chunk = 0; job.chunks && chunk < chunks; chunk++)
        e3d_array_free(&job.chunks[chunk]);
    free(job.chunks);
    free(job.triangles);
    drw_boxes_free(&job.boxes);
    e3d_fpenv_leave(saved);
    return status;
}
