/* Random pairs of pictures, which show patches of triangles, of things that may be missing or of fewer triangles; the things
 * are as they stand at the second moment. */
#include "check/driver/scenes/flow_scene.h"

#include <math.h>

#include "check/driver/hostile.h"
#include "e3d_flow.h"

enum { SIDE = 160, /* enough for several tasks */
       PIXELS = SIDE * SIDE,
       THINGS = 5,
       IDS = 8,
       VERTICES = 30,
       FACES = 40,
       INSTANCES = 4 };

typedef struct picture {
    int32_t object_id[PIXELS], instance_id[PIXELS], face_id[PIXELS];
    float barycentric[3 * PIXELS];
} picture;

typedef struct pair {
    picture pictures[2];
    float positions[3 * VERTICES], poses[16 * INSTANCES];
    int32_t faces[3 * FACES], thing_of[IDS], width, height;
    e3d_thing rows[THINGS];
    double screen_from_view[12];
    int in_perspective;
} pair;

static void random_picture(random_stream *r, picture *p)
{
    for (int32_t i = 0, end = 0; i < PIXELS;) {
        int32_t object = random_below(r, IDS + 3) - 1, instance = random_below(r, INSTANCES + 2) - 1, face = random_below(r, FACES + 2) - 1;
        for (end = i + 1 + random_below(r, 60); i < end && i < PIXELS; i++) {
            float a = random_float(r, 0.0f, 1.0f), b = random_float(r, 0.0f, 1.0f - a);
            p->object_id[i] = object;
            p->instance_id[i] = object < 0 ? -1 : instance;
            p->face_id[i] = object < 0 ? -1 : face;
            p->barycentric[3 * i] = a;
            p->barycentric[3 * i + 1] = b;
            p->barycentric[3 * i + 2] = 1.0f - a - b;
        }
    }
}

static void random_things(random_stream *r, pair *p)
{
    for (int i = 0; i < 3 * VERTICES; i++)
        p->positions[i] = random_float(r, -2.0f, 2.0f);
    if (random_once_in(r, 4))
        hostile_replace(p->positions, 3 * VERTICES, r, 12);
    for (int i = 0; i < 3 * FACES; i++)
        p->faces[i] = random_below(r, VERTICES);
    for (int i = 0; i < 16 * INSTANCES; i++)
        p->poses[i] = random_float(r, -1.0f, 1.0f);
    for (int i = 0; i < IDS; i++)
        p->thing_of[i] = random_below(r, THINGS + 1) - 1;
    for (int n = 0; n < THINGS; n++) {
        e3d_thing *thing = p->rows + n;
        *thing = (e3d_thing){.positions = p->positions, .faces = p->faces, .face_count = 1 + random_below(r, FACES)};
        thing->pose_kind = random_once_in(r, 2) ? E3D_POSE_MATRIX : E3D_POSE_NONE;
        thing->instances = thing->pose_kind == E3D_POSE_NONE ? 0 : INSTANCES;
        thing->poses = p->poses;
        for (int k = 0; k < 12; k++)
            thing->view_from_thing[k] = random_float(r, -1.0f, 1.0f) - (k == 11 ? 3.0f : 0.0f);
    }
}

static void random_pair(random_stream *r, pair *p)
{
    for (int k = 0; k < 2; k++)
        random_picture(r, p->pictures + k);
    random_things(r, p);
    p->width = 1 + random_below(r, SIDE);
    p->height = 1 + random_below(r, SIDE);
    p->in_perspective = random_below(r, 2);
    for (int k = 0; k < 12; k++)
        p->screen_from_view[k] = random_float(r, -100.0f, 100.0f);
}

static e3d_seen seen_of(const picture *p, int32_t pixels)
{
    return (e3d_seen){pixels, p->object_id, p->instance_id, p->face_id, p->barycentric};
}

/* NaN is what these functions say of what they do not know: its bits may be any, and the hash takes its place alone. */
static uint64_t hash_doubles(uint64_t hash, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double known = isnan(values[i]) ? 12345.0 : values[i];
        hash = hash_bytes(hash, (const uint8_t *)&known, sizeof known);
    }
    return hash;
}

static uint64_t find(const void *input, e3d_backend backend, int32_t threads)
{
    static double points[3 * PIXELS], places[2 * PIXELS];
    static int32_t at[PIXELS];
    static uint8_t visible[PIXELS];
    const pair *p = input;
    (void)backend;
    int32_t pixels = p->width * p->height;
    const e3d_seen seen[2] = {seen_of(p->pictures, pixels), seen_of(p->pictures + 1, pixels)};
    const e3d_things things = {p->rows, p->thing_of, IDS};
    e3d_seen_points(seen, &things, points, threads);
    e3d_points_to_pixels(p->screen_from_view, points, pixels, places, threads);
    for (int32_t i = 0; i < pixels; i++) {
        double x = floor(places[2 * i]), y = floor(places[2 * i + 1]);
        int is_inside = x >= 0 && x < p->width && y >= 0 && y < p->height;
        at[i] = is_inside ? (int32_t)y * p->width + (int32_t)x : i % 3 ? i
                                                                       : -1;
    }
    const e3d_seen_again again = {.first = seen,
                                  .second = seen + 1,
                                  .things = &things,
                                  .points = points,
                                  .at = at,
                                  .width = p->width,
                                  .height = p->height,
                                  .in_perspective = p->in_perspective};
    e3d_find_seen_again(&again, visible, threads);
    uint64_t hash = hash_doubles(HASH_START, points, 3 * (size_t)pixels);
    hash = hash_doubles(hash, places, 2 * (size_t)pixels);
    return hash_bytes(hash, visible, (size_t)pixels);
}

outcome compare_flow(random_stream r, const run_plan *plan, const char *title)
{
    static pair p;
    random_pair(&r, &p);
    return compare_thread_counts(find, &p, plan, title);
}
