/* The order in which clusters take a mesh's triangles: those that lie together and face alike stand together.
 *
 * In:  a checked mesh description, the box of its finite vertices.
 * Out: the faces, sorted by the cell of a coarse grid along a Morton curve, then by the side that they face, then by a fine
 *      grid; thin ones, whose facing is least certain, stand apart.
 * Always: the same arrays give the same order on any number of threads. A stable radix sort, most significant digit
 *      first: ranges of faces are sorted into buckets, then each bucket by itself, in cache.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "data/mesh/clusters.h"
#include "base/pool.h"
#include "data/triangles.h"

typedef struct keyed {
    uint32_t key;
    int32_t face;
} keyed;

enum {
    GRID_BITS = 9,      /* cells an axis: 512 */
    FACES_A_CELL = 512, /* aim: about so many in a cell of the coarse grid */
    SIDE_BITS = 3,
    KEY_BITS = 3 * GRID_BITS + SIDE_BITS,
    DIGIT_BITS = 10,
    DIGITS = 1 << DIGIT_BITS,
    BUCKET_FACES = 4096, /* aim: about so many in a bucket */
    RANGE_FACES = 16384, /* a range has at least so many, */
    MOST_RANGES = 256
};

typedef struct order {
    const e3d_mesh_desc *desc;
    int32_t *faces;
    float lo[3], scale;
    int coarse;            /* bits an axis */
    int low_bits;          /* how many bits of a key lie below the bucket's number */
    int32_t buckets, range_faces, ranges;
    keyed *keys, *sorted;  /* in the order of the mesh; sorted by bucket */
    uint32_t *starts;      /* [range][bucket]: where the range's faces of a bucket begin in `sorted` */
    uint32_t *bucket_ends;
} order;

/* ---- keys ---- */

static void gather(const e3d_mesh_desc *d, int32_t first, int count, e3d_triangles *out)
{
    const int32_t *corners = d->faces + 3 * (size_t)first;
    for (int t = 0; t < count; t++)
        for (int k = 0; k < 3; k++) {
            const float *p = d->positions + 3 * (size_t)corners[3 * t + k];
            for (int axis = 0; axis < 3; axis++)
                out->corner[k][axis][t] = p[axis];
        }
}

/* Spreads the bits of v: two zeros follow each. */
static inline int4 spread(int4 v)
{
    v = (v | v << 16) & 0x030000FF;
    v = (v | v << 8) & 0x0300F00F;
    v = (v | v << 4) & 0x030C30C3;
    return (v | v << 2) & 0x09249249;
}

/* A NaN is in cell 0. */
static inline int4 cell_of(float4 v, float lo, float scale)
{
    float4 cell = more_of((v - splat(lo)) * splat(scale), splat(0));
    return __builtin_convertvector(less_of(cell, splat((1 << GRID_BITS) - 1)), int4);
}

/* The side that a triangle faces, one of six, by the greatest component of its normal; 6: it is thin, with a longest edge of
 * more than eight times the altitude. */
static inline int4 side_of(const e3d_areas *areas)
{
    float4 along = areas->normal[0], most = size_of(along);
    int4 side = {0, 0, 0, 0};
    for (int k = 1; k < 3; k++) {
        float4 size = size_of(areas->normal[k]);
        int4 more = size > most;
        side = choose_bits(more, side * 0 + 2 * k, side);
        along = choose(more, areas->normal[k], along);
        most = more_of(size, most);
    }
    side -= along < splat(0); /* true is -1 */
    return choose_bits(splat(64) * areas->square > areas->longest * areas->longest, side, side * 0 + 6);
}

static inline int4 key_of(const order *o, const e3d_triangles *triangles, int t)
{
    int4 cell = {0, 0, 0, 0};
    int fine = 3 * (GRID_BITS - o->coarse);
    for (int k = 0; k < 3; k++) {
        float4 sum = load4(triangles->corner[0][k] + t) + load4(triangles->corner[1][k] + t) +
                     load4(triangles->corner[2][k] + t);
        cell |= spread(cell_of(sum / splat(3), o->lo[k], o->scale)) << k;
    }
    e3d_areas areas = e3d_areas_of(triangles, t, o->scale);
    return ((cell >> fine) << SIDE_BITS | side_of(&areas)) << fine | (cell & ((1 << fine) - 1));
}

/* The end of the range that begins with a face. */
static int32_t range_end(const order *o, int32_t first)
{
    return o->range_faces < o->desc->faces_count - first ? first + o->range_faces : o->desc->faces_count;
}

static void key_range(void *argument, int range)
{
    const order *o = argument;
    int32_t first = range * o->range_faces, end = range_end(o, first);
    uint32_t *counts = o->starts + (size_t)range * (size_t)o->buckets;
    e3d_triangles triangles;
    memset(&triangles, 0, sizeof triangles);
    for (; first < end; first += E3D_CLUSTER_TRIANGLES) {
        int count = end - first < E3D_CLUSTER_TRIANGLES ? end - first : E3D_CLUSTER_TRIANGLES;
        gather(o->desc, first, count, &triangles);
        for (int t = 0; t < count; t += 4) {
            int4 key = key_of(o, &triangles, t);
            for (int i = 0; i < 4 && t + i < count; i++) {
                o->keys[first + t + i] = (keyed){(uint32_t)key[i], first + t + i};
                counts[key[i] >> o->low_bits]++;
            }
        }
    }
}

/* ---- sorting ---- */

/* Turns the counts of each bucket in each range into the places of its faces. */
static void place_buckets(order *o)
{
    uint32_t total = 0;
    for (int32_t b = 0; b < o->buckets; b++) {
        for (int32_t r = 0; r < o->ranges; r++) {
            uint32_t *start = &o->starts[(size_t)r * (size_t)o->buckets + (size_t)b], count = *start;
            *start = total;
            total += count;
        }
        o->bucket_ends[b] = total;
    }
}

static void scatter_range(void *argument, int range)
{
    const order *o = argument;
    int32_t first = range * o->range_faces, end = range_end(o, first);
    uint32_t *start = o->starts + (size_t)range * (size_t)o->buckets;
    for (int32_t i = first; i < end; i++)
        o->sorted[start[o->keys[i].key >> o->low_bits]++] = o->keys[i];
}

/* One pass of a stable radix sort; the last pass writes only the faces. */
static void sort_digit(const keyed *from, keyed *to, int32_t *faces, uint32_t count, int shift)
{
    uint32_t start[DIGITS] = {0}, total = 0;
    for (uint32_t i = 0; i < count; i++)
        start[from[i].key >> shift & (DIGITS - 1)]++;
    for (int b = 0; b < DIGITS; b++) {
        uint32_t here = start[b];
        start[b] = total;
        total += here;
    }
    if (faces)
        for (uint32_t i = 0; i < count; i++)
            faces[start[from[i].key >> shift & (DIGITS - 1)]++] = from[i].face;
    else
        for (uint32_t i = 0; i < count; i++)
            to[start[from[i].key >> shift & (DIGITS - 1)]++] = from[i];
}

static void sort_bucket(void *argument, int bucket)
{
    const order *o = argument;
    uint32_t first = bucket ? o->bucket_ends[bucket - 1] : 0, count = o->bucket_ends[bucket] - first;
    keyed *from = o->sorted + first, *to = o->keys + first;
    int shift = 0;
    for (; count && shift + DIGIT_BITS < o->low_bits; shift += DIGIT_BITS) {
        sort_digit(from, to, NULL, count, shift);
        keyed *other = from;
        from = to;
        to = other;
    }
    if (count)
        sort_digit(from, to, o->faces + first, count, shift);
}

/* ---- all of it ---- */

static float longest_side(const float lo[3], const float hi[3])
{
    float size = 0;
    for (int k = 0; k < 3; k++)
        size = hi[k] - lo[k] > size ? hi[k] - lo[k] : size;
    return size;
}

static int compare_floats(const void *a, const void *b)
{
    float x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

/* Finds the box of most faces from the corners of some of them. The other faces go into the cells at its border. */
static void find_middle(const e3d_mesh_desc *d, float lo[3], float hi[3])
{
    enum { SAMPLES = 1024,
           BEYOND = 32 }; /* on either side one face in so many may lie farther out */
    float samples[3][SAMPLES + 1];
    int32_t step = d->faces_count / SAMPLES + 1;
    int count = 0;
    for (int64_t face = 0; face < d->faces_count; face += step) {
        const float *p = d->positions + 3 * (size_t)d->faces[3 * face];
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
            continue;
        for (int k = 0; k < 3; k++)
            samples[k][count] = p[k];
        count++;
    }
    for (int k = 0; k < 3 && count; k++) {
        qsort(samples[k], (size_t)count, sizeof(float), compare_floats);
        lo[k] = samples[k][count / BEYOND];
        hi[k] = samples[k][count - 1 - count / BEYOND];
    }
}

/* Shrinks a box to the part that holds most of the mesh: otherwise a single vertex a million units away would put all faces
 * into one cell. */
static void leave_out_far(const e3d_mesh_desc *d, float lo[3], float hi[3])
{
    enum { FAR = 8 };
    float inner_lo[3] = {0, 0, 0}, inner_hi[3] = {0, 0, 0};
    find_middle(d, inner_lo, inner_hi);
    float size = longest_side(inner_lo, inner_hi);
    if (!(size > 0) || !(longest_side(lo, hi) > FAR * size))
        return;
    float margin = 0.25f * size;
    for (int k = 0; k < 3; k++) {
        lo[k] = inner_lo[k] - margin > lo[k] ? inner_lo[k] - margin : lo[k];
        hi[k] = inner_hi[k] + margin < hi[k] ? inner_hi[k] + margin : hi[k];
    }
}

static void set_grid(order *o, const float mesh_lo[3], const float mesh_hi[3])
{
    float lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        lo[k] = mesh_lo[k];
        hi[k] = mesh_hi[k];
    }
    leave_out_far(o->desc, lo, hi);
    memcpy(o->lo, lo, sizeof lo);
    float size = longest_side(lo, hi);
    o->scale = size > 0 ? (1 << GRID_BITS) / size : 0;
    while (o->coarse < GRID_BITS && (int64_t)FACES_A_CELL << (2 * (o->coarse + 1)) <= o->desc->faces_count)
        o->coarse++; /* a surface touches about 4^n of 8^n cells */
}

static void set_sizes(order *o)
{
    int32_t count = o->desc->faces_count;
    int bits = 0;
    while (bits < DIGIT_BITS && count >> bits > BUCKET_FACES)
        bits++;
    o->low_bits = KEY_BITS - bits;
    o->buckets = 1 << bits;
    o->range_faces = (count / MOST_RANGES / E3D_CLUSTER_TRIANGLES + 1) * E3D_CLUSTER_TRIANGLES;
    o->range_faces = o->range_faces < RANGE_FACES ? RANGE_FACES : o->range_faces;
    o->ranges = (count + o->range_faces - 1) / o->range_faces;
}

int e3d_order_faces(const e3d_mesh_desc *desc, const float lo[3], const float hi[3], int threads, int32_t *faces)
{
    order o = {.desc = desc, .faces = faces};
    set_grid(&o, lo, hi);
    set_sizes(&o);
    size_t starts = (size_t)o.ranges * (size_t)o.buckets;
    o.keys = malloc(2 * (size_t)desc->faces_count * sizeof *o.keys);
    o.starts = calloc(starts + (size_t)o.buckets, sizeof *o.starts);
    if (!o.keys || !o.starts) {
        free(o.keys);
        free(o.starts);
        return 0;
    }
    o.sorted = o.keys + desc->faces_count;
    o.bucket_ends = o.starts + starts;
    e3d_pool_share(threads, o.ranges, key_range, &o);
    place_buckets(&o);
    e3d_pool_share(threads, o.ranges, scatter_range, &o);
    e3d_pool_share(threads, o.buckets, sort_bucket, &o);
    free(o.keys);
    free(o.starts);
    return 1;
}
