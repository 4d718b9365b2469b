/* Lens: which face each pixel's own ray meets, found among what the pinhole pictures show near it (docs/exactness, R206, R207).
 *
 * In: IDs and depths of the pinhole pictures, the rays of the lens's pixels. Out: IDs, distances, barycentric coordinates.
 * The faces that show at the pixels around a ray are tested exactly, as rays are cast. A ray is cast into the scene only
 * where something nearer shows beside it that it misses, unless that hangs together with what it meets.
 */
#include "e3d_lens.h"

#include <stddef.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "scene/crossing.h"
#include "scene/pose.h"

enum { BAND = 16,   /* rows of a task */
       NEAR = 16,
       INNER = 4,  /* pixels around a ray */
       HALF = 128, /* 1/256 pixel */
       KEPT = 256, /* faces, a power of two */
       LAYERS = 16 }; /* that a ray passes through */

/* How far before and behind what shows beside a ray it is searched, over its depth. */
static const double BESIDE = 1.0 / 16;

/* A face in the world: its corners, and its plane from the eye. */
typedef struct placed {
    int32_t object, instance, face;
    int32_t slot; /* -1: rays do not know it */
    double corners[3][3];
    double normal[3], offset; /* the normal in camera space */
    size_t used; /* by which pixel, counted from 1 */
} placed;

/* A face that shows near the ray. */
typedef struct candidate {
    int32_t object, instance, face, slot;
    int32_t source;
    double depth;
    const placed *at;
    int reached, is_inner; /* the latter: it shows at one of the inner pixels */
} candidate;

/* The faces that were looked at last. */
typedef struct recent {
    placed faces[KEPT], spare[NEAR];
} recent;

typedef struct job {
    const e3d_lens_scene *scene;
    const e3d_lens_face *faces;
    const e3d_lens_pixel *pixels;
    const double *rays;
    int32_t width, height;
    double world[12], eye[3], near, far;
    int is_rigid;    /* a unit in camera space is one in the world */
    int needs_place; /* of a face that shows all around: more than IDs is asked for */
    const e3d_lens_shown *shown;
    const e3d_lens_found *found;
    int64_t *cast; /* by band */
} job;

/* What one pixel looks along. */
typedef struct sight {
    e3d_aim aim;
    double stretch;      /* camera-space distance of a unit of the world */
    double slope;        /* depth along the face's axis of a unit of camera space */
} sight;

static int32_t slot_of(const e3d_lens_scene *s, int32_t id)
{
    int32_t low = 0, high = s->id_count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (s->ids[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->id_count && s->ids[low] == id ? s->slots[low] : -1;
}

/* The shape that a slot draws; NULL if rays do not know it. */
static const e3d_shape *shape_of(const e3d_lens_scene *s, int32_t slot)
{
    int32_t object = slot < 0 ? -1 : s->graph->object[slot];
    if (object < 0 || object >= s->shape_count || !s->shapes[object].known)
        return 0;
    return s->shapes + object;
}

/* Finds where a face is; its slot becomes -1 if rays do not know it. */
static void place(const job *j, const candidate *c, placed *to)
{
    const e3d_graph *graph = j->scene->graph;
    int32_t slot = slot_of(j->scene, c->object);
    const e3d_shape *shape = c->face < 0 ? 0 : shape_of(j->scene, slot);
    double world[12], pose[12], sides[2][3];
    *to = (placed){.object = c->object, .instance = c->instance, .face = c->face, .slot = -1};
    if (!shape || c->face >= shape->face_count)
        return;
    if (shape->pose_kind == E3D_POSE_NONE) {
        memcpy(world, e3d_placing_pose(graph->world, graph->anchor, slot), sizeof world);
    } else {
        if (c->instance < 0 || c->instance >= shape->instances ||
            !e3d_instance_pose(shape->poses, shape->pose_kind, c->instance, pose))
            return;
        e3d_pose_multiply(graph->world + 12 * (size_t)slot, pose, world);
    }
    to->slot = slot;
    for (int i = 0; i < 3; i++)
        e3d_place_corner(shape, world, c->face, i, to->corners[i]);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++)
            sides[i][k] = to->corners[i + 1][k] - to->corners[0][k];
    double normal[3];
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        normal[k] = sides[0][l] * sides[1][m] - sides[0][m] * sides[1][l];
    }
    const double from[3] = {to->corners[0][0] - j->eye[0], to->corners[0][1] - j->eye[1],
                            to->corners[0][2] - j->eye[2]};
    to->offset = e3d_dot3(normal, from);
    for (int k = 0; k < 3; k++)
        to->normal[k] = (j->world[k] * normal[0] + j->world[4 + k] * normal[1]) + j->world[8 + k] * normal[2];
}

/* Returns where a candidate is; n: its number among those of this pixel. */
static const placed *placed_of(const job *j, const candidate *c, recent *kept, size_t pixel, int n)
{
    uint32_t hash = (uint32_t)c->face * 31u + (uint32_t)c->instance * 17u + (uint32_t)c->object * 101u;
    placed *at = kept->faces + (hash & (KEPT - 1));
    if (at->object != c->object || at->instance != c->instance || at->face != c->face) {
        if (at->used == pixel)
            at = kept->spare + n;
        place(j, c, at);
    }
    at->used = pixel;
    return at;
}

static int is_same(const candidate *a, const candidate *b)
{
    return a->object == b->object && a->instance == b->instance && a->face == b->face;
}

static int touch(const candidate *a, const candidate *b)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (!memcmp(a->at->corners[i], b->at->corners[k], sizeof a->at->corners[i]))
                return 1;
    return 0;
}

static void show(const job *j, int32_t source, candidate *c)
{
    c->object = j->shown->object_id[source];
    c->instance = j->shown->instance_id[source];
    c->face = j->shown->face_id[source];
    c->depth = (double)j->shown->depth[source];
    c->source = source;
    c->reached = 0;
}

/* Where a pixel of the lens looks on its face. */
typedef struct spot {
    const e3d_lens_face *face;
    int32_t x, y;      /* the pixel that the ray passes */
    int32_t left, top; /* the first of the four whose centres lie around the ray */
} spot;

static spot spot_of(const job *j, size_t i)
{
    const e3d_lens_pixel *p = j->pixels + i;
    return (spot){j->faces + p->face, p->x >> 8, p->y >> 8, (p->x - HALF) >> 8, (p->y - HALF) >> 8};
}

static int64_t pixel_of(const spot *at, int32_t x, int32_t y) { return at->face->start + (int64_t)y * at->face->width + x; }

typedef int32_t v4i __attribute__((vector_size(16)));

static inline v4i load4(const int32_t *from)
{
    v4i four;
    memcpy(&four, from, sizeof four);
    return four;
}

/* Returns whether the sixteen pixels around a ray show one object, or nothing. */
static inline int is_inside(const job *j, const spot *at)
{
    const int32_t *one = j->shown->object_id + pixel_of(at, at->left - 1, at->top - 1);
    ptrdiff_t row = at->face->width;
    v4i here = (v4i){} + one[0];
    v4i differ = ((load4(one) ^ here) | (load4(one + row) ^ here)) |
                 ((load4(one + 2 * row) ^ here) | (load4(one + 3 * row) ^ here));
    return !((differ[0] | differ[1]) | (differ[2] | differ[3]));
}

/* Returns whether the four pixels around a ray show one number. */
static inline int is_one(const int32_t *first, ptrdiff_t row)
{
    return !(((first[0] ^ first[1]) | (first[0] ^ first[row])) | (first[0] ^ first[row + 1]));
}

/* Gathers the faces around a ray, that of the pixel it passes first; returns how many. *nothing: a pixel that shows none. */
static int gather(const job *j, size_t i, const spot *at, int around, candidate list[NEAR], recent *kept, int32_t *nothing)
{
    /* From the inner pixel nearest to the ray, the ray being to its right and below: the inner four, then those around. */
    static const int8_t AROUND[NEAR][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 0}, {0, -1}, {-1, 1}, {1, -1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {-1, -1}, {2, -1}, {-1, 2}, {2, 2}};
    int32_t x_way = at->x == at->left ? 1 : -1, y_way = at->y == at->top ? 1 : -1;
    int count = 0;
    for (int n = 0; n < around; n++) {
        int32_t x = at->x + x_way * AROUND[n][0], y = at->y + y_way * AROUND[n][1], known = 0;
        candidate *c = list + count;
        show(j, (int32_t)pixel_of(at, x, y), c);
        if (c->object < 0) {
            *nothing = *nothing < 0 ? c->source : *nothing;
            if (n)
                continue;
        }
        for (int k = 0; k < count && !known; k++)
            known = is_same(list + k, c);
        if (known)
            continue;
        c->is_inner = n < INNER;
        c->at = c->object < 0 ? 0 : placed_of(j, c, kept, i + 1, count);
        c->slot = c->at ? c->at->slot : -1;
        count++;
    }
    return count;
}

/* Marks what hangs together with a candidate, by corners that they share. */
static void reach(candidate *list, int count, int from)
{
    int8_t waiting[NEAR], top = 0;
    list[from].reached = 1;
    waiting[top++] = (int8_t)from;
    while (top) {
        const candidate *at = list + waiting[--top];
        for (int i = 0; i < count; i++)
            if (!list[i].reached && list[i].slot == at->slot && list[i].instance == at->instance &&
                list[i].slot >= 0 && touch(at, list + i)) {
                list[i].reached = 1;
                waiting[top++] = (int8_t)i;
            }
    }
}

/* Where a ray ends, so far. */
typedef struct end {
    int which; /* of the candidates; -1: none */
    e3d_crossing at;
} end;

static int comes_first(const candidate *a, const candidate *b)
{
    if (a->slot != b->slot)
        return a->slot < b->slot;
    return a->instance != b->instance ? a->instance < b->instance : a->face < b->face;
}

static end nearest_of(const job *j, const sight *s, const candidate *list, int count)
{
    end best = {-1, {.distance = INFINITY}};
    for (int i = 0; i < count; i++) {
        e3d_crossing at;
        /* What has holes counts only where the pixel shows it. */
        if (list[i].slot < 0 || (i && !j->scene->solid[list[i].slot]) ||
            !e3d_cross_triangle(&s->aim, list[i].at->corners, &at))
            continue;
        double depth = at.distance * s->stretch * s->slope;
        if (!(depth >= j->near && depth <= j->far))
            continue;
        if (at.distance < best.at.distance ||
            (best.which >= 0 && at.distance == best.at.distance && comes_first(list + i, list + best.which)))
            best = (end){i, at};
    }
    return best;
}

/* Returns whether something nearer than the end shows beside the ray, and does not hang together with it. */
static int is_doubtful(const sight *s, candidate *list, int count, const end *best)
{
    double depth = best->which < 0 ? INFINITY : best->at.distance * s->stretch * s->slope;
    int nearer = 0;
    for (int i = 0; i < count; i++)
        nearer += i != best->which && list[i].slot >= 0 && list[i].is_inner && list[i].depth < depth;
    if (!nearer)
        return 0;
    if (best->which < 0)
        return 1;
    reach(list, count, best->which);
    for (int i = 0; i < count; i++)
        if (i != best->which && list[i].slot >= 0 && list[i].is_inner && list[i].depth < depth &&
            !list[i].reached)
            return 1;
    return 0;
}

static inline void write_ids(const job *j, size_t i, int32_t source, int32_t object, int32_t instance, int32_t face)
{
    const e3d_lens_found *f = j->found;
    if (f->source)
        f->source[i] = source;
    if (f->object_id)
        f->object_id[i] = object;
    if (f->instance_id)
        f->instance_id[i] = instance;
    if (f->face_id)
        f->face_id[i] = face;
}

static inline void write_distance(const job *j, size_t i, double distance)
{
    const e3d_lens_found *f = j->found;
    if (f->depth)
        f->depth[i] = f->is_along_axis && distance > 0 ? (float)(distance * -j->rays[3 * i + 2]) : (float)distance;
    if (f->range)
        f->range[i] = (float)distance;
    if (f->distance)
        f->distance[i] = distance;
}

static void write(const job *j, size_t i, const candidate *c, double distance, const double weight[3], double sum)
{
    const e3d_lens_found *f = j->found;
    write_ids(j, i, c->source, c->object, c->instance, c->face);
    write_distance(j, i, distance);
    if (!f->barycentric)
        return;
    f->exact[i] = weight != 0;
    for (int k = 0; k < 3; k++)
        f->barycentric[3 * i + k] = weight ? (float)(weight[k] / sum) : 0;
}

static void write_nothing(const job *j, size_t i, int32_t source)
{
    const candidate none = {.object = -1, .instance = -1, .face = -1, .source = source};
    write(j, i, &none, 0, 0, 1);
}

/* Takes the pixel that the ray passes as it is. */
static void write_pixel(const job *j, size_t i, const sight *s, const candidate *c)
{
    if (c->object < 0)
        write_nothing(j, i, c->source);
    else
        write(j, i, c, c->depth / s->slope, 0, 1);
}

static int shows(const job *j, const candidate *list, int count, const e3d_hit *hit)
{
    candidate met = {.object = j->scene->graph->id[hit->slot], .instance = hit->instance, .face = hit->face};
    for (int k = 0; k < count; k++)
        if (is_same(list + k, &met))
            return 1;
    return 0;
}

/* Takes what a cast ray met: values are those of the nearest pixel that shows it, or else the same object. */
static void write_hit(const job *j, size_t i, const sight *s, const e3d_hit *hit, const candidate *list, int count)
{
    candidate met = {.object = j->scene->graph->id[hit->slot], .instance = hit->instance, .face = hit->face};
    int same = -1, alike = 0;
    for (int k = count - 1; k >= 0; k--) {
        same = is_same(list + k, &met) ? k : same;
        alike = list[k].object == met.object ? k : alike;
    }
    met.source = list[same >= 0 ? same : alike].source;
    write(j, i, &met, hit->distance * s->stretch, hit->barycentric, 1);
}

/* The part of a ray in which something that hangs together with what shows beside it may lie. */
typedef struct span {
    double from, to;
} span;

static span span_of(const job *j, const sight *s, const candidate *list, int count, const end *best)
{
    double depth = best->which < 0 ? INFINITY : best->at.distance * s->stretch * s->slope;
    double scale = s->stretch * s->slope, least = j->far, most = j->near;
    for (int i = 0; i < count; i++) {
        if (list[i].slot < 0 || i == best->which || !(list[i].depth < depth))
            continue;
        least = list[i].depth < least ? list[i].depth : least;
        most = list[i].depth > most ? list[i].depth : most;
    }
    least *= 1 - BESIDE;
    most *= 1 + BESIDE;
    least = least > j->near ? least : j->near;
    most = most < j->far ? most : j->far;
    most = most < depth ? most : depth;
    return (span){least / scale, most / scale};
}

/* Casts a ray against what a node shows within a span, through what is not sure to show; returns whether it met something. */
static int cast(const job *j, const sight *s, int32_t slot, span within, const candidate *list, int count, e3d_hit *hit)
{
    const e3d_lens_scene *all = j->scene;
    for (int layer = 0; layer < LAYERS && within.from <= within.to; layer++) {
        double origin[3];
        for (int k = 0; k < 3; k++)
            origin[k] = j->eye[k] + s->aim.direction[k] * within.from;
        e3d_node_ray(all->graph, all->shapes, all->shape_count, slot, origin, s->aim.direction, within.to - within.from,
                     hit);
        if (hit->slot < 0)
            return 0;
        hit->distance += within.from;
        if ((all->solid[slot] && all->any_side) || shows(j, list, count, hit))
            return 1;
        within.from = hit->distance * (1 + 1e-12);
    }
    return 0;
}

/* Casts a ray against all nodes that show nearer beside it; returns whether it wrote the pixel. */
static int cast_all(const job *j, size_t i, const sight *s, const candidate *list, int count, const end *best)
{
    span within = span_of(j, s, list, count, best);
    e3d_hit nearest = {.slot = -1};
    for (int k = 0; k < count; k++) {
        e3d_hit hit;
        int known = list[k].slot < 0 || k == best->which;
        for (int n = 0; n < k && !known; n++)
            known = n != best->which && list[n].slot == list[k].slot;
        if (known || !cast(j, s, list[k].slot, within, list, count, &hit))
            continue;
        if (nearest.slot < 0 || hit.distance < nearest.distance ||
            (hit.distance == nearest.distance && hit.slot < nearest.slot))
            nearest = hit;
    }
    if (nearest.slot >= 0)
        write_hit(j, i, s, &nearest, list, count);
    return nearest.slot >= 0;
}

static sight sight_of(const job *j, size_t i)
{
    const double *ray = j->rays + 3 * i, *m = j->world;
    double direction[3], stretch = 1;
    for (int r = 0; r < 3; r++)
        direction[r] = (m[4 * r] * ray[0] + m[4 * r + 1] * ray[1]) + m[4 * r + 2] * ray[2];
    if (!j->is_rigid) {
        stretch = 1 / sqrt(e3d_dot3(direction, direction));
        for (int r = 0; r < 3; r++)
            direction[r] *= stretch;
    }
    double slope = -e3d_dot3(ray, j->faces[j->pixels[i].face].axes[2]);
    return (sight){.aim = e3d_aim_of(j->eye, direction), .stretch = stretch, .slope = slope};
}

/* Writes a pixel all around which one face shows (R271). */
static void write_one(const job *j, size_t i, int32_t source, recent *kept)
{
    candidate c;
    show(j, source, &c);
    if (!j->needs_place) {
        write_ids(j, i, source, c.object, c.instance, c.face);
        return;
    }
    c.at = placed_of(j, &c, kept, i + 1, 0);
    double distance = c.at->slot < 0 ? 0 : c.at->offset / e3d_dot3(c.at->normal, j->rays + 3 * i);
    if (!(distance > 0 && distance < INFINITY)) {
        sight s = sight_of(j, i);
        write_pixel(j, i, &s, &c);
        return;
    }
    e3d_crossing at = {.sum = 1};
    int is_crossed = 0;
    if (j->found->barycentric) {
        sight s = sight_of(j, i);
        is_crossed = e3d_cross_triangle(&s.aim, c.at->corners, &at);
    }
    write(j, i, &c, distance, is_crossed ? at.weight : 0, at.sum);
}

/* Finds what the ray of a pixel meets beside which several faces show; returns whether the ray was cast. */
static int search(const job *j, size_t i, const spot *at, int around, recent *kept)
{
    candidate list[NEAR];
    int32_t nothing = -1;
    int count = gather(j, i, at, around, list, kept, &nothing);
    sight s = sight_of(j, i);
    if (list[0].object >= 0 && list[0].slot < 0) { /* a line, a point, a level of detail */
        write_pixel(j, i, &s, list);
        return 0;
    }
    end best = nearest_of(j, &s, list, count);
    int is_cast = is_doubtful(&s, list, count, &best) || (best.which < 0 && nothing < 0);
    if (is_cast && cast_all(j, i, &s, list, count, &best))
        return 1;
    if (best.which >= 0)
        write(j, i, list + best.which, best.at.distance * s.stretch, best.at.weight, best.at.sum);
    else if (nothing >= 0 && list[0].slot >= 0 && j->scene->solid[list[0].slot] && j->scene->any_side)
        write_nothing(j, i, nothing); /* the ray passes beside all that shows */
    else
        write_pixel(j, i, &s, list);
    return is_cast;
}

/* Finds what a pixel's ray meets; returns whether the ray was cast. Four pixels are enough within an object, and sixteen are
 * looked at where it ends. */
static int find_pixel(const job *j, size_t i, recent *kept)
{
    if (j->pixels[i].face < 0) {
        write_nothing(j, i, -1);
        return 0;
    }
    spot at = spot_of(j, i);
    if (!is_inside(j, &at))
        return search(j, i, &at, NEAR, kept);
    int64_t inner = pixel_of(&at, at.left, at.top);
    int32_t source = (int32_t)pixel_of(&at, at.x, at.y);
    if (j->shown->object_id[inner] < 0)
        write_nothing(j, i, source);
    else if (is_one(j->shown->face_id + inner, at.face->width) && is_one(j->shown->instance_id + inner, at.face->width))
        write_one(j, i, source, kept);
    else
        return search(j, i, &at, INNER, kept);
    return 0;
}

static void find_band(void *argument, int band)
{
    job *j = argument;
    int32_t first = band * BAND, last = first + BAND < j->height ? first + BAND : j->height;
    e3d_fpenv saved = e3d_fpenv_enter();
    recent kept;
    int64_t casts = 0;
    for (int k = 0; k < KEPT; k++)
        kept.faces[k] = (placed){.object = -1, .instance = -1, .face = -1, .slot = -1};
    for (size_t i = (size_t)first * (size_t)j->width; i < (size_t)last * (size_t)j->width; i++)
        casts += find_pixel(j, i, &kept);
    j->cast[band] = casts;
    e3d_fpenv_leave(saved);
}

/* Returns whether a pose turns and moves only, as far as rounding lets it. */
static int is_rigid(const double pose[16])
{
    double most = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b <= a; b++) {
            double sum = (pose[a] * pose[b] + pose[4 + a] * pose[4 + b]) + pose[8 + a] * pose[8 + b];
            most = fabs(sum - (a == b)) > most ? fabs(sum - (a == b)) : most;
        }
    return most < 1e-14;
}

int64_t e3d_lens_find(const e3d_lens_scene *scene, const e3d_lens_face *faces, const e3d_lens_pixel *pixels,
                      const double *rays, int32_t width, int32_t height, const double world_from_view[16],
                      double near, double far, const e3d_lens_shown *shown, const e3d_lens_found *found,
                      int threads)
{
    enum { MOST_BANDS = 16384 / BAND };
    int64_t casts[MOST_BANDS], sum = 0;
    int bands = (height + BAND - 1) / BAND;
    job j = {.scene = scene,
             .faces = faces,
             .pixels = pixels,
             .rays = rays,
             .width = width,
             .height = height,
             .near = near,
             .far = far,
             .shown = shown,
             .found = found,
             .cast = casts};
    memcpy(j.world, world_from_view, sizeof j.world);
    for (int k = 0; k < 3; k++)
        j.eye[k] = world_from_view[4 * k + 3];
    e3d_fpenv saved = e3d_fpenv_enter();
    j.is_rigid = is_rigid(world_from_view);
    e3d_fpenv_leave(saved);
    j.needs_place = found->depth || found->range || found->distance || found->barycentric;
    e3d_pool_share(threads, bands, find_band, &j);
    for (int b = 0; b < bands; b++)
        sum += casts[b];
    return sum;
}
