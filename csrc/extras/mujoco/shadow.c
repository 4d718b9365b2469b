/* Shadows: which fragments a light doesn't reach (R265, R266).
 * In: fragments, draws, a light. Out: a bit of each fragment.
 * Always: the result is that of a map of depths, drawn and read texel by texel. But only those texels are found that are read:
 * they are listed by cells of the map, and each triangle looks at the cells that it covers (Johnson and others 2005). */
#include <math.h>
#include <stdatomic.h>

#include "base/pool.h"
#include "extras/mujoco/passes.h"

enum { LEAST_CELLS = 64, /* along a side of the box of all texels that are read; with more of these, more */
       MOST_CELLS = 1024,
       PARTS = 64,             /* along a side of the map, where it is noted whether there is a caster at all */
       DEPTHS = (1 << 24) - 1 /* steps of a map's depths */ };

#define OFFSET_FACTOR 1.5
#define OFFSET_UNITS (4 * 0x1p-24)

typedef struct lookup {
    double z;                  /* the fragment's depth */
    int32_t x, y;
    uint8_t *mark;
} lookup;

typedef struct cast_job {
    const muj_picture *picture;
    muj_shadow_memory *memory;
    const e3d_array *fragments; /* of each band */
    muj_view view;
    e3d_array *planes;         /* the records of all planes: each lookup is tested against them at once */
    uint8_t occupied[PARTS][PARTS]; /* whether anything else may cast there */
    int32_t part_shift;
    int32_t shift;             /* texels of a cell's side, as a power of two */
    int32_t cells[2];
    uint8_t bit;
    int32_t bands, count;
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
            muj_set_up_grid(&job->view, 0, draw, 0, job->planes);
        else if (!muj_is_outside(draw, &job->view))
            occupy(job, draw);
    }
    return muj_new_record(job->planes) != NULL;
}

/* ---- lookups ---- */

static double along(const double row[4], const float p[3]) { return ((row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]) + row[3]; }

/* Finds the texel that a fragment reads; 0 if it is lit whatever is there. The map is drawn inside a border, but read as a
 * whole (R266). */
static int find_lookup(const cast_job *job, muj_fragment *fragment, lookup *out)
{
    double size = job->picture->frame->shadow_size, scale = size / (size - 2), w = along(job->view.rows[3], fragment->place), at[2];
    if (!(w > 0))
        return 0;
    double inverse = w == 1 ? 1 : 1 / w;
    for (int c = 0; c < 2; c++) {
        at[c] = (along(job->view.rows[c], fragment->place) * inverse - 1) * scale;
        if (!(at[c] >= 1 && at[c] < size - 1))
            return 0;
    }
    double z = along(job->view.rows[2], fragment->place) * inverse;
    *out = (lookup){z > 0 ? z < 1 ? z : 1 : 0, (int32_t)at[0], (int32_t)at[1], &fragment->shadowed};
    return 1;
}

/* Whether a triangle hides the light from a lookup: its depth is offset, and counted in steps, as the map's would be. */
static int hides(const muj_record *record, double offset, const lookup *at)
{
    if (at->x < record->x0 || at->x > record->x1 || at->y < record->y0 || at->y > record->y1)
        return 0;
    int64_t dx = (int64_t)(at->x - record->x0) * MUJ_SUB + MUJ_SUB / 2, dy = (int64_t)(at->y - record->y0) * MUJ_SUB + MUJ_SUB / 2;
    int64_t outside = 0;
    for (int k = 0; k < 3; k++)
        outside |= (record->e[k] + record->a[k] * dx) + record->b[k] * dy;
    if (outside < 0)
        return 0;
    double px = (double)dx * (1.0 / MUJ_SUB), py = (double)dy * (1.0 / MUJ_SUB);
    double z = (record->z + (record->zx * px + record->zy * py)) - offset;
    if (z + 0x1p-23 < at->z)
        return 0;
    z = z > 0 ? z < 1 ? z : 1 : 0;
    return floor(z * DEPTHS + 0.5) / DEPTHS > at->z;
}

static double offset_of(const muj_record *record)
{
    double x = fabs(record->zx), y = fabs(record->zy);
    return OFFSET_FACTOR * (x > y ? x : y) + OFFSET_UNITS;
}

static int is_hidden_by_planes(const cast_job *job, const lookup *at)
{
    const muj_record *planes = job->planes->data;
    int hidden = 0;
    for (size_t i = 0; i < job->planes->count && !hidden; i++)
        hidden = hides(&planes[i], offset_of(&planes[i]), at);
    return hidden;
}

static int list_band(const cast_job *job, int32_t band, e3d_array *out)
{
    const e3d_array *fragments = &job->fragments[band];
    size_t size = muj_fragment_size(job->picture);
    out->count = 0;
    if (!e3d_array_reserve(out, fragments->count / size + 1, sizeof(lookup)))
        return 0;
    lookup *next = out->data;
    for (size_t k = 0; k < fragments->count; k += size) {
        muj_fragment *fragment = (muj_fragment *)((uint8_t *)fragments->data + k);
        if (fragment->shadowed & job->bit || !find_lookup(job, fragment, next))
            continue;
        if (is_hidden_by_planes(job, next))
            fragment->shadowed |= job->bit;
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

static int sort_lookups(cast_job *job, size_t total)
{
    size_t cells = (size_t)job->cells[0] * (size_t)job->cells[1];
    if (!e3d_array_reserve(&job->memory->starts, cells + 2, sizeof(int32_t)) ||
        !e3d_array_reserve(&job->memory->sorted, total, sizeof(lookup)))
        return 0;
    int32_t *starts = job->memory->starts.data;
    lookup *sorted = job->memory->sorted.data;
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
        for (size_t i = 0; i < job->memory->lists[band].count; i++)
            sorted[starts[cell_of(job, all[i].x, all[i].y) + 1]++] = all[i];
    }
    return 1;
}

/* ---- casters ---- */

static void cast_record(const cast_job *job, const muj_record *record)
{
    const int32_t *starts = job->memory->starts.data;
    const lookup *sorted = job->memory->sorted.data;
    double offset = offset_of(record);
    int32_t first = cell_of(job, record->x0, record->y0), last = cell_of(job, record->x0, record->y1);
    int32_t wide = cell_of(job, record->x1, record->y0) - first + 1;
    for (int32_t row = first; row <= last; row += job->cells[0])
        for (int32_t i = starts[row]; i < starts[row + wide]; i++)
            if (hides(record, offset, &sorted[i])) {
                uint8_t *mark = sorted[i].mark;
                __atomic_store_n(mark, (uint8_t)(__atomic_load_n(mark, __ATOMIC_RELAXED) | job->bit), __ATOMIC_RELAXED);
            }
}

static void cast_records(const cast_job *job, e3d_array *records)
{
    const muj_record *all = records->data;
    for (size_t i = 0; i < records->count; i++)
        cast_record(job, &all[i]);
    records->count = 0;
}

/* Whether a triangle surely covers no texel that is read: most do not, and need no record. */
static int is_idle(const cast_job *job, const muj_vertex *const v[3])
{
    const int32_t *starts = job->memory->starts.data;
    int32_t low[2] = {v[0]->snapped_x, v[0]->snapped_y}, high[2] = {v[0]->snapped_x, v[0]->snapped_y};
    for (int k = 1; k < 3; k++) {
        low[0] = v[k]->snapped_x < low[0] ? v[k]->snapped_x : low[0], high[0] = v[k]->snapped_x > high[0] ? v[k]->snapped_x : high[0];
        low[1] = v[k]->snapped_y < low[1] ? v[k]->snapped_y : low[1], high[1] = v[k]->snapped_y > high[1] ? v[k]->snapped_y : high[1];
    }
    for (int c = 0; c < 2; c++) {
        low[c] = (low[c] + MUJ_SUB / 2 - 1) >> 8, high[c] = (high[c] - MUJ_SUB / 2) >> 8;
        low[c] = low[c] > job->view.low[c] ? low[c] : job->view.low[c], high[c] = high[c] < job->view.high[c] ? high[c] : job->view.high[c];
        if (low[c] > high[c])
            return 1;
    }
    int32_t first = cell_of(job, low[0], low[1]), last = cell_of(job, low[0], high[1]), wide = cell_of(job, high[0], low[1]) - first + 1;
    for (int32_t row = first; row <= last; row += job->cells[0])
        if (starts[row] != starts[row + wide])
            return 0;
    return 1;
}

static int cast_shape(const cast_job *job, const muj_draw *draw, muj_worker *worker)
{
    const e3d_muj_shape *shape = draw->shape;
    if (muj_is_outside(draw, &job->view))
        return 1;
    if (!e3d_array_reserve(&worker->vertices, (size_t)shape->vertices, sizeof(muj_vertex)))
        return 0;
    const muj_vertex *vertices = worker->vertices.data;
    muj_transform(draw, &job->view, worker->vertices.data);
    for (int32_t t = 0; t < shape->triangles; t++) {
        const int32_t *corner = shape->corners + 3 * (size_t)t;
        const muj_vertex *v[3] = {vertices + corner[0], vertices + corner[1], vertices + corner[2]};
        if (!(v[0]->outside | v[1]->outside | v[2]->outside) && is_idle(job, v))
            continue;
        muj_set_up(&job->view, 0, draw, 0, vertices, t, t + 1, &worker->records);
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

int muj_cast(const muj_picture *picture, int32_t k, const e3d_array *fragments, int32_t bands, int32_t threads, muj_shadow_memory *memory)
{
    cast_job job = {.picture = picture, .memory = memory, .fragments = fragments, .planes = &memory->planes, .bit = (uint8_t)(1 << k)};
    job.bands = bands;
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
    for (int32_t w = 0; w < memory->worker_count; w++) {
        e3d_array_free(&memory->workers[w].records);
        e3d_array_free(&memory->workers[w].vertices);
    }
    for (int32_t i = 0; i < memory->list_count; i++)
        e3d_array_free(&memory->lists[i]);
    free(memory->workers);
    free(memory->lists);
    e3d_array_free(&memory->planes);
    e3d_array_free(&memory->sorted);
    e3d_array_free(&memory->starts);
}
