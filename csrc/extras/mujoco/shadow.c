/* Shadows: which fragments a light doesn't reach (R265, R266).
 * In: fragments, draws, a light. Out: a bit of each fragment.
 * Always: the result is that of a map of depths, drawn and read texel by texel. But only those texels are found that are read:
 * they are listed by cells of the map, and each triangle looks at the cells that it covers (Johnson and others 2005). */
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/pool.h"
#include "extras/mujoco/passes.h"

enum { LEAST_CELLS = 64, /* along a side of the box of all texels that are read; with more of these, more */
       MOST_CELLS = 1024,
       PARTS = 64,             /* along a side of the map, where it is noted whether there is a caster at all */
       DEPTHS = (1 << 24) - 1, /* steps of a map's depths */
       HIDDEN = INT32_MAX,     /* as a depth */
       CHUNK = 64 };

#define OFFSET_FACTOR 1.5
#define OFFSET_UNITS (4 * 0x1p-24)

typedef struct lookup {
    int32_t step;              /* the fragment's depth in steps, rounded down */
    int16_t x, y;
    uint8_t *mark;
} lookup;

typedef struct cast_job {
    const muj_picture *picture;
    muj_shadow_memory *memory;
    const muj_fragments *fragments; /* of each band */
    muj_view view;
    e3d_array *planes;         /* the records of all planes: each lookup is tested against them at once */
    uint8_t occupied[PARTS][PARTS]; /* whether anything else may cast there */
    int32_t part_shift;
    int32_t shift;             /* texels of a cell's side, as a power of two */
    int32_t cells[2];
    uint8_t bit;
    int32_t bands, count, is_alone; /* is_alone: there is one thread */
    muj_lookups lookups;            /* in the order of their cells */
    uint8_t **marks;
    atomic_int next_band, next, failed;
} cast_job;

/* ---- where there are casters ---- */

/* Marks the parts of the map that a draw's box may cover. */
static void occupy(cast_job *job, const muj_draw *draw)
{
    int32_t low[2] = {PARTS, PARTS}, high[2] = {-1, -1};
    for (int i = 0; i < 8; i++) {
        double at[3];
        for (int c = 0; c < 3; c++)
            at[c] = i >> c & 1 ? draw->shape->high[c] : draw->shape->low[c];
        muj_point corner = muj_place(&job->view, draw, at);
        for (int c = 0; c < 2; c++) {
            double p = corner.p[3] > 0 ? corner.p[c] / corner.p[3] / (1 << job->part_shift) : 0;
            int32_t part = p > 0 ? p < PARTS ? (int32_t)p : PARTS - 1 : 0;
            low[c] = !(corner.p[3] > 0) ? 0 : part < low[c] ? part
                                                            : low[c];
            high[c] = !(corner.p[3] > 0) ? PARTS - 1 : part > high[c] ? part
                                                                      : high[c];
        }
    }
    for (int32_t y = low[1]; y <= high[1]; y++)
        memset(&job->occupied[y][low[0]], 1, (size_t)(high[0] - low[0] + 1));
}

static int find_casters(cast_job *job)
{
    job->planes->count = 0;
    while ((job->picture->frame->shadow_size - 1) >> job->part_shift >= PARTS)
        job->part_shift++;
    for (int32_t i = 0; i < job->count; i++) {
        const muj_draw *draw = muj_draw_of(job->picture, i);
        if (!draw->casts || draw->kind == MUJ_LINES)
            continue;
        if (draw->kind == MUJ_GRID)
            muj_set_up_grid(&job->view, i, draw, 0, job->planes);
        else if (!muj_is_outside(draw, &job->view))
            occupy(job, draw);
    }
    return muj_new_record(job->planes) != NULL;
}

/* ---- lookups ---- */

/* Where fragments are on the map, in texels, and their depths; of those behind the light, no numbers. */
typedef struct placed {
    double at[2][CHUNK], z[CHUNK];
} placed;

static void place_all(const cast_job *job, const muj_fragments *fragments, int32_t first, int32_t count, placed *out)
{
    const double (*row)[4] = job->view.rows;
    const float *x = muj_places_of(fragments, 0) + first, *y = muj_places_of(fragments, 1) + first, *z = muj_places_of(fragments, 2) + first;
    double size = job->picture->frame->shadow_size, scale = size / (size - 2);
    for (int32_t i = 0; i < count; i++) {
        double w = ((row[3][0] * x[i] + row[3][1] * y[i]) + row[3][2] * z[i]) + row[3][3], inverse = 1 / (w > 0 ? w : 0);
        for (int c = 0; c < 2; c++)
            out->at[c][i] = ((((row[c][0] * x[i] + row[c][1] * y[i]) + row[c][2] * z[i]) + row[c][3]) * inverse - 1) * scale;
        out->z[i] = (((row[2][0] * x[i] + row[2][1] * y[i]) + row[2][2] * z[i]) + row[2][3]) * inverse;
    }
}

/* Finds the texel that a fragment reads; 0 if it is lit whatever is there. The map is drawn inside a border, but read as a
 * whole (R266). */
static int find_lookup(const cast_job *job, const placed *in, int32_t i, uint8_t *mark, lookup *out)
{
    double most = job->picture->frame->shadow_size - 1, z = in->z[i];
    for (int c = 0; c < 2; c++)
        if (!(in->at[c][i] >= 1 && in->at[c][i] < most))
            return 0;
    *out = (lookup){(int32_t)((z > 0 ? z < 1 ? z : 1 : 0) * DEPTHS), (int16_t)in->at[0][i], (int16_t)in->at[1][i], mark};
    return 1;
}

/* Whether a triangle covers the middle of a texel. */
static int covers(const muj_record *record, int32_t x, int32_t y)
{
    if (x < record->x0 || x > record->x1 || y < record->y0 || y > record->y1)
        return 0;
    int64_t dx = (int64_t)(x - record->x0) * MUJ_SUB + MUJ_SUB / 2, dy = (int64_t)(y - record->y0) * MUJ_SUB + MUJ_SUB / 2, outside = 0;
    for (int k = 0; k < 3; k++)
        outside |= (record->e[k] + record->a[k] * dx) + record->b[k] * dy;
    return outside >= 0;
}

/* The depth of a triangle at a texel's middle, offset, in steps: the map has the whole ones. */
static double steps_at(const muj_record *record, double offset, int32_t x, int32_t y)
{
    double px = x - record->x0 + 0.5, py = y - record->y0 + 0.5, z = (record->z + (record->zx * px + record->zy * py)) - offset;
    return (z > 1 ? 1 : z) * DEPTHS + 0.5;
}

static double offset_of(const muj_record *record)
{
    double x = fabs(record->zx), y = fabs(record->zy);
    return OFFSET_FACTOR * (x > y ? x : y) + OFFSET_UNITS;
}

/* The records of a plane lie in it: if it is behind a lookup by more than errors, all are. A plane is by four steps behind the
 * lookups on itself. */
static int is_hidden_by_planes(const cast_job *job, const lookup *at)
{
    const muj_record *planes = job->planes->data;
    size_t i = 0;
    while (i < job->planes->count) {
        const muj_record *plane = &planes[i++];
        double steps = steps_at(plane, offset_of(plane), at->x, at->y);
        if (steps >= (double)at->step + 1 && covers(plane, at->x, at->y))
            return 1;
        while (steps + 1 < (double)at->step && i < job->planes->count && planes[i].draw == plane->draw)
            i++;
    }
    return 0;
}

static int list_band(const cast_job *job, int32_t band, e3d_array *out)
{
    const muj_fragments *fragments = &job->fragments[band];
    uint8_t *shadowed = fragments->shadowed.data;
    placed places;
    out->count = 0;
    if (!e3d_array_reserve(out, (size_t)fragments->count + 1, sizeof(lookup)))
        return 0;
    lookup *next = out->data;
    for (int32_t i = 0, start = -CHUNK; i < fragments->count; i++) {
        if (shadowed[i] & job->bit)
            continue;
        if (i - start >= CHUNK)
            place_all(job, fragments, start = i, fragments->count - i < CHUNK ? fragments->count - i : CHUNK, &places);
        if (!find_lookup(job, &places, i - start, &shadowed[i], next))
            continue;
        if (is_hidden_by_planes(job, next))
            shadowed[i] |= job->bit;
        else
            next += job->occupied[next->y >> job->part_shift][next->x >> job->part_shift];
    }
    out->count = (size_t)(next - (lookup *)out->data);
    return 1;
}

static void list_some(void *argument, int number)
{
    cast_job *job = argument;
    (void)number;
    for (;;) {
        int32_t band = atomic_fetch_add(&job->next_band, 1);
        if (band >= job->bands)
            return;
        if (!list_band(job, band, &job->memory->lists[band]))
            atomic_store(&job->failed, 1);
    }
}

/* Finds the box of all lookups, and returns how many there are. */
static size_t set_box(cast_job *job)
{
    int32_t low[2] = {INT32_MAX, INT32_MAX}, high[2] = {-1, -1};
    size_t total = 0;
    for (int32_t band = 0; band < job->bands; band++) {
        const lookup *all = job->memory->lists[band].data;
        total += job->memory->lists[band].count;
        for (size_t i = 0; i < job->memory->lists[band].count; i++) {
            low[0] = all[i].x < low[0] ? all[i].x : low[0], high[0] = all[i].x > high[0] ? all[i].x : high[0];
            low[1] = all[i].y < low[1] ? all[i].y : low[1], high[1] = all[i].y > high[1] ? all[i].y : high[1];
        }
    }
    if (!total)
        return 0;
    memcpy(job->view.low, low, sizeof low);
    memcpy(job->view.high, high, sizeof high);
    int32_t cells = LEAST_CELLS;
    while (cells < MOST_CELLS && (size_t)cells * (size_t)cells < 4 * total)
        cells *= 2;
    job->shift = 0;
    while ((high[0] - low[0]) >> job->shift >= cells || (high[1] - low[1]) >> job->shift >= cells)
        job->shift++;
    for (int c = 0; c < 2; c++)
        job->cells[c] = ((high[c] - low[c]) >> job->shift) + 1;
    return total;
}

static int32_t cell_of(const cast_job *job, int32_t x, int32_t y)
{
    return ((y - job->view.low[1]) >> job->shift) * job->cells[0] + ((x - job->view.low[0]) >> job->shift);
}

static int reserve_sorted(cast_job *job, size_t total)
{
    size_t room = total + 16; /* whole vectors may be read */
    muj_shadow_memory *memory = job->memory;
    if (!e3d_array_reserve(&memory->starts, (size_t)job->cells[0] * (size_t)job->cells[1] + 2, sizeof(int32_t)) ||
        !e3d_array_reserve(&memory->sorted, 3 * room, sizeof(int32_t)) || !e3d_array_reserve(&memory->marks, total, sizeof(uint8_t *)))
        return 0;
    int32_t *numbers = memory->sorted.data;
    memset(numbers + total, 0, 16 * sizeof *numbers);
    memset(numbers + room + total, 0, 16 * sizeof *numbers);
    memset(numbers + 2 * room + total, 0, 16 * sizeof *numbers);
    job->lookups = (muj_lookups){numbers, numbers + room, numbers + 2 * room};
    job->marks = memory->marks.data;
    return 1;
}

static int sort_lookups(cast_job *job, size_t total)
{
    size_t cells = (size_t)job->cells[0] * (size_t)job->cells[1];
    if (!reserve_sorted(job, total))
        return 0;
    int32_t *starts = job->memory->starts.data;
    memset(starts, 0, (cells + 2) * sizeof *starts);
    for (int32_t band = 0; band < job->bands; band++) {
        const lookup *all = job->memory->lists[band].data;
        for (size_t i = 0; i < job->memory->lists[band].count; i++)
            starts[cell_of(job, all[i].x, all[i].y) + 2]++;
    }
    for (size_t i = 2; i < cells + 2; i++)
        starts[i] += starts[i - 1];
    for (int32_t band = 0; band < job->bands; band++) {
        const lookup *all = job->memory->lists[band].data;
        for (size_t i = 0; i < job->memory->lists[band].count; i++) {
            int32_t to = starts[cell_of(job, all[i].x, all[i].y) + 1]++;
            job->lookups.x[to] = all[i].x, job->lookups.y[to] = all[i].y, job->lookups.step[to] = all[i].step;
            job->marks[to] = all[i].mark;
        }
    }
    return 1;
}

/* ---- casters ---- */

/* A step that no depth of the record exceeds. */
static int32_t bound_of(const muj_record *record, double offset)
{
    double wide = record->x1 - record->x0 + 1, high = record->y1 - record->y0 + 1;
    double z = record->z - offset + (record->zx > 0 ? record->zx * wide : 0) + (record->zy > 0 ? record->zy * high : 0);
    return !(z < 1) ? DEPTHS : z > 0 ? (int32_t)(z * DEPTHS) + 1
                                     : 1;
}

/* A record as many lookups are tested against it; 0 if it is too large for that. */
static int set_test(const muj_record *record, double offset, muj_shadow_test *out)
{
    if (record->x1 - record->x0 > MUJ_COLUMN * 8 || record->y1 - record->y0 > MUJ_COLUMN * 8)
        return 0;
    *out = (muj_shadow_test){{record->x0, record->y0}, {record->x1, record->y1}, {0}, {0}, {0}, bound_of(record, offset)};
    for (int k = 0; k < 3; k++) {
        int64_t e = record->e[k] + (int64_t)(MUJ_SUB / 2) * ((int64_t)record->a[k] + record->b[k]);
        out->across[k] = record->a[k], out->down[k] = record->b[k];
        if (e >> 8 < -(1 << 30) || e >> 8 > 1 << 30 || abs(record->a[k]) > 1 << 19 || abs(record->b[k]) > 1 << 19)
            return 0;
        out->edge[k] = (int32_t)(e >> 8);
    }
    return 1;
}

/* Hides the light from lookups that a record covers. */
static void hide(const cast_job *job, const muj_record *record, double offset, const int32_t *numbers, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t n = numbers[i];
        uint8_t *mark = job->marks[n];
        if (!(steps_at(record, offset, job->lookups.x[n], job->lookups.y[n]) >= (double)job->lookups.step[n] + 1))
            continue;
        if (job->is_alone)
            job->lookups.step[n] = HIDDEN;
        __atomic_store_n(mark, (uint8_t)(__atomic_load_n(mark, __ATOMIC_RELAXED) | job->bit), __ATOMIC_RELAXED);
    }
}

static void cast_on_range(const cast_job *job, const muj_record *record, const muj_shadow_test *test, double offset, int32_t first, int32_t end)
{
    int32_t numbers[4 * CHUNK + 16];
    for (; first < end; first += 4 * CHUNK) {
        int32_t last = end - first < 4 * CHUNK ? end : first + 4 * CHUNK, count = 0;
        if (test)
            count = job->picture->kernels->cover(test, &job->lookups, first, last, numbers);
        for (int32_t i = first; i < last && !test; i++)
            if (covers(record, job->lookups.x[i], job->lookups.y[i]))
                numbers[count++] = i;
        hide(job, record, offset, numbers, count);
    }
}

static void cast_record(const cast_job *job, const muj_record *record)
{
    const int32_t *starts = job->memory->starts.data;
    double offset = offset_of(record);
    muj_shadow_test test;
    int is_small = set_test(record, offset, &test);
    int32_t first = cell_of(job, record->x0, record->y0), last = cell_of(job, record->x0, record->y1);
    int32_t wide = cell_of(job, record->x1, record->y0) - first + 1;
    for (int32_t row = first; row <= last; row += job->cells[0])
        cast_on_range(job, record, is_small ? &test : NULL, offset, starts[row], starts[row + wide]);
}

static void cast_records(const cast_job *job, e3d_array *records)
{
    const muj_record *all = records->data;
    for (size_t i = 0; i < records->count; i++)
        cast_record(job, &all[i]);
    records->count = 0;
}

/* A step that no depth of a triangle without clipping exceeds. */
static int32_t bound_of_corners(const muj_vertices *v, const int32_t corner[3])
{
    float most = v->z[corner[0]] > v->z[corner[1]] ? v->z[corner[0]] : v->z[corner[1]];
    most = v->z[corner[2]] > most ? v->z[corner[2]] : most;
    return !(most < 1) ? DEPTHS : most > 0 ? (int32_t)((double)most * DEPTHS) + 4
                                           : 4;
}

/* Whether a triangle surely hides no texel that is read: most do not, and need no record. */
static int is_idle(const cast_job *job, const muj_vertices *v, const int32_t corner[3])
{
    const int32_t *starts = job->memory->starts.data;
    int32_t numbers[CHUNK + 16];
    muj_shadow_test test = {.bound = bound_of_corners(v, corner)};
    for (int c = 0; c < 2; c++) {
        int32_t at[3] = {v->snapped[corner[0]][c], v->snapped[corner[1]][c], v->snapped[corner[2]][c]};
        if (at[0] == MUJ_OUTSIDE || at[1] == MUJ_OUTSIDE || at[2] == MUJ_OUTSIDE)
            return 0;
        int32_t low = (muj_least(at) + MUJ_SUB / 2 - 1) >> 8, high = (muj_most(at) - MUJ_SUB / 2) >> 8;
        test.low[c] = low > job->view.low[c] ? low : job->view.low[c], test.high[c] = high < job->view.high[c] ? high : job->view.high[c];
        if (test.low[c] > test.high[c])
            return 1;
    }
    int32_t first = cell_of(job, test.low[0], test.low[1]), last = cell_of(job, test.low[0], test.high[1]);
    int32_t wide = cell_of(job, test.high[0], test.low[1]) - first + 1;
    for (int32_t row = first; row <= last; row += job->cells[0])
        for (int32_t i = starts[row]; i < starts[row + wide]; i += CHUNK) {
            int32_t end = starts[row + wide] - i < CHUNK ? starts[row + wide] : i + CHUNK;
            if (job->picture->kernels->cover(&test, &job->lookups, i, end, numbers))
                return 0;
        }
    return 1;
}

static int cast_shape(const cast_job *job, const muj_draw *draw, muj_worker *worker)
{
    if (muj_is_outside(draw, &job->view))
        return 1;
    if (!muj_choose(job->picture->kernels, draw, &job->view, 0, worker))
        return 0;
    const int32_t *chosen = worker->chosen.data;
    for (size_t i = 0; i < worker->chosen.count; i++) {
        if (is_idle(job, &worker->vertices, draw->shape->corners + 3 * (size_t)chosen[i]))
            continue;
        muj_set_up(&job->view, 0, draw, 0, chosen[i], worker);
        cast_records(job, &worker->records);
    }
    return 1;
}

static void cast_some(void *argument, int number)
{
    cast_job *job = argument;
    muj_worker *worker = &job->memory->workers[number];
    for (;;) {
        int32_t i = atomic_fetch_add(&job->next, 1);
        if (i >= job->count)
            return;
        muj_draw draw = *muj_draw_of(job->picture, i);
        draw.shape = draw.plain;
        if (draw.casts && draw.kind == MUJ_TRIANGLES && (!cast_shape(job, &draw, worker) || !muj_new_record(&worker->records)))
            atomic_store(&job->failed, 1);
    }
}

static int prepare_memory(muj_shadow_memory *memory, int32_t threads, int32_t bands)
{
    if (memory->worker_count < threads) {
        muj_worker *workers = realloc(memory->workers, (size_t)threads * sizeof *workers);
        if (!workers)
            return 0;
        memset(workers + memory->worker_count, 0, (size_t)(threads - memory->worker_count) * sizeof *workers);
        memory->workers = workers;
        memory->worker_count = threads;
    }
    if (memory->list_count < bands) {
        e3d_array *lists = realloc(memory->lists, (size_t)bands * sizeof *lists);
        if (!lists)
            return 0;
        memset(lists + memory->list_count, 0, (size_t)(bands - memory->list_count) * sizeof *lists);
        memory->lists = lists;
        memory->list_count = bands;
    }
    return 1;
}

int muj_cast(const muj_picture *picture, int32_t k, const muj_fragments *fragments, int32_t bands, int32_t threads, muj_shadow_memory *memory)
{
    cast_job job = {.picture = picture, .memory = memory, .fragments = fragments, .planes = &memory->planes, .bit = (uint8_t)(1 << k)};
    job.bands = bands;
    job.is_alone = threads == 1;
    job.count = (int32_t)(picture->draws.count + picture->blended.count);
    muj_set_light_view(picture->frame, &picture->frame->lights[picture->shadow_lights[k]], &job.view);
    if (!prepare_memory(memory, threads, bands) || !find_casters(&job))
        return 0;
    e3d_pool_run(threads, list_some, &job);
    if (atomic_load(&job.failed))
        return 0;
    size_t total = set_box(&job);
    if (!total)
        return 1;
    if (total > INT32_MAX || !sort_lookups(&job, total))
        return 0;
    e3d_pool_run(threads, cast_some, &job);
    return !atomic_load(&job.failed);
}

void muj_free_shadow_memory(muj_shadow_memory *memory)
{
    for (int32_t w = 0; w < memory->worker_count; w++)
        muj_free_worker(&memory->workers[w]);
    for (int32_t i = 0; i < memory->list_count; i++)
        e3d_array_free(&memory->lists[i]);
    free(memory->workers);
    free(memory->lists);
    e3d_array_free(&memory->planes);
    e3d_array_free(&memory->sorted);
    e3d_array_free(&memory->starts);
    e3d_array_free(&memory->marks);
}
