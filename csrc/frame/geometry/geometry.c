/* geometry: walks over a round's candidates, whose clusters become records and fragments in bins. Candidates are groups of
 * clusters, the near ones first. Threads take some of them at a time; each thread has records and bins of its own. */
#include <stdatomic.h>

#include "data/mesh/mesh.h"
#include "base/pool.h"
#include "frame/cull/cull.h"
#include "frame/cull/history.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/fetch.h"
#include "frame/geometry/fragments.h"
#include "frame/geometry/geometry.h"
#include "frame/geometry/group.h"
#include "frame/geometry/lines.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

enum { TASKS_A_THREAD = 64 };
enum { MOST_CANDIDATES_A_TASK = 32 };
enum { UNITS_A_TASK = 8 };
enum { LEAST_WORK = 4 }; /* the least number of candidates, or of tasks of units, for which a second thread pays */

/* What all threads do with the candidates and the units. */
typedef struct geometry_job {
    const e3d_geometry_in *in;
    const e3d_geometry_out *out;
    atomic_llong next, next_unit;
} geometry_job;

/* Clusters that the last frame showed are drawn without a test. Each frame tests a quarter of them again, so that those that are
 * hidden now drop out. */
enum { FRAMES_A_TRIAL = 4 };

/* Stores what showed. Other threads may read it at the same time, to decide what to prefetch. */
static void set_seen(const e3d_geometry_out *out, const e3d_candidate *candidate, unsigned seen)
{
    __atomic_store_n(&out->seen[candidate->number], (uint8_t)seen, __ATOMIC_RELAXED);
}

static void visit(const e3d_visit *v)
{
    const e3d_candidate *candidate = v->candidate;
    unsigned all = (1u << v->group->clusters) - 1;
    if (v->in->round.choice == E3D_ALL_CANDIDATES) {
        unsigned shown = e3d_draw_group(v, all, all);
        if (v->out->seen)
            set_seen(v->out, candidate, shown);
        return;
    }
    unsigned seen = v->out->seen[candidate->number];
    if (v->in->round.choice == E3D_SEEN_CANDIDATES) {
        if (seen)
            e3d_draw_group(v, seen, seen);
        return;
    }
    const e3d_history *history = v->in->history;
    int tried = history->doubts || (candidate->number + history->trials) % FRAMES_A_TRIAL == 0;
    unsigned trusted = tried ? 0 : seen;
    if (trusted != all)
        set_seen(v->out, candidate, trusted | e3d_draw_group(v, all & ~trusted, all & ~seen));
}

static void visit_candidate(const geometry_job *job, e3d_geometry_memory *state, const e3d_candidate *candidate, e3d_next_clusters *next)
{
    const e3d_prepared *pass = job->in->pass;
    const e3d_draw_state *draw = &pass->draws->states[candidate->draw];
    const e3d_visit v = {.in = job->in,
                         .out = job->out,
                         .pass = pass,
                         .state = state,
                         .next = next,
                         .candidate = candidate,
                         .draw = draw,
                         .instance = &pass->view->instances[candidate->instance],
                         .group = &draw->mesh->groups[candidate->group]};
    visit(&v);
}

/* How many candidates a thread takes at once: enough that it seldom asks, and so few that no thread waits long for another's
 * last ones. */
static int64_t candidates_a_task(const e3d_geometry_in *in)
{
    int64_t candidates = (in->round.end - in->round.first) / (TASKS_A_THREAD * in->pass->threads);
    candidates = candidates < MOST_CANDIDATES_A_TASK ? candidates : MOST_CANDIDATES_A_TASK;
    return candidates > 1 ? candidates : 1;
}

static void walk_candidates(geometry_job *job, e3d_geometry_memory *state)
{
    enum { AHEAD = 6 };
    const e3d_geometry_in *in = job->in;
    const e3d_candidate *candidates = in->candidates;
    int64_t end = in->round.end, task = candidates_a_task(in);
    while (!state->failed) {
        int64_t first = in->round.first + atomic_fetch_add(&job->next, task);
        if (first >= end)
            return;
        for (int64_t i = first; i < first + task && i < end; i++) {
            if (i + 2 * AHEAD < end)
                e3d_fetch_seen(in, job->out, &candidates[i + 2 * AHEAD]);
            if (i + AHEAD < end)
                e3d_fetch_instance(in, job->out, &candidates[i + AHEAD]);
            e3d_next_clusters next = {0};
            if (i + 1 < end)
                next = e3d_find_next(in, job->out, &candidates[i + 1]);
            visit_candidate(job, state, &candidates[i], &next);
        }
    }
}

static void walk_units(const e3d_prepared *pass, e3d_geometry_memory *state, atomic_llong *next)
{
    while (!state->failed) {
        int64_t first = atomic_fetch_add(next, UNITS_A_TASK);
        if (first >= pass->draws->units)
            return;
        for (int64_t unit = first; unit < first + UNITS_A_TASK && unit < pass->draws->units; unit++) {
            const e3d_draw_state *draw = e3d_draw_of_unit(pass->draws, unit);
            int32_t instance = (int32_t)((unit - draw->unit_base) / draw->units);
            e3d_draw_unit(pass, state, draw, instance, (int32_t)((unit - draw->unit_base) % draw->units));
        }
    }
}

static void geometry_work(void *argument, int number)
{
    geometry_job *job = argument;
    e3d_geometry_memory *state = job->out->bins->of[number];
    walk_candidates(job, state);
    e3d_fragments_flush(job->in->pass, state);
    if (job->in->round.last)
        walk_units(job->in->pass, state, &job->next_unit);
}

int e3d_geometry(const e3d_geometry_in *in, const e3d_geometry_out *out)
{
    geometry_job job = {.in = in, .out = out};
    int64_t work = in->round.end - in->round.first + in->pass->draws->units / UNITS_A_TASK;
    int failed = 0;
    e3d_pool_run(work > LEAST_WORK ? in->pass->threads : 1, geometry_work, &job);
    for (int32_t t = 0; t < in->pass->threads; t++)
        failed |= out->bins->of[t]->failed;
    e3d_bins_index(out->bins);
    return !failed;
}
