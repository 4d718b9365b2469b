/* tree: building, refitting. f64 boxes in, f32 boxes out that hold them.
 *
 * Method: a packed Hilbert R-tree (Kamel and Faloutsos 1993), four wide; Hilbert's curve by Skilling 2004.
 * Refitting renews the boxes above what moved; once they have grown too much, the order is renewed.
 */
#include "scene/tree.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/pool.h"

/* A coordinate has BITS bits; the bits of all three are sorted RADIX at a time. */
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
enum { BITS = 12,
       RADIX = 12,
       PASSES = 3 };
#else
enum { BITS = 12,
       RADIX = 4,
       PASSES = 9 }; /* small, so that thousands of small trees are built in a second */
#endif

static const double WORN = 1.7; /* the tree is built again if its cost exceeds the first one's by this factor, */
enum { LEAST_REFITS = 8 };      /* but only after so many refits, in case everything moves at random */

typedef struct key {
    uint64_t code;
    int32_t item;
} key;

e3d_tree *e3d_tree_create(void) { return calloc(1, sizeof(e3d_tree)); }

void e3d_tree_destroy(e3d_tree *t)
{
    if (!t)
        return;
    e3d_array *arrays[] = {&t->blocks, &t->items, &t->places, &t->loose,
                           &t->keys, &t->keys_too, &t->dirty, &t->marks};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        e3d_array_free(arrays[i]);
    free(t);
}

/* ---- tasks ---- */

/* The number of tasks is fixed, whatever the number of threads, so that their sums are the same. */
enum { TASKS = 16,
       FEW = 4096 };

typedef struct tree_job {
    e3d_tree *tree;
    const double *boxes;
    double cost[TASKS];
    key *keys; /* `used` of them */
    int32_t used;
    double low[TASKS][3], high[TASKS][3]; /* the bounds of the middles of the task's boxes */
} tree_job;

typedef struct task_range {
    int32_t first, end;
} task_range;

/* A task's share of some elements; each share but the last one ends at a multiple of 4. */
static task_range range_of(int32_t count, int task)
{
    int32_t each = (count / TASKS + 4) / 4 * 4;
    int64_t first = (int64_t)each * task, end = first + each;
    return (task_range){(int32_t)(first < count ? first : count), (int32_t)(end < count ? end : count)};
}

static void run_tasks(tree_job *job, void (*task)(void *, int), int threads)
{
    e3d_pool_share(job->tree->count > FEW ? threads : 1, TASKS, task, job);
}

/* ---- boxes ---- */

static float below(double v)
{
    float f = (float)v;
    return f > v ? (float)(v - fabs(v) * 2e-7 - FLT_MIN) : f;
}

void e3d_block_set(e3d_block *block, int lane, const double box[E3D_BOX])
{
    int whole = box[0] <= box[3] && box[1] <= box[4] && box[2] <= box[5] && box[6] >= 0;
    int none = box[0] > box[3]; /* NaN: it may be anywhere */
// clang-format off
    for (int k = 0; k < 3; k++) {
        block->low[k][lane] = whole ? below(box[k]) : none ? INFINITY : -INFINITY;
        block->high[k][lane] = whole ? -below(-box[3 + k]) : none ? -INFINITY : INFINITY;
    }
    block->reach[lane] = whole ? -below(-box[6]) : none ? 0 : INFINITY;
// clang-format on
}

static void clear(e3d_block *block)
{
    for (int k = 0; k < 3; k++) {
        block->low[k] = e3d_v4_all(INFINITY);
        block->high[k] = e3d_v4_all(-INFINITY);
    }
    block->reach = e3d_v4_all(0);
}

/* Writes the box around a block's boxes into a lane of its parent; returns the growth of the cost. */
static double gather(const e3d_block *from, e3d_block *to, int lane)
{
    double size[2][3], area[2];
    for (int k = 0; k < 3; k++) {
        float low = from->low[k][0], high = from->high[k][0];
        for (int i = 1; i < 4; i++) {
            low = from->low[k][i] < low ? from->low[k][i] : low;
            high = from->high[k][i] > high ? from->high[k][i] : high;
        }
        size[0][k] = (double)to->high[k][lane] - to->low[k][lane];
        size[1][k] = (double)high - low;
        to->low[k][lane] = low;
        to->high[k][lane] = high;
    }
    float reach = from->reach[0];
    for (int i = 1; i < 4; i++)
        reach = from->reach[i] > reach ? from->reach[i] : reach;
    to->reach[lane] = reach;
    for (int i = 0; i < 2; i++) {
        const double *s = size[i];
        area[i] = s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
        area[i] = s[0] >= 0 && area[i] < 1e30 ? area[i] : 0; /* 0 for none, or one without end */
    }
    return area[1] - area[0];
}

/* Writes the boxes of blocks [first, end) of a level into the level above; returns the growth of the cost. */
static double gather_some(e3d_tree *t, int level, int32_t first, int32_t end)
{
    e3d_block *from = e3d_tree_level(t, level), *to = e3d_tree_level(t, level + 1);
    double cost = 0;
    for (int32_t b = first; b < end; b++) {
        if (b % 4 == 0)
            clear(&to[b / 4]);
        cost += gather(&from[b], &to[b / 4], b % 4);
    }
    return cost;
}

/* Finds the boxes above the leaves' parents. The cost is summed up task by task, so that it is the same on any number of
 * threads. */
static void gather_rest(tree_job *job)
{
    e3d_tree *t = job->tree;
    t->cost = 0;
    for (int i = 0; i < TASKS; i++)
        t->cost += job->cost[i];
    for (int level = 1; level + 1 < t->levels; level++)
        t->cost += gather_some(t, level, 0, t->blocks_in[level]);
}

/* ---- leaves ---- */

/* Makes a task's leaves from the items that stand there, and the boxes above them. */
static void fill_some(void *argument, int task)
{
    enum { AHEAD = 16 };
    tree_job *job = argument;
    e3d_tree *t = job->tree;
    e3d_block *leaves = e3d_tree_level(t, 0);
    const int32_t *items = t->items.data;
    task_range range = range_of(t->blocks_in[0], task);
    for (int32_t i = 4 * range.first; i < 4 * range.end; i++) {
        if (i % 4 == 0)
            clear(&leaves[i / 4]);
        if (i + AHEAD < t->count)
            __builtin_prefetch(job->boxes + E3D_BOX * (size_t)items[i + AHEAD]);
        if (i < t->count)
            e3d_block_set(&leaves[i / 4], i % 4, job->boxes + E3D_BOX * (size_t)items[i]);
    }
    job->cost[task] = t->levels > 1 ? gather_some(t, 0, range.first, range.end) : 0;
}

/* Finds all boxes of the tree, whose items have their positions. */
static void fill_all(e3d_tree *t, const double *boxes, int threads)
{
    tree_job job = {.tree = t, .boxes = boxes};
    run_tasks(&job, fill_some, threads);
    gather_rest(&job);
}

/* ---- building ---- */

/* Skilling's transform of coordinates to the transposed Hilbert index, for four items at a time. */
static void transpose(e3d_v4i x[3])
{
    for (int32_t q = 1 << (BITS - 1); q > 1; q >>= 1)
        for (int i = 0; i < 3; i++) {
            e3d_v4i p = (e3d_v4i){0} + (q - 1), set = (x[i] & q) != 0;
            e3d_v4i t = (x[0] ^ x[i]) & p & ~set;
            x[0] ^= t | (p & set);
            x[i] ^= i ? t : (e3d_v4i){0};
        }
    x[1] ^= x[0];
    x[2] ^= x[1];
    e3d_v4i t = {0};
    for (int32_t q = 1 << (BITS - 1); q > 1; q >>= 1)
        t ^= ((x[2] & q) != 0) & (q - 1);
    for (int i = 0; i < 3; i++)
        x[i] ^= t;
}

/* Spreads bits 0, 1, 2 … to 0, 3, 6 …. */
static uint64_t spread(uint32_t bits)
{
    uint64_t v = bits;
    v = (v | v << 16) & 0xFF0000FFull;
    v = (v | v << 8) & 0xF00F00F00Full;
    v = (v | v << 4) & 0xC30C30C30C3ull;
    return (v | v << 2) & 0x249249249249ull;
}

static double middle(const double *box, int k)
{
    double m = box[k] * 0.5 + box[3 + k] * 0.5;
    return fabs(m) < INFINITY ? m : 0;
}

/* Finds where the middles of a task's boxes lie. */
static void find_extent(void *argument, int task)
{
    tree_job *job = argument;
    task_range range = range_of(job->used, task);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int32_t i = range.first; i < range.end; i++)
        for (int k = 0; k < 3; k++) {
            double m = middle(job->boxes + E3D_BOX * (size_t)job->keys[i].item, k);
            low[k] = m < low[k] ? m : low[k];
            high[k] = m > high[k] ? m : high[k];
        }
    memcpy(job->low[task], low, sizeof low);
    memcpy(job->high[task], high, sizeof high);
}

/* Joins the extents of all tasks in that of the first. */
static void join_extents(tree_job *job)
{
    for (int task = 1; task < TASKS; task++)
        for (int k = 0; k < 3; k++) {
            job->low[0][k] = job->low[task][k] < job->low[0][k] ? job->low[task][k] : job->low[0][k];
            job->high[0][k] = job->high[task][k] > job->high[0][k] ? job->high[task][k] : job->high[0][k];
        }
}

static void find_codes(void *argument, int task)
{
    tree_job *job = argument;
    task_range range = range_of(job->used, task);
    const double *low = job->low[0], *high = job->high[0];
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = high[k] - low[k] > most ? high[k] - low[k] : most;
    double scale = most > 0 && isfinite(most) ? ((1 << BITS) - 1) / most : 0;
    for (int32_t first = range.first; first < range.end; first += 4) {
        key *keys = job->keys + first;
        int count = range.end - first < 4 ? range.end - first : 4;
        e3d_v4i x[3] = {{0}};
        for (int i = 0; i < count; i++)
            for (int k = 0; k < 3; k++) {
                double place = (middle(job->boxes + E3D_BOX * (size_t)keys[i].item, k) - low[k]) * scale;
                /* What is out of range becomes 0: the boxes' middles are endlessly far or hardly apart. */
                x[k][i] = place > 0 && place < 1 << BITS ? (int32_t)place : 0;
            }
        transpose(x);
        for (int i = 0; i < count; i++)
            keys[i].code = spread((uint32_t)x[0][i]) << 2 | spread((uint32_t)x[1][i]) << 1 | spread((uint32_t)x[2][i]);
    }
}

static void find_keys(e3d_tree *t, const double *boxes, int threads)
{
    tree_job job = {.tree = t, .boxes = boxes, .keys = t->keys.data, .used = t->count};
    run_tasks(&job, find_extent, threads);
    join_extents(&job);
    run_tasks(&job, find_codes, threads);
}

/* Sorts by the least digit first. Each pass is stable, so that equal keys stay in the order of items. */
static key *sort_keys(key *keys, key *other, int32_t count)
{
    for (int pass = 0; pass < PASSES; pass++) {
        int32_t start[(1 << RADIX) + 1] = {0};
        for (int32_t i = 0; i < count; i++)
            start[(keys[i].code >> (pass * RADIX) & ((1 << RADIX) - 1)) + 1]++;
        for (int d = 0; d < 1 << RADIX; d++)
            start[d + 1] += start[d];
        for (int32_t i = 0; i < count; i++)
            other[start[keys[i].code >> (pass * RADIX) & ((1 << RADIX) - 1)]++] = keys[i];
        key *swap = keys;
        keys = other;
        other = swap;
    }
    return keys;
}

static int lay_out(e3d_tree *t, int32_t count)
{
    int32_t in_level = count, total = 0;
    t->levels = 0;
    do {
        in_level = in_level / 4 + (in_level % 4 != 0);
        in_level = in_level ? in_level : 1;
        t->first[t->levels] = total;
        t->blocks_in[t->levels++] = in_level;
        total += in_level;
    } while (in_level > 1);
    if (!e3d_array_reserve(&t->blocks, (size_t)total, sizeof(e3d_block)) ||
        !e3d_array_reserve(&t->marks, (size_t)total, 1) ||
        !e3d_array_reserve(&t->dirty, (size_t)total, sizeof(int32_t)))
        return 0;
    memset(t->marks.data, 0, (size_t)total);
    return 1;
}

/* Gives the items their positions. */
static void place_items(e3d_tree *t, const key *keys)
{
    int32_t *items = t->items.data, *places = t->places.data;
    for (int32_t i = 0; i < t->count; i++) {
        items[i] = keys[i].item;
        places[items[i]] = i;
    }
}

int e3d_tree_build(e3d_tree *t, const double *boxes, int32_t count, int threads)
{
    t->count = t->levels = 0;
    t->loose.count = 0;
    if (!e3d_array_reserve(&t->keys, (size_t)count, sizeof(key)) ||
        !e3d_array_reserve(&t->keys_too, (size_t)count, sizeof(key)) ||
        !e3d_array_reserve(&t->items, (size_t)count, sizeof(int32_t)) ||
        !e3d_array_reserve(&t->places, (size_t)count, sizeof(int32_t)))
        return 0;
    key *keys = t->keys.data;
    int32_t *places = t->places.data, used = 0;
    for (int32_t i = 0; i < count; i++) {
        places[i] = -1;
        const double *box = boxes + E3D_BOX * (size_t)i;
        if (box[0] > box[3]) /* none */
            continue;
        keys[used++].item = i;
    }
    if (!lay_out(t, used))
        return 0;
    t->count = used;
    t->places.count = (size_t)count;
    find_keys(t, boxes, threads);
    place_items(t, sort_keys(keys, t->keys_too.data, used));
    fill_all(t, boxes, threads);
    t->built_cost = t->cost;
    t->refits = 0;
    return 1;
}

/* ---- refitting ---- */

/* Renews the boxes above the dirty blocks of a level, level by level. */
static void gather_dirty(e3d_tree *t, int32_t dirty)
{
    int32_t *list = t->dirty.data;
    uint8_t *marks = t->marks.data;
    for (int level = 0; level + 1 < t->levels; level++) {
        e3d_block *from = e3d_tree_level(t, level), *to = e3d_tree_level(t, level + 1);
        int32_t above = 0;
        for (int32_t i = 0; i < dirty; i++) {
            int32_t b = list[i];
            marks[t->first[level] + b] = 0;
            t->cost += gather(&from[b], &to[b / 4], b % 4);
            if (!marks[t->first[level + 1] + b / 4]) {
                marks[t->first[level + 1] + b / 4] = 1;
                list[above++] = b / 4;
            }
        }
        dirty = above;
    }
    marks[t->first[t->levels - 1]] = 0;
}

static int add_loose(e3d_tree *t, int32_t item, const double *box)
{
    const int32_t *loose = t->loose.data;
    if (box[0] > box[3])
        return 1;
    for (size_t i = 0; i < t->loose.count; i++)
        if (loose[i] == item)
            return 1;
    if (t->loose.count >= 64 || !e3d_array_reserve(&t->loose, t->loose.count + 1, sizeof(int32_t)))
        return 0;
    ((int32_t *)t->loose.data)[t->loose.count++] = item;
    return 1;
}

static int is_worn(const e3d_tree *t) { return t->cost > WORN * t->built_cost && t->refits >= LEAST_REFITS; }

int e3d_tree_refit(e3d_tree *t, const double *boxes, int32_t count, const int32_t *moved, int32_t moves, int threads)
{
    int all = moves > t->count / 4, loose_fit = 1;
    if (t->levels == 0 || (all && is_worn(t))) /* building renews all boxes anyway */
        return e3d_tree_build(t, boxes, count, threads);
    e3d_block *leaves = e3d_tree_level(t, 0);
    const int32_t *places = t->places.data;
    int32_t *list = t->dirty.data, dirty = 0;
    uint8_t *marks = t->marks.data;
    for (int32_t i = 0; i < moves; i++) {
        int32_t item = moved[i];
        const double *box = boxes + E3D_BOX * (size_t)item;
        int32_t place = (size_t)item < t->places.count ? places[item] : -1;
        if (place < 0) {
            loose_fit = loose_fit && add_loose(t, item, box);
            continue;
        }
        if (all)
            continue;
        e3d_block_set(&leaves[place / 4], place % 4, box);
        if (!marks[place / 4]) {
            marks[place / 4] = 1;
            list[dirty++] = place / 4;
        }
    }
    if (all)
        fill_all(t, boxes, threads);
    else
        gather_dirty(t, dirty);
    t->refits++;
    if (!loose_fit || (!all && is_worn(t)))
        return e3d_tree_build(t, boxes, count, threads);
    return 1;
}
