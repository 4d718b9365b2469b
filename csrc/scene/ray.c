/* ray: the nearest triangle of a scene on a ray, through trees of nodes, of instances and of triangles.
 *
 * In:  a unit direction, so that distances are those of the ray's parameter in every space. Out: a hit.
 * Method: boxes by slabs (Kay and Kajiya 1986), nearest first, in f64 and a little wider than they are;
 * triangles in the world by Woop, Benthin and Wald 2013: along the ray they are flat, and the sign of a
 * difference of two products is right or zero, which counts as inside: no ray slips between neighbours.
 * Equal distances go to the first in the order of drawing.
 */
#include <math.h>
#include <string.h>

#include "base/fpenv.h"
#include "scene/crossing.h"
#include "scene/pose.h"
#include "scene/tree.h"

/* Two lanes, as all processors have them: compilers take wider vectors apart, through memory. */
typedef double v2d __attribute__((vector_size(16)));
typedef int64_t v2l __attribute__((vector_size(16)));
typedef float v2f __attribute__((vector_size(8)));

static const double FAR = 1e290, PAD = 1e-10;

typedef struct ray {
    double origin[3], direction[3], inverse[3];
} ray;

/* A search: its ray and trees, and the nearest hit so far. */
typedef struct search {
    const e3d_graph *graph;
    const e3d_shape *shapes;
    int32_t shape_count;
    int cull;
    ray ray; /* in the world */
    e3d_aim aim;
    double world[12];
    int32_t slot, instance, missing;
    const e3d_shape *shape;
    e3d_hit *hit;
    uint64_t *bits; /* for a search of boxes alone */
} search;

typedef void meet(search *s, int32_t item);

static ray make_ray(const double origin[3], const double direction[3])
{
    ray r;
    for (int k = 0; k < 3; k++) {
        r.origin[k] = origin[k];
        r.direction[k] = direction[k];
        r.inverse[k] = direction[k] == 0 ? 1e300 : 1 / direction[k];
    }
    return r;
}

/* ---- boxes ---- */

typedef struct entry {
    double near;
    int32_t block;
    int level;
} entry;

static inline v2d half_of(const e3d_v4 *four, int half)
{
    v2f two;
    memcpy(&two, (const float *)four + 2 * half, sizeof two);
    return __builtin_convertvector(two, v2d);
}

/* Returns bits for two lanes of a block, set if the ray meets their box within `most`; near: the distance at which it enters. */
static inline int enter_half(const ray *r, const e3d_block *b, int half, double pad, double most, double near[2])
{
    v2d in = {0}, out = in + most;
    for (int k = 0; k < 3; k++) {
        int up = r->inverse[k] >= 0;
        v2d low = half_of(&b->low[k], half) - pad, high = half_of(&b->high[k], half) + pad;
        v2d first = ((up ? low : high) - r->origin[k]) * r->inverse[k];
        v2d last = ((up ? high : low) - r->origin[k]) * r->inverse[k];
        v2l later = first > in, sooner = last < out;
        in = (v2d)(((v2l)first & later) | ((v2l)in & ~later));
        out = (v2d)(((v2l)last & sooner) | ((v2l)out & ~sooner));
    }
    v2l meets = in <= out * (1 + 1e-14);
    memcpy(near, &in, sizeof in);
    return (meets[0] & 1) | (meets[1] & 2);
}

/* The same for all four. */
static int enter(const ray *r, const e3d_block *b, double pad, double most, double near[4])
{
    int met = enter_half(r, b, 0, pad, most, near) | enter_half(r, b, 1, pad, most, near + 2) << 2;
    /* A ray that is not finite meets everything except empty boxes. */
    return met & lanes_of(b->low[0] <= b->high[0]);
}

static double pad_of(const e3d_tree *t, const ray *r)
{
    const e3d_block *top = e3d_tree_level(t, t->levels - 1);
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = fabs(r->origin[k]) > most ? fabs(r->origin[k]) : most;
    for (int lane = 0; lane < 4; lane++)
        if (top->reach[lane] < INFINITY)
            most = top->reach[lane] > most ? top->reach[lane] : most;
    return PAD * most;
}

static void walk(const e3d_tree *t, const ray *r, search *s, meet *meet_item)
{
    entry stack[E3D_TREE_STACK];
    int top = 0;
    double pad = t->levels ? pad_of(t, r) : 0;
    const int32_t *items = t->items.data, *loose = t->loose.data;
    if (t->levels)
        stack[top++] = (entry){0, 0, t->levels - 1};
    while (top) {
        entry at = stack[--top];
        double most = s->hit->distance < FAR ? s->hit->distance : FAR;
        double near[4];
        if (at.near > most)
            continue;
        int lanes = enter(r, e3d_tree_level(t, at.level) + at.block, pad, most, near), first = top;
        for (int lane = 0; lane < 4; lane++) {
            if (!(lanes >> lane & 1))
                continue;
            int place = top++; /* the nearest one comes last, and is taken first */
            for (; place > first && stack[place - 1].near < near[lane]; place--)
                stack[place] = stack[place - 1];
            stack[place] = (entry){near[lane], 4 * at.block + lane, at.level - 1};
        }
        while (at.level == 0 && top > first)
            meet_item(s, items[stack[--top].block]);
    }
    for (size_t i = 0; i < t->loose.count; i++)
        meet_item(s, loose[i]);
}

/* ---- triangles ---- */

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

#define dot e3d_dot3

static double determinant(const double m[12])
{
    const double x[3] = {m[0], m[4], m[8]}, y[3] = {m[1], m[5], m[9]}, z[3] = {m[2], m[6], m[10]};
    double c[3];
    cross(x, y, c);
    return dot(c, z);
}

static void corner_of(const search *s, int32_t face, int corner, double out[3])
{
    e3d_place_corner(s->shape, s->world, face, corner, out);
}

static int comes_first(const search *s, int32_t face, double distance)
{
    const e3d_hit *h = s->hit;
    if (distance != h->distance)
        return distance < h->distance;
    if (s->slot != h->slot)
        return h->slot < 0 || s->slot < h->slot;
    return s->instance != h->instance ? s->instance < h->instance : face < h->face;
}

/* Finds the unit normal of the front. */
static void normal_of(const search *s, double corners[3][3], double out[3])
{
    double one[3], two[3], most = 0;
    for (int k = 0; k < 3; k++) {
        one[k] = corners[1][k] - corners[0][k];
        two[k] = corners[2][k] - corners[0][k];
    }
    cross(one, two, out);
    for (int k = 0; k < 3; k++)
        most = fabs(out[k]) > most ? fabs(out[k]) : most;
    double sign = determinant(s->world) < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        out[k] = most > 0 ? sign * (out[k] / most) : 0;
    double length = sqrt(dot(out, out));
    for (int k = 0; k < 3; k++)
        out[k] = length > 0 ? out[k] / length : 0;
}

static void meet_triangle(search *s, int32_t face)
{
    double corners[3][3], normal[3];
    e3d_crossing at;
    for (int i = 0; i < 3; i++)
        corner_of(s, face, i, corners[i]);
    if (!e3d_cross_triangle(&s->aim, corners, &at))
        return;
    double distance = at.distance;
    if (!(distance >= 0 && distance <= s->hit->distance) || !comes_first(s, face, distance))
        return;
    normal_of(s, corners, normal);
    int front = dot(normal, s->ray.direction) < 0;
    if ((s->cull == E3D_CULL_BACK && !front) || (s->cull == E3D_CULL_FRONT && front))
        return;
    e3d_hit *h = s->hit;
    h->slot = s->slot;
    h->instance = s->instance;
    h->face = face;
    h->distance = distance;
    for (int k = 0; k < 3; k++) {
        h->position[k] = s->ray.origin[k] + at.place[k];
        h->normal[k] = normal[k];
        h->barycentric[k] = at.weight[k] / at.sum;
    }
}

/* ---- spaces ---- */

/* Transforms the ray into the space of a pose; 0 if the pose has no volume. */
static int into_space(const ray *r, const double m[12], ray *out)
{
    double det = determinant(m), origin[3], from[3], direction[3];
    if (det == 0 || !(fabs(det) < INFINITY))
        return 0;
    for (int k = 0; k < 3; k++)
        from[k] = r->origin[k] - m[4 * k + 3];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        const double one[3] = {m[j], m[4 + j], m[8 + j]}, two[3] = {m[k], m[4 + k], m[8 + k]};
        double row[3];
        cross(one, two, row);
        origin[i] = dot(row, from) / det;
        direction[i] = dot(row, r->direction) / det;
    }
    *out = make_ray(origin, direction);
    return 1;
}

static void meet_shape(search *s)
{
    ray local;
    if (into_space(&s->ray, s->world, &local))
        walk(s->shape->triangles, &local, s, meet_triangle);
    else
        for (int32_t face = 0; face < s->shape->face_count; face++)
            meet_triangle(s, face);
}

static void meet_instance(search *s, int32_t instance)
{
    double pose[12];
    if (!e3d_instance_pose(s->shape->poses, s->shape->pose_kind, instance, pose))
        return;
    e3d_pose_multiply(s->graph->world + 12 * (size_t)s->slot, pose, s->world);
    s->instance = instance;
    meet_shape(s);
}

static void meet_node(search *s, int32_t slot)
{
    int32_t object = s->graph->object[slot];
    const double *world = e3d_placing_pose(s->graph->world, s->graph->anchor, slot);
    ray local;
    if (!(s->graph->flags[slot] & E3D_NODE_SHOWN) || object < 0 || object >= s->shape_count)
        return;
    s->shape = &s->shapes[object];
    s->slot = slot;
    if (!s->shape->known) {
        s->missing = object;
    } else if (s->shape->pose_kind == E3D_POSE_NONE) {
        s->instance = 0;
        for (int k = 0; k < 12; k++)
            s->world[k] = world[k];
        meet_shape(s);
    } else if (into_space(&s->ray, world, &local)) {
        walk(s->shape->instance_tree, &local, s, meet_instance);
    } else {
        for (int32_t i = 0; i < s->shape->instances; i++)
            meet_instance(s, i);
    }
}

/* A search in a graph that has met nothing yet; its caller says what it culls. */
static search begin_search(const e3d_graph *graph, const e3d_shape *shapes, int32_t shape_count, const double origin[3],
                           const double direction[3], double farthest, e3d_hit *hit)
{
    *hit = (e3d_hit){.distance = farthest, .slot = -1, .instance = -1, .face = -1};
    return (search){.graph = graph,
                    .shapes = shapes,
                    .shape_count = shape_count,
                    .ray = make_ray(origin, direction),
                    .aim = e3d_aim_of(origin, direction),
                    .missing = -1,
                    .hit = hit};
}

int32_t e3d_graph_ray(const e3d_graph *graph, const e3d_tree *tree, const e3d_shape *shapes,
                      int32_t shape_count, const double origin[3], const double direction[3],
                      double farthest, e3d_cull cull, e3d_hit *hit)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    search s = begin_search(graph, shapes, shape_count, origin, direction, farthest, hit);
    s.cull = cull;
    walk(tree, &s.ray, &s, meet_node);
    e3d_fpenv_leave(saved);
    return s.missing;
}

void e3d_node_ray(const e3d_graph *graph, const e3d_shape *shapes, int32_t shape_count, int32_t slot,
                  const double origin[3], const double direction[3], double farthest, e3d_hit *hit)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    search s = begin_search(graph, shapes, shape_count, origin, direction, farthest, hit);
    s.cull = E3D_CULL_NONE;
    meet_node(&s, slot);
    e3d_fpenv_leave(saved);
}

void e3d_shape_ray(const e3d_shape *shape, const double world[12], const double origin[3],
                   const double direction[3], double farthest, e3d_cull cull, e3d_hit *hit)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    search s = {.shape = shape,
                .cull = cull,
                .ray = make_ray(origin, direction),
                .aim = e3d_aim_of(origin, direction),
                .hit = hit};
    for (int k = 0; k < 12; k++)
        s.world[k] = world[k];
    *hit = (e3d_hit){.distance = farthest, .slot = -1, .instance = -1, .face = -1};
    meet_shape(&s);
    e3d_fpenv_leave(saved);
}

static void note_item(search *s, int32_t item) { s->bits[item >> 6] |= (uint64_t)1 << (item & 63); }

void e3d_tree_ray(const e3d_tree *tree, const double origin[3], const double direction[3], double farthest,
                  uint64_t *bits)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_hit end = {.distance = farthest};
    search s = {.ray = make_ray(origin, direction), .hit = &end, .bits = bits};
    walk(tree, &s.ray, &s, note_item);
    e3d_fpenv_leave(saved);
}
