/* flow: the points that a picture shows, at another moment (R182 ... R184).
 *
 * In:  identities and barycentric coordinates of pixels, and triangles as they stand at a moment. Out: points in the space of
 * that moment's camera; their places in its picture; whether it shows them.
 * Method: a pixel's triangle is posed as it is at the moment, and the same barycentric coordinates are taken of it, so that
 * skins, morph targets, instances and cameras need nothing of their own. A point is hidden if what the other picture shows in
 * its pixel is before it: planes of triangles, not depths of pixels, say so, and so neighbours on one surface hide nothing.
 */
#include <math.h>
#include <stddef.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "e3d_flow.h"
#include "scene/pose.h"

enum { PIXELS_A_TASK = 8192 };

/* Distances below this share of a point's distance from the eye are rounding (R184). */
static const double CLOSE = 0x1p-16;

static void place(const double pose[12], const double p[3], double out[3])
{
    for (int r = 0; r < 3; r++) {
        const double *m = pose + 4 * r;
        out[r] = ((m[0] * p[0] + m[1] * p[1]) + m[2] * p[2]) + m[3];
    }
}

/* Finds the corners of the triangle that a pixel shows; 0 if it shows none that is there. */
static int find_corners(const e3d_seen *seen, const e3d_things *things, int32_t pixel, double corners[3][3])
{
    int32_t id = seen->object_id[pixel], face = seen->face_id[pixel], instance = seen->instance_id[pixel];
    if (id < 0 || id >= things->ids || things->thing_of[id] < 0 || face < 0)
        return 0;
    const e3d_thing *thing = &things->rows[things->thing_of[id]];
    double pose[12];
    if (face >= thing->face_count)
        return 0;
    if (thing->pose_kind != E3D_POSE_NONE &&
        (instance < 0 || instance >= thing->instances || !e3d_instance_pose(thing->poses, thing->pose_kind, instance, pose)))
        return 0;
    for (int k = 0; k < 3; k++) {
        const float *v = thing->positions + 3 * (size_t)thing->faces[3 * (size_t)face + k];
        double p[3] = {v[0], v[1], v[2]}, in_node[3];
        if (thing->pose_kind != E3D_POSE_NONE) {
            place(pose, p, in_node);
            place(thing->view_from_thing, in_node, corners[k]);
        } else {
            place(thing->view_from_thing, p, corners[k]);
        }
    }
    return 1;
}

/* R182 */
static int find_point(const e3d_seen *seen, int32_t pixel, double corners[3][3], double out[3])
{
    const float *b = seen->barycentric + 3 * (size_t)pixel;
    int is_finite = 1;
    for (int c = 0; c < 3; c++) {
        out[c] = (corners[0][c] + b[1] * (corners[1][c] - corners[0][c])) + b[2] * (corners[2][c] - corners[0][c]);
        is_finite &= isfinite(out[c]) != 0;
    }
    return is_finite;
}

/* ---- points ---- */

typedef struct points_job {
    const e3d_seen *seen;
    const e3d_things *things;
    double *points;
} points_job;

static int32_t end_of(int32_t first, int32_t count) { return count - first < PIXELS_A_TASK ? count : first + PIXELS_A_TASK; }

static int tasks_of(int32_t count) { return (int)(((int64_t)count + PIXELS_A_TASK - 1) / PIXELS_A_TASK); }

static void find_points(void *argument, int task)
{
    const points_job *job = argument;
    int32_t first = PIXELS_A_TASK * task, end = end_of(first, job->seen->pixels);
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = first; i < end; i++) {
        double corners[3][3], *out = job->points + 3 * (size_t)i;
        if (!find_corners(job->seen, job->things, i, corners) || !find_point(job->seen, i, corners, out))
            out[0] = out[1] = out[2] = NAN;
    }
    e3d_fpenv_leave(saved);
}

void e3d_seen_points(const e3d_seen *seen, const e3d_things *things, double *points, int threads)
{
    points_job job = {seen, things, points};
    e3d_pool_share(threads, tasks_of(seen->pixels), find_points, &job);
}

/* ---- places ---- */

typedef struct places_job {
    const double *rows, *points;
    int32_t count;
    double *pixels;
} places_job;

/* R183 */
static void find_places(void *argument, int task)
{
    const places_job *job = argument;
    int32_t first = PIXELS_A_TASK * task, end = end_of(first, job->count);
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = first; i < end; i++) {
        double at[3], *out = job->pixels + 2 * (size_t)i;
        place(job->rows, job->points + 3 * (size_t)i, at);
        out[0] = at[2] > 0 ? at[0] / at[2] : NAN;
        out[1] = at[2] > 0 ? at[1] / at[2] : NAN;
    }
    e3d_fpenv_leave(saved);
}

void e3d_points_to_pixels(const double screen_from_view[12], const double *points, int32_t count, double *pixels, int threads)
{
    places_job job = {screen_from_view, points, count, pixels};
    e3d_pool_share(threads, tasks_of(count), find_places, &job);
}

/* ---- whether they show ---- */

/* A triangle's plane: normal . p = offset; side: the sign of the eye's side. */
typedef struct plane {
    double normal[3], offset, length, side;
} plane;

static double dot(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static plane plane_of(double corners[3][3], int in_perspective)
{
    plane p;
    double one[3], two[3];
    for (int c = 0; c < 3; c++) {
        one[c] = corners[1][c] - corners[0][c];
        two[c] = corners[2][c] - corners[0][c];
    }
    for (int c = 0; c < 3; c++)
        p.normal[c] = one[(c + 1) % 3] * two[(c + 2) % 3] - one[(c + 2) % 3] * two[(c + 1) % 3];
    p.offset = dot(p.normal, corners[0]);
    p.length = sqrt(dot(p.normal, p.normal));
    double eye = in_perspective ? 0 - p.offset : p.normal[2];
    p.side = eye > 0 ? 1 : eye < 0 ? -1
                                   : 0;
    return p;
}

/* How far a point is from a plane, towards the eye: 1, 0 (as good as in it) or -1. */
static int side_of(const plane *p, const double point[3])
{
    double away = (dot(p->normal, point) - p->offset) * p->side;
    double close = CLOSE * (p->length * sqrt(dot(point, point)));
    return away > close ? 1 : away < 0 - close ? -1
                                               : 0;
}

static int is_same(const e3d_seen *a, int32_t i, const e3d_seen *b, int32_t j)
{
    return a->object_id[i] == b->object_id[j] && a->instance_id[i] == b->instance_id[j];
}

/* Returns whether a thing shows in one of the nine pixels around one. */
static int shows_near(const e3d_seen_again *job, int32_t pixel, int32_t at)
{
    int32_t column = at % job->width, row = at / job->width;
    for (int32_t y = row > 0 ? row - 1 : 0; y <= row + 1 && y < job->height; y++)
        for (int32_t x = column > 0 ? column - 1 : 0; x <= column + 1 && x < job->width; x++)
            if (is_same(job->first, pixel, job->second, y * job->width + x))
                return 1;
    return 0;
}

/* R184 */
static int is_visible(const e3d_seen_again *job, int32_t pixel, int32_t at)
{
    const e3d_seen *first = job->first, *second = job->second;
    double own[3][3], other[3][3], point[3];
    int is_same_thing = is_same(first, pixel, second, at);
    if (is_same_thing && first->face_id[pixel] == second->face_id[at])
        return 1;
    if (second->object_id[at] < 0)
        return shows_near(job, pixel, at);
    if (!find_corners(first, job->things, pixel, own))
        return 0;
    if (!find_corners(second, job->things, at, other) || !find_point(second, at, other, point))
        return is_same_thing;
    plane mine = plane_of(own, job->in_perspective), its = plane_of(other, job->in_perspective);
    return side_of(&its, job->points + 3 * (size_t)pixel) >= 0 || side_of(&mine, point) <= 0;
}

typedef struct marks_job {
    const e3d_seen_again *job;
    uint8_t *visible;
} marks_job;

static void find_marks(void *argument, int task)
{
    const marks_job *marks = argument;
    const e3d_seen_again *job = marks->job;
    int32_t first = PIXELS_A_TASK * task, end = end_of(first, job->first->pixels);
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = first; i < end; i++)
        marks->visible[i] = job->at[i] >= 0 && job->first->object_id[i] >= 0 ? (uint8_t)is_visible(job, i, job->at[i]) : 0;
    e3d_fpenv_leave(saved);
}

void e3d_find_seen_again(const e3d_seen_again *job, uint8_t *visible, int threads)
{
    marks_job marks = {job, visible};
    e3d_pool_share(threads, tasks_of(job->first->pixels), find_marks, &marks);
}
