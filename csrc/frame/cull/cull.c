/* cull: lists the groups of clusters that may show, from the nearest to the farthest.
 * In: the pass's instances, and the boxes of their meshes' groups.
 * Out: candidates, sorted by the depth of their nearest corner; the order does not depend on the threads' timing. */
#include <stdatomic.h>
#include <string.h>

#include "data/mesh/mesh.h"
#include "base/pool.h"
#include "e3d.h"
#include "frame/cull/cull.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "kernels/coverage.h"

enum { GROUPS_A_TASK = 512 };

/* The candidates that one task added to its thread's list. */
typedef struct task {
    int32_t worker, count;
    size_t first;
} task;

/* What all threads do with the groups. */
typedef struct cull_job {
    const e3d_prepared *pass;
    e3d_cull_memory *out;
    atomic_llong next; /* task */
} cull_job;

static void count_outside(e3d_cull_state *state, const e3d_group_box *box)
{
    state->counters.clusters[E3D_RESULT_OUTSIDE] += box->clusters;
    state->counters.triangles[E3D_RESULT_OUTSIDE] += box->triangles;
}

static void add_candidate(const e3d_prepared *pass, e3d_cull_state *state, const e3d_draw_state *draw, uint32_t number, int32_t group,
                          int64_t group_number)
{
    const e3d_group_box *box = &draw->mesh->groups[group];
    e3d_candidate candidate = {.instance = number,
                               .group = (uint32_t)group,
                               .draw = (int32_t)(draw - pass->draws->states),
                               .number = (int32_t)group_number,
                               .view = {E3D_BOX_CROSSES, E3D_DEPTH_UNBOUNDED, {0, 0, 0, 0}}};
    int bounded = draw->mesh->desc.components == 3;
    if (bounded && box->any_finite)
        e3d_view_box(&pass->view->viewport, pass->frustum->instances[number].clip, box->lo, box->hi, &candidate.view);
    if (bounded && e3d_culls_parts(pass->frame) && (!box->any_finite || candidate.view.state == E3D_BOX_OUTSIDE)) {
        count_outside(state, box);
        return;
    }
    const e3d_box blocks = e3d_blocks_of(&candidate.view.samples);
    state->blocks += (int64_t)(blocks.x1 - blocks.x0 + 1) * (blocks.y1 - blocks.y0 + 1);
    if (!e3d_array_reserve(&state->candidates, state->candidates.count + 1, sizeof candidate)) {
        state->failed = 1;
        return;
    }
    ((e3d_candidate *)state->candidates.data)[state->candidates.count++] = candidate;
}

/* Tests groups [first, end) of the pass, counted draw after draw and instance after instance. */
static void cull_groups(const e3d_prepared *pass, e3d_cull_state *state, int64_t first, int64_t end)
{
    const e3d_draw_state *draw = e3d_draw_of_group(pass->draws, first);
    for (int64_t group_number = first; group_number < end;) {
        while (group_number >= draw->group_base + (int64_t)draw->mesh->group_count * draw->draw->instances)
            draw++;
        int32_t groups = draw->mesh->group_count;
        int64_t within = group_number - draw->group_base;
        uint32_t number = (uint32_t)(draw->instance_base + within / groups);
        int32_t group = (int32_t)(within % groups);
        for (; group < groups && group_number < end; group++, group_number++)
            if (pass->frustum->instances[number].shows)
                add_candidate(pass, state, draw, number, group, group_number);
            else
                count_outside(state, &draw->mesh->groups[group]);
    }
}

static void cull_work(void *argument, int number)
{
    cull_job *job = argument;
    e3d_cull_state *state = job->out->of[number];
    task *tasks = job->out->tasks.data;
    int64_t groups = job->pass->draws->groups;
    for (;;) {
        int64_t at = atomic_fetch_add(&job->next, 1), first = at * GROUPS_A_TASK;
        if (first >= groups)
            return;
        size_t before = state->candidates.count;
        cull_groups(job->pass, state, first, first + GROUPS_A_TASK < groups ? first + GROUPS_A_TASK : groups);
        tasks[at] = (task){number, (int32_t)(state->candidates.count - before), before};
    }
}

/* ---- from the nearest to the farthest ---- */

enum { BUCKETS = 1024 };

/* A number that grows with the logarithm of the distance from the far plane, in z_ndc; in perspective this is about the distance
 * from the eye. */
static uint32_t bucket_of(float near)
{
    float from_far = 1.0f - near;
    uint32_t bits, most = 129u << 5;
    from_far = from_far > 0x1p-30f ? from_far : 0x1p-30f;
    memcpy(&bits, &from_far, 4);
    bits >>= 18; /* the exponent and 5 bits more */
    return bits < most ? most - bits < BUCKETS ? most - bits : BUCKETS - 1 : 0;
}

static int sort_candidates(e3d_cull_memory *memory, int32_t threads, int64_t task_count)
{
    const task *tasks = memory->tasks.data;
    uint32_t start[BUCKETS] = {0}, total = 0;
    for (int32_t t = 0; t < threads; t++) {
        const e3d_candidate *candidates = memory->of[t]->candidates.data;
        for (size_t i = 0; i < memory->of[t]->candidates.count; i++)
            start[bucket_of(candidates[i].view.near)]++;
    }
    for (int b = 0; b < BUCKETS; b++) {
        uint32_t count = start[b];
        start[b] = total;
        total += count;
    }
    if (!e3d_array_reserve(&memory->candidates, (size_t)total + 1, sizeof(e3d_candidate)))
        return 0;
    e3d_candidate *out = memory->candidates.data;
    for (int64_t t = 0; t < task_count; t++) {
        const e3d_candidate *candidates = memory->of[tasks[t].worker]->candidates.data; /* NULL if it never had any */
        for (size_t i = tasks[t].first; i < tasks[t].first + (size_t)tasks[t].count; i++)
            out[start[bucket_of(candidates[i].view.near)]++] = candidates[i];
    }
    memory->candidates.count = total;
    return 1;
}

int e3d_find_candidates(const e3d_prepared *pass, e3d_cull_memory *out)
{
    int64_t task_count = (pass->draws->groups + GROUPS_A_TASK - 1) / GROUPS_A_TASK;
    cull_job job = {.pass = pass, .out = out};
    int failed = 0;
    if (!e3d_array_reserve(&out->tasks, (size_t)task_count + 1, sizeof(task)))
        return 0;
    for (int32_t t = 0; t < pass->threads; t++)
        *out->of[t] = (e3d_cull_state){.candidates = {out->of[t]->candidates.data, 0, out->of[t]->candidates.room}};
    e3d_pool_run(task_count > 1 ? pass->threads : 1, cull_work, &job);
    for (int32_t t = 0; t < pass->threads; t++)
        failed |= out->of[t]->failed;
    return !failed && sort_candidates(out, pass->threads, task_count);
}

void e3d_cull_free(e3d_cull_memory *memory)
{
    e3d_array_free(&memory->tasks);
    e3d_array_free(&memory->candidates);
}
