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

enum { FACES_AT_A_TIME = 256,
       STACK = 64 };

typedef struct crossings {
    const double *places;
    const int32_t *faces, *parts;
    size_t count;
    double thickness;
    drw_boxes boxes;
    e3d_array *chunks; /* of e3d_crossing */
} crossings;

typedef struct triangle {
    double corners[3][3], normal[3];
    int is_flat; /* it has an area */
} triangle;

static double dot(const double *a, const double *b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static void cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static triangle read(const crossings *job, int32_t face)
{
    triangle t;
    double u[3], v[3];
    for (int c = 0; c < 3; c++)
        memcpy(t.corners[c], job->places + 3 * (size_t)job->faces[3 * (size_t)face + (size_t)c], sizeof t.corners[c]);
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
    if (away[0] == 0 && away[1] == 0 && away[2] == 0)
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

static int cross_pair(const crossings *job, const triangle *one, int32_t face, int32_t other, e3d_array *out)
{
    e3d_crossing made = {{face, other}, {0}};
    triangle second = read(job, other);
    if (!find(one, &second, job->thickness, made.ends))
        return 1;
    if (!e3d_array_reserve(out, out->count + 1, sizeof made))
        return 0;
    ((e3d_crossing *)out->data)[out->count++] = made;
    return 1;
}

/* Without parts, triangles with a common side don't cross. */
static int may_cross(const crossings *job, int32_t a, int32_t b)
{
    if (job->parts)
        return job->parts[a] != job->parts[b];
    int shared = 0;
    for (size_t k = 0; k < 9; k++)
        shared += job->faces[3 * (size_t)a + k / 3] == job->faces[3 * (size_t)b + k % 3];
    return shared < 2;
}

static int cross_face(const crossings *job, int32_t face, e3d_array *out)
{
    struct {
        int level;
        size_t box;
    } stack[STACK];
    int top = 0, fits = 1;
    drw_box own = drw_box_of(job->places, job->faces + 3 * (size_t)face, job->thickness);
    triangle one = read(job, face);
    stack[top].level = job->boxes.depth - 1;
    stack[top++].box = 0;
    while (top && fits) {
        int level = stack[--top].level;
        size_t box = stack[top].box;
        if (!drw_boxes_meet(&own, &job->boxes.levels[level][box]))
            continue;
        if (level == 0) {
            int32_t other = job->boxes.items[box];
            if (other > face && may_cross(job, face, other))
                fits = cross_pair(job, &one, face, other, out);
            continue;
        }
        for (size_t k = 0; k < 2; k++) {
            stack[top].level = level - 1;
            stack[top++].box = 2 * box + k;
        }
    }
    return fits;
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
    size_t first = (size_t)chunk * FACES_AT_A_TIME, end = first + FACES_AT_A_TIME;
    int fits = 1;
    for (size_t face = first; face < end && face < job->count && fits; face++)
        fits = cross_face(job, (int32_t)face, out);
    if (out->count > 1)
        qsort(out->data, out->count, sizeof(e3d_crossing), by_faces);
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
    for (size_t chunk = 0; chunk < chunks; chunk++) {
        if (job->chunks[chunk].count)
            memcpy(all, job->chunks[chunk].data, job->chunks[chunk].count * sizeof *all);
        all += job->chunks[chunk].count;
    }
    return E3D_OK;
}

e3d_status e3d_cross_surfaces(const double *places, const int32_t *faces, const int32_t *parts, size_t count, double thickness,
                              int threads, e3d_crossing **out, size_t *found)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    size_t chunks = (count + FACES_AT_A_TIME - 1) / FACES_AT_A_TIME;
    crossings job = {.places = places, .faces = faces, .parts = parts, .count = count, .thickness = thickness};
    job.chunks = calloc(chunks + 1, sizeof *job.chunks);
    e3d_status status = job.chunks ? drw_boxes_build(&job.boxes, places, faces, count, thickness) : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK) {
        e3d_pool_share(threads, (int)chunks, cross_chunk, &job);
        status = gather(&job, chunks, out, found);
    }
    for (size_t chunk = 0; job.chunks && chunk < chunks; chunk++)
        e3d_array_free(&job.chunks[chunk]);
    free(job.chunks);
    drw_boxes_free(&job.boxes);
    e3d_fpenv_leave(saved);
    return status;
}
