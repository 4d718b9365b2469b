/* Shares out lines among threads, and cuts each into pieces by the stretches that were found. */
#include "extras/drawing/stretches.h"

#include <stdatomic.h>

#include "base/fpenv.h"
#include "base/pool.h"

enum { FEW = 16, /* stretches are sorted by insertion */
       LINES_AT_A_TIME = 256,
       MOST_THREADS = 256 };

typedef struct cutting {
    drw_find find;
    const void *argument;
    size_t count, items;
    e3d_array *chunks; /* of e3d_piece, for each chunk of lines */
    atomic_size_t next;
    atomic_int is_out_of_memory;
} cutting;

int drw_add(drw_scratch *scratch, double from, double to, double least)
{
    e3d_array *all = &scratch->stretches;
    if (!e3d_array_reserve(all, all->count + 1, sizeof(drw_stretch))) {
        scratch->is_out_of_memory = 1;
        return 1;
    }
    ((drw_stretch *)all->data)[all->count++] = (drw_stretch){from, to};
    return from <= least && to >= 1 - least;
}

static int by_beginning(const void *a, const void *b)
{
    const drw_stretch *first = a, *second = b;
    if (first->from != second->from)
        return first->from < second->from ? -1 : 1;
    return (first->to > second->to) - (first->to < second->to);
}

static void sort(drw_stretch *all, size_t count)
{
    if (count > FEW) {
        qsort(all, count, sizeof *all, by_beginning);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        drw_stretch one = all[i];
        size_t at = i;
        for (; at && by_beginning(&one, &all[at - 1]) < 0; at--)
            all[at] = all[at - 1];
        all[at] = one;
    }
}

/* Joins stretches that overlap, or nearly so; leaves out those that count as nothing. Returns how many are left. */
static size_t join(drw_stretch *all, size_t count, double least)
{
    size_t joined = 0, kept = 0;
    sort(all, count);
    for (size_t i = 0; i < count; i++) {
        if (joined && all[i].from <= all[joined - 1].to + least)
            all[joined - 1].to = all[i].to > all[joined - 1].to ? all[i].to : all[joined - 1].to;
        else
            all[joined++] = all[i];
    }
    for (size_t i = 0; i < joined; i++) {
        drw_stretch one = all[i];
        one.from = one.from <= least ? 0 : one.from;
        one.to = one.to >= 1 - least ? 1 : one.to;
        if (one.to - one.from > least)
            all[kept++] = one;
    }
    return kept;
}

static int put(e3d_array *pieces, int32_t line, int is_hidden, double from, double to)
{
    if (!(from < to))
        return 1;
    if (!e3d_array_reserve(pieces, pieces->count + 1, sizeof(e3d_piece)))
        return 0;
    ((e3d_piece *)pieces->data)[pieces->count++] = (e3d_piece){line, is_hidden, from, to};
    return 1;
}

static int cut(e3d_array *pieces, int32_t line, drw_scratch *scratch, double least)
{
    drw_stretch *all = scratch->stretches.data;
    size_t count = scratch->stretches.count ? join(all, scratch->stretches.count, least) : 0;
    double at = 0;
    int fits = !scratch->is_out_of_memory;
    for (size_t i = 0; i < count && fits; i++) {
        fits = put(pieces, line, 0, at, all[i].from) && put(pieces, line, 1, all[i].from, all[i].to);
        at = all[i].to;
    }
    return fits && put(pieces, line, 0, at, 1);
}

static int cut_chunk(const cutting *job, size_t chunk, drw_scratch *scratch)
{
    size_t first = chunk * LINES_AT_A_TIME, end = first + LINES_AT_A_TIME < job->count ? first + LINES_AT_A_TIME : job->count;
    for (size_t line = first; line < end; line++) {
        double least = 0;
        scratch->stretches.count = 0;
        if (job->find(job->argument, (int32_t)line, scratch, &least) && !cut(&job->chunks[chunk], (int32_t)line, scratch, least))
            return 0;
    }
    return !scratch->is_out_of_memory;
}

static void cut_some(void *argument, int worker)
{
    cutting *job = argument;
    (void)worker;
    e3d_fpenv saved = e3d_fpenv_enter();
    drw_scratch scratch = {{0}, calloc(job->items + 1, sizeof(int32_t)), 0};
    size_t chunks = (job->count + LINES_AT_A_TIME - 1) / LINES_AT_A_TIME;
    int fits = scratch.seen != NULL;
    for (size_t chunk = 0; fits && (chunk = atomic_fetch_add(&job->next, 1)) < chunks;)
        fits = cut_chunk(job, chunk, &scratch);
    if (!fits)
        atomic_store(&job->is_out_of_memory, 1);
    e3d_array_free(&scratch.stretches);
    free(scratch.seen);
    e3d_fpenv_leave(saved);
}

static e3d_status gather(const cutting *job, size_t chunks, e3d_piece **pieces, size_t *found)
{
    size_t total = 0, at = 0;
    for (size_t chunk = 0; chunk < chunks; chunk++)
        total += job->chunks[chunk].count;
    e3d_piece *all = malloc((total + 1) * sizeof *all);
    if (!all)
        return E3D_OUT_OF_MEMORY;
    for (size_t chunk = 0; chunk < chunks; chunk++) {
        if (job->chunks[chunk].count)
            memcpy(all + at, job->chunks[chunk].data, job->chunks[chunk].count * sizeof *all);
        at += job->chunks[chunk].count;
    }
    *pieces = all;
    *found = total;
    return E3D_OK;
}

e3d_status drw_cut_lines(drw_find find, const void *argument, size_t count, size_t items, int threads, e3d_piece **pieces,
                         size_t *found)
{
    size_t chunks = (count + LINES_AT_A_TIME - 1) / LINES_AT_A_TIME;
    cutting job = {.find = find, .argument = argument, .count = count, .items = items};
    job.chunks = calloc(chunks + 1, sizeof *job.chunks);
    if (!job.chunks)
        return E3D_OUT_OF_MEMORY;
    size_t wanted = chunks < MOST_THREADS ? chunks : MOST_THREADS;
    threads = (size_t)threads < wanted ? threads : (int)wanted;
    e3d_pool_run(threads > 1 ? threads : 1, cut_some, &job);
    e3d_status status = job.is_out_of_memory ? E3D_OUT_OF_MEMORY : gather(&job, chunks, pieces, found);
    for (size_t chunk = 0; chunk < chunks; chunk++)
        e3d_array_free(&job.chunks[chunk]);
    free(job.chunks);
    return status;
}
