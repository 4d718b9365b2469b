/* cull: which groups of clusters may show, from the nearest to the farthest.
 *
 * In:  the frame's instances, and the boxes of their meshes' groups.
 * Out: candidates, sorted by the depth of their nearest corner, in an order that no thread's timing changes.
 */
#include <string.h>

#include "core/grow.h"
#include "core/mesh.h"
#include "core/pool.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "pipeline/cull/cull.h"
#include "pipeline/pass/boxes.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/counts.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/worker.h"

enum { GROUPS_A_TASK = 512 };

/* What one task left in its thread's list. */
typedef struct task {
    int32_t worker, count;
    size_t first;
} task;

static void add_candidate(e3d_context *context, e3d_worker *worker, const e3d_draw_state *draw, uint32_t number,
                          int32_t group, int64_t group_number)
{
    const e3d_group_box *box = &draw->mesh->groups[group];
    e3d_candidate candidate = {number, (uint32_t)group, (int32_t)(draw - context->draws->states), (int32_t)group_number,
                               {E3D_BOX_CROSSES, E3D_DEPTH_UNBOUNDED, {0, 0, 0, 0}}};
    int bounded = draw->mesh->desc.components == 3;
    if (bounded && box->any_finite)
        e3d_view_box(&context->view->viewport, e3d_culling_matrix(context->view, number), box->lo, box->hi, &candidate.view);
    if (bounded && context->frame->culling != E3D_CULLING_NONE && (!box->any_finite || candidate.view.state == E3D_BOX_OUTSIDE)) {
        worker->counters.clusters[E3D_RESULT_OUTSIDE] += box->clusters;
        worker->counters.triangles[E3D_RESULT_OUTSIDE] += box->triangles;
        return;
    }
    const e3d_box blocks = e3d_blocks_of(&candidate.view.samples);
    worker->counters.blocks += (int64_t)(blocks.x1 - blocks.x0 + 1) * (blocks.y1 - blocks.y0 + 1);
    if (!e3d_array_reserve(&worker->cull.candidates, worker->cull.candidates.count + 1, sizeof candidate)) {
        worker->failed = 1;
        return;
    }
    ((e3d_candidate *)worker->cull.candidates.data)[worker->cull.candidates.count++] = candidate;
}

/* Groups [first, end) of the frame: draw after draw, instance after instance. */
static void cull_groups(e3d_context *context, e3d_worker *worker, int64_t first, int64_t end)
{
    const e3d_draw_state *draw = e3d_draw_of_group(context->draws, first);
    for (int64_t group_number = first; group_number < end;) {
        while (group_number >= draw->group_base + (int64_t)draw->mesh->group_count * draw->draw->instances)
            draw++;
        int32_t groups = draw->mesh->group_count;
        int64_t within = group_number - draw->group_base;
        uint32_t number = (uint32_t)(draw->instance_base + within / groups);
        int32_t group = (int32_t)(within % groups);
        for (; group < groups && group_number < end; group++, group_number++)
            if (context->view->instances[number].shows)
                add_candidate(context, worker, draw, number, group, group_number);
            else {
                worker->counters.clusters[E3D_RESULT_OUTSIDE] += draw->mesh->groups[group].clusters;
                worker->counters.triangles[E3D_RESULT_OUTSIDE] += draw->mesh->groups[group].triangles;
            }
    }
}

static void cull_work(void *argument, int number)
{
    e3d_context *context = argument;
    e3d_worker *worker = context->renderer->workers[number];
    task *tasks = context->renderer->cull.tasks.data;
    while (!atomic_load(&context->stop)) {
        int64_t at = atomic_fetch_add(&context->next, 1), first = at * GROUPS_A_TASK;
        if (first >= context->draws->groups)
            return;
        int64_t end = first + GROUPS_A_TASK < context->draws->groups ? first + GROUPS_A_TASK : context->draws->groups;
        size_t before = worker->cull.candidates.count;
        cull_groups(context, worker, first, end);
        tasks[at] = (task){number, (int32_t)(worker->cull.candidates.count - before), before};
    }
}

/* ---- from the nearest to the farthest ---- */

enum { BUCKETS = 1024 };

/* Logarithmic in the distance of z_ndc from the far plane: in perspective about the distance from the eye. */
static uint32_t bucket_of(float near)
{
    float from_far = 1.0f - near;
    uint32_t bits, most = 129u << 5;
    from_far = from_far > 0x1p-30f ? from_far : 0x1p-30f;
    memcpy(&bits, &from_far, 4);
    bits >>= 18; /* the exponent and 5 bits more */
    return bits < most ? most - bits < BUCKETS ? most - bits : BUCKETS - 1 : 0;
}

static int sort_candidates(e3d_context *context, int64_t task_count)
{
    e3d_renderer *renderer = context->renderer;
    const task *tasks = renderer->cull.tasks.data;
    uint32_t start[BUCKETS] = {0}, total = 0;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_candidate *candidates = renderer->workers[w]->cull.candidates.data;
        for (size_t i = 0; i < renderer->workers[w]->cull.candidates.count; i++)
            start[bucket_of(candidates[i].view.near)]++;
    }
    for (int b = 0; b < BUCKETS; b++) {
        uint32_t count = start[b];
        start[b] = total;
        total += count;
    }
    if (!e3d_array_reserve(&renderer->cull.candidates, (size_t)total + 1, sizeof(e3d_candidate)))
        return 0;
    e3d_candidate *out = renderer->cull.candidates.data;
    for (int64_t t = 0; t < task_count; t++) {
        const e3d_candidate *candidates = renderer->workers[tasks[t].worker]->cull.candidates.data;
        for (int32_t i = 0; i < tasks[t].count; i++) {
            const e3d_candidate *candidate = &candidates[tasks[t].first + i];
            out[start[bucket_of(candidate->view.near)]++] = *candidate;
        }
    }
    context->candidates = out;
    context->candidate_count = total;
    return 1;
}

int e3d_find_candidates(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    int64_t task_count = (context->draws->groups + GROUPS_A_TASK - 1) / GROUPS_A_TASK;
    if (!e3d_array_reserve(&renderer->cull.tasks, (size_t)task_count + 1, sizeof(task)))
        return 0;
    for (int32_t w = 0; w < renderer->threads; w++)
        renderer->workers[w]->cull.candidates.count = 0;
    atomic_store(&context->next, 0);
    e3d_pool_run(task_count > 1 ? renderer->threads : 1, cull_work, context);
    return !e3d_any_failed(renderer) && sort_candidates(context, task_count);
}

void e3d_cull_free(e3d_cull_memory *memory)
{
    e3d_array_free(&memory->tasks);
    e3d_array_free(&memory->candidates);
}
