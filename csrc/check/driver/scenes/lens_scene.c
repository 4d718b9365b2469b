/* Random pictures through lenses: pixels that look anywhere into pinhole pictures of random colours, or of the triangles of a
 * random graph, with filters of every width. */
#include "check/driver/scenes/lens_scene.h"

#include <math.h>
#include <stdlib.h>

#include "e3d_lens.h"

enum { SIDE = 60,      /* of the lens's picture */
       FACE_SIDE = 40,
       BORDER = 2,     /* pixels around what rays look at */
       TOTAL = E3D_LENS_FACES * FACE_SIDE * FACE_SIDE,
       PIXELS = SIDE * SIDE };

/* Faces, and where the pixels look into them. */
typedef struct looks {
    e3d_lens_face faces[E3D_LENS_FACES];
    e3d_lens_pixel pixels[PIXELS];
    int32_t face_count, width, height;
    int64_t total;
} looks;

/* An axis of a cube, turned by swapping and negating. */
static void random_axes(random_stream *r, double axes[3][3])
{
    int32_t first = random_below(r, 3), way = 1 + random_below(r, 2);
    for (int k = 0; k < 3; k++)
        axes[k][(first + k * way) % 3] = random_once_in(r, 2) ? 1 : -1;
}

static void random_looks(random_stream *r, looks *l)
{
    *l = (looks){.face_count = 1 + random_below(r, E3D_LENS_FACES)};
    for (int32_t f = 0; f < l->face_count; f++) {
        e3d_lens_face *face = l->faces + f;
        face->start = l->total;
        face->width = 2 * BORDER + 1 + random_below(r, FACE_SIDE - 2 * BORDER);
        face->height = 2 * BORDER + 1 + random_below(r, FACE_SIDE - 2 * BORDER);
        l->total += face->width * face->height;
        random_axes(r, face->axes);
    }
    l->width = 1 + random_below(r, SIDE);
    l->height = 1 + random_below(r, SIDE);
    int32_t widest = random_once_in(r, 4) ? 32 * 256 : 700;
    for (int32_t i = 0; i < l->width * l->height; i++) {
        int32_t f = random_once_in(r, 10) ? -1 : random_below(r, l->face_count);
        const e3d_lens_face *face = l->faces + (f < 0 ? 0 : f);
        l->pixels[i] = (e3d_lens_pixel){.x = 256 * BORDER + random_below(r, 256 * (face->width - 2 * BORDER)),
                                        .y = 256 * BORDER + random_below(r, 256 * (face->height - 2 * BORDER)),
                                        .face = f,
                                        .across = (uint16_t)(256 + random_below(r, widest - 255)),
                                        .down = (uint16_t)(256 + random_below(r, widest - 255))};
    }
}

/* ---- colours ---- */

typedef struct colored {
    looks looks;
    uint8_t from[4 * TOTAL], behind[4 * PIXELS];
    e3d_lens_codes codes;
    int has_behind;
} colored;

static void random_colors(random_stream *r, colored *c)
{
    int opaque = random_once_in(r, 2);
    random_looks(r, &c->looks);
    c->has_behind = random_once_in(r, 2);
    e3d_lens_codes_fill(&c->codes, random_below(r, 2));
    for (int i = 0; i < 4 * TOTAL; i++)
        c->from[i] = i % 4 == 3 && (opaque || random_once_in(r, 2)) ? 255 : (uint8_t)random_bits(r);
    for (int i = 0; i < 4 * PIXELS; i++)
        c->behind[i] = (uint8_t)random_bits(r);
}

static uint64_t draw_colors(const void *input, e3d_backend backend, int32_t threads)
{
    const colored *c = input;
    static uint16_t light[4 * TOTAL];
    static uint8_t to[4 * PIXELS];
    e3d_lens_colors colors = {.faces = c->looks.faces,
                              .pixels = c->looks.pixels,
                              .codes = &c->codes,
                              .from = c->from,
                              .light = light,
                              .total = c->looks.total,
                              .behind = c->has_behind ? c->behind : NULL,
                              .outside = {1, 2, 3, 4},
                              .width = c->looks.width,
                              .height = c->looks.height,
                              .to = to};
    e3d_status status = e3d_lens_draw(&colors, backend, threads);
    return status == E3D_OK ? hash_bytes(HASH_START, to, 4 * (size_t)colors.width * (size_t)colors.height) : 0;
}

outcome compare_lens_colors(random_stream r, const run_plan *plan, const char *title)
{
    static colored c;
    random_colors(&r, &c);
    return compare_hashes(draw_colors, &c, plan, title);
}

/* ---- rays ---- */

enum { NODES = 6,
       VERTICES = 30,
       FACES = 40,
       INSTANCES = 3 };

typedef struct traced {
    looks looks;
    double rays[3 * PIXELS], world_from_view[16], world[12 * NODES], boxes[E3D_BOX * NODES];
    float positions[3 * VERTICES], poses[16 * INSTANCES], depth[TOTAL], vectors[3 * TOTAL];
    int32_t faces[3 * FACES], object[NODES], id[NODES], slots[NODES];
    int32_t object_id[TOTAL], instance_id[TOTAL], face_id[TOTAL];
    uint8_t flags[NODES], solid[NODES];
    e3d_graph graph;
    e3d_shape shapes[2];
    int any_side;
} traced;

static void random_world(random_stream *r, traced *t)
{
    for (int i = 0; i < 3 * VERTICES; i++)
        t->positions[i] = random_float(r, -1.0f, 1.0f);
    for (int i = 0; i < 3 * FACES; i++)
        t->faces[i] = random_below(r, VERTICES);
    for (int i = 0; i < 16 * INSTANCES; i++)
        t->poses[i] = random_float(r, -1.0f, 1.0f);
    for (int n = 0; n < NODES; n++) {
        t->object[n] = random_below(r, 3) - 1;
        t->id[n] = t->slots[n] = n;
        t->flags[n] = E3D_NODE_ALIVE | E3D_NODE_VISIBLE | E3D_NODE_SHOWN;
        t->solid[n] = !random_once_in(r, 4);
        for (int k = 0; k < 12; k++)
            t->world[12 * n + k] = random_float(r, -2.0f, 2.0f);
    }
    t->graph = (e3d_graph){.count = NODES, .object = t->object, .id = t->id, .flags = t->flags, .world = t->world, .bounds = t->boxes};
    t->any_side = random_below(r, 2);
    for (int k = 0; k < 2; k++)
        t->shapes[k] = (e3d_shape){.known = 1, .face_count = FACES, .positions = t->positions, .faces = t->faces};
    t->shapes[1].pose_kind = E3D_POSE_MATRIX;
    t->shapes[1].instances = INSTANCES;
    t->shapes[1].poses = t->poses;
}

/* Patches of faces, some of which are not there. */
static void random_shown(random_stream *r, traced *t)
{
    for (int32_t i = 0, end = 0; i < TOTAL;) {
        int32_t object = random_below(r, NODES + 2) - 1, face = random_below(r, FACES + 2) - 1, instance = random_below(r, INSTANCES + 1);
        float depth = random_float(r, 0.1f, 4.0f);
        for (end = i + 1 + random_below(r, 200); i < end && i < TOTAL; i++) {
            t->object_id[i] = object;
            t->instance_id[i] = object < 0 ? -1 : instance;
            t->face_id[i] = object < 0 ? -1 : face;
            t->depth[i] = object < 0 ? 0.0f : depth;
        }
    }
    for (int i = 0; i < 3 * TOTAL; i++)
        t->vectors[i] = random_float(r, -1.0f, 1.0f);
}

static void random_rays(random_stream *r, traced *t)
{
    for (int i = 0; i < PIXELS; i++) {
        double *ray = t->rays + 3 * i, length = 0;
        for (int k = 0; k < 3; k++) {
            ray[k] = random_float(r, -1.0f, 1.0f) + 0x1p-30;
            length += ray[k] * ray[k];
        }
        for (int k = 0; k < 3; k++)
            ray[k] /= sqrt(length);
    }
    for (int k = 0; k < 12; k++)
        t->world_from_view[k] = k % 5 == 0 ? 1 : k % 4 == 3 ? random_float(r, -1.0f, 1.0f)
                                                            : 0;
    t->world_from_view[15] = 1;
}

typedef struct met {
    int32_t source[PIXELS], ids[3][PIXELS];
    float depth[PIXELS], range[PIXELS], weights[3 * PIXELS];
    double distance[PIXELS];
    uint8_t exact[PIXELS];
} met;

/* Takes vectors or depths; the hash of what is taken. */
static uint64_t take(uint64_t hash, const traced *t, const int32_t *source, int is_turned, int32_t threads)
{
    static uint8_t to[12 * PIXELS];
    const looks *l = &t->looks;
    e3d_lens_values values = {.faces = l->faces,
                              .face_count = l->face_count,
                              .pixels = l->pixels,
                              .source = source,
                              .from = (const uint8_t *)(is_turned ? t->vectors : t->depth),
                              .bytes = is_turned ? 12 : 4,
                              .is_turned = is_turned,
                              .none = 255,
                              .width = l->width,
                              .height = l->height,
                              .to = to};
    e3d_lens_take(&values, threads);
    return hash_bytes(hash, to, (size_t)values.bytes * (size_t)l->width * (size_t)l->height);
}

static uint64_t hash_met(uint64_t hash, const met *m, size_t pixels)
{
    hash = hash_bytes(hash, (const uint8_t *)m->source, pixels * sizeof *m->source);
    for (int k = 0; k < 3; k++)
        hash = hash_bytes(hash, (const uint8_t *)m->ids[k], pixels * sizeof *m->ids[k]);
    hash = hash_bytes(hash, (const uint8_t *)m->depth, pixels * sizeof *m->depth);
    hash = hash_bytes(hash, (const uint8_t *)m->range, pixels * sizeof *m->range);
    hash = hash_bytes(hash, (const uint8_t *)m->weights, 3 * pixels * sizeof *m->weights);
    hash = hash_bytes(hash, (const uint8_t *)m->distance, pixels * sizeof *m->distance);
    return hash_bytes(hash, m->exact, pixels);
}

/* 0 where trees could not be built. */
static uint64_t find(const traced *t, e3d_tree *const trees[2], e3d_tree *nodes, int32_t threads)
{
    static met m;
    double triangles[E3D_BOX * FACES], instances[E3D_BOX * INSTANCES], box[E3D_OBJECT_BOX];
    e3d_shape shapes[2] = {t->shapes[0], t->shapes[1]};
    e3d_triangle_boxes(t->positions, t->faces, FACES, triangles);
    e3d_boxes_union(triangles, FACES, box);
    e3d_instance_boxes(t->poses, E3D_POSE_MATRIX, INSTANCES, box, instances);
    if (!e3d_tree_build(trees[0], triangles, FACES, 1) || !e3d_tree_build(trees[1], instances, INSTANCES, 1))
        return 0;
    shapes[0].triangles = shapes[1].triangles = trees[0];
    shapes[1].instance_tree = trees[1];
    const e3d_lens_scene scene = {&t->graph, nodes, shapes, 2, t->id, t->slots, NODES, t->solid, t->any_side};
    const e3d_lens_shown shown = {t->object_id, t->instance_id, t->face_id, t->depth};
    const e3d_lens_found found = {.source = m.source,
                                  .object_id = m.ids[0],
                                  .instance_id = m.ids[1],
                                  .face_id = m.ids[2],
                                  .depth = m.depth,
                                  .range = m.range,
                                  .is_along_axis = t->any_side,
                                  .distance = m.distance,
                                  .barycentric = m.weights,
                                  .exact = m.exact};
    const looks *l = &t->looks;
    int64_t casts = e3d_lens_find(&scene, l->faces, l->pixels, t->rays, l->width, l->height, t->world_from_view, 0.05, 10,
                                  &shown, &found, threads);
    size_t pixels = (size_t)l->width * (size_t)l->height;
    uint64_t hash = hash_met(hash_bytes(HASH_START, (const uint8_t *)&casts, sizeof casts), &m, pixels);
    return take(take(hash, t, m.source, 0, threads), t, m.source, 1, threads);
}

static uint64_t trace(const void *input, e3d_backend backend, int32_t threads)
{
    e3d_tree *trees[2] = {e3d_tree_create(), e3d_tree_create()}, *nodes = e3d_tree_create();
    (void)backend;
    uint64_t hash = trees[0] && trees[1] && nodes ? find(input, trees, nodes, threads) : 0;
    for (int k = 0; k < 2; k++)
        if (trees[k])
            e3d_tree_destroy(trees[k]);
    if (nodes)
        e3d_tree_destroy(nodes);
    return hash;
}

outcome compare_lens_rays(random_stream r, const run_plan *plan, const char *title)
{
    static traced t;
    random_looks(&r, &t.looks);
    random_world(&r, &t);
    random_shown(&r, &t);
    random_rays(&r, &t);
    return compare_thread_counts(trace, &t, plan, title);
}
