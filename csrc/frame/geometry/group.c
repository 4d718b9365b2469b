/* geometry: decides which clusters of a group are drawn; the others are outside, face away, or are hidden. A cluster that may
 * reach into an aperture is open: its backs aren't culled (R9). */
#include "base/limits.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#include "frame/cull/depths.h"
#include "frame/geometry/cluster.h"
#include "frame/geometry/group.h"
#include "frame/pass/boxes.h"
#include "frame/pass/plan.h"

/* Whether a box may reach into an aperture. */
static int reaches_aperture(const e3d_visit *v, const float lo[3], const float hi[3])
{
    e3d_box_view box;
    e3d_view_box(&v->pass->view->viewport, v->instance->clip, lo, hi, &box);
    return box.state != E3D_BOX_OUTSIDE && e3d_meets_aperture(v->pass->view, &box.samples);
}

/* Whether the cluster's vertices may reach into an aperture; they enclose less than its box. */
static int vertices_reach_aperture(const e3d_visit *v)
{
    e3d_box_view view;
    return !e3d_view_vertices(&v->pass->view->viewport, &v->state->vertices, &view) || e3d_meets_aperture(v->pass->view,
                                                                                                          &view.samples);
}

/* The group's clusters that may reach into an aperture: a bit each. */
static unsigned find_open(const e3d_visit *v)
{
    const e3d_cluster *clusters = &v->draw->mesh->clusters[v->group->first_cluster];
    unsigned open = 0;
    if (!v->pass->view->aperture_count || v->draw->all_two_sided || !reaches_aperture(v, v->group->lo, v->group->hi))
        return 0;
    for (int k = 0; k < v->group->clusters; k++)
        open |= (unsigned)reaches_aperture(v, clusters[k].lo, clusters[k].hi) << k;
    return open;
}

/* Which of a group's clusters face away: a bit each. */
static unsigned find_away(const e3d_visit *v, const e3d_cluster_job *job)
{
    if (!e3d_plans(v->pass, E3D_PLAN_FACES)) /* edges are drawn whichever way their faces face */
        return 0;
    return v->pass->kernels->face_away(&v->draw->mesh->clusters[v->group->first_cluster], v->group->clusters, &v->instance->facing,
                                       e3d_drop_sign(job), v->instance->clip, &v->pass->view->viewport);
}

/* Whether the depths of earlier rounds hide a box. */
static int is_hidden(const e3d_visit *v, const e3d_box_view *view)
{
    return v->in->round.tested && e3d_is_hidden(v->in->depths, v->pass->view->tiles_x, view);
}

/* The fate of a cluster before it is tested against depths. If it may show, *view is what that test needs. */
static e3d_cull_result result_of(const e3d_visit *v, const e3d_cluster *cluster, int away, e3d_box_view *view)
{
    const float *clip = v->pass->frustum->instances[v->candidate->instance].clip;
    if (!cluster->any_finite)
        return E3D_RESULT_OUTSIDE;
    if (away)
        return v->candidate->view.state == E3D_BOX_INSIDE || e3d_box_state(clip, cluster->lo, cluster->hi) != E3D_BOX_OUTSIDE
                   ? E3D_RESULT_BACKFACING
                   : E3D_RESULT_OUTSIDE;
    if (!v->in->round.tested && v->candidate->view.state == E3D_BOX_INSIDE)
        return E3D_RESULT_DRAWN;
    e3d_view_box(&v->pass->view->viewport, clip, cluster->lo, cluster->hi, view);
    return view->state == E3D_BOX_OUTSIDE ? E3D_RESULT_OUTSIDE : E3D_RESULT_DRAWN;
}

/* The fate of a cluster, with the test against the depths of earlier rounds. */
static e3d_cull_result tested_result_of(const e3d_visit *v, const e3d_cluster *cluster, int away)
{
    e3d_box_view view;
    e3d_cull_result result = result_of(v, cluster, away, &view);
    return result == E3D_RESULT_DRAWN && is_hidden(v, &view) ? E3D_RESULT_OCCLUDED : result;
}

/* Finds the fates of the clusters whose bits are set, and returns the bits of those that are drawn. Clusters that were seen
 * faced the viewer, and are tested again in turn. */
static unsigned find_results(const e3d_visit *v, const e3d_cluster_job *job, unsigned asked, unsigned open,
                             e3d_cull_result results[E3D_GROUP_CLUSTERS])
{
    unsigned shown = 0, away = v->in->round.choice == E3D_SEEN_CANDIDATES ? 0 : find_away(v, job) & ~open;
    for (unsigned left = asked; left; left &= left - 1) {
        int k = __builtin_ctz(left);
        results[k] = tested_result_of(v, &v->draw->mesh->clusters[v->group->first_cluster + k], away >> k & 1);
        shown |= (unsigned)(results[k] == E3D_RESULT_DRAWN) << k;
    }
    return shown;
}

/* Whether depths hide everything that the cluster's vertices enclose on the screen, which is less than its box. */
static int vertices_are_hidden(const e3d_visit *v)
{
    e3d_box_view view;
    return e3d_view_vertices(&v->pass->view->viewport, &v->state->vertices, &view) && is_hidden(v, &view);
}

/* Whether a group is large enough on the screen for tests of its clusters' vertices. Drawing a smaller one takes no longer. */
static int is_wide(const e3d_box *samples)
{
    enum { WIDE = 48 };
    return (samples->x1 - samples->x0) + (samples->y1 - samples->y0) > WIDE;
}

/* Marks the instance as shown. Several threads may mark the same instance. */
static void mark(const e3d_visit *v, e3d_cull_result result)
{
    uint8_t *marks = &v->out->marks[v->candidate->instance];
    uint8_t bits = result == E3D_RESULT_DRAWN || result == E3D_RESULT_BACKFACING ? E3D_MARK_UNOCCLUDED : 0;
    bits |= result == E3D_RESULT_DRAWN ? E3D_MARK_DRAWN : 0;
    if (bits & ~__atomic_load_n(marks, __ATOMIC_RELAXED))
        __atomic_fetch_or(marks, bits, __ATOMIC_RELAXED);
}

static void count_cluster(const e3d_visit *v, const e3d_cluster *cluster, e3d_cull_result result)
{
    v->state->counters.culled.clusters[result]++;
    v->state->counters.culled.triangles[result] += cluster->triangles;
    if (result == E3D_RESULT_DRAWN && !e3d_plans(v->pass, E3D_PLAN_FACES))
        v->state->counters.triangles_drawn += cluster->triangles;
    mark(v, result);
}

/* Counts the clusters of a hidden group. It looks at each one only if not all of them count, or not all are in the frustum. */
static void count_hidden(const e3d_visit *v, unsigned counted)
{
    e3d_cull_counters *counters = &v->state->counters.culled;
    const e3d_cluster *clusters = &v->draw->mesh->clusters[v->group->first_cluster];
    const float *clip = v->pass->frustum->instances[v->candidate->instance].clip;
    int inside = v->candidate->view.state == E3D_BOX_INSIDE;
    if (inside && counted == (1u << v->group->clusters) - 1) {
        counters->clusters[E3D_RESULT_OCCLUDED] += v->group->clusters;
        counters->triangles[E3D_RESULT_OCCLUDED] += v->group->triangles;
        return;
    }
    for (unsigned left = counted; left; left &= left - 1) {
        const e3d_cluster *cluster = &clusters[__builtin_ctz(left)];
        int outside = !inside && e3d_box_state(clip, cluster->lo, cluster->hi) == E3D_BOX_OUTSIDE;
        counters->clusters[outside ? E3D_RESULT_OUTSIDE : E3D_RESULT_OCCLUDED]++;
        counters->triangles[outside ? E3D_RESULT_OUTSIDE : E3D_RESULT_OCCLUDED] += cluster->triangles;
    }
}

/* The part of a cluster's job that all clusters of the group share. */
static e3d_cluster_job job_of(const e3d_visit *v)
{
    uint32_t number = v->candidate->instance;
    if (!v->instance->ready)
        e3d_view_finish_instance(v->out->view, v->out->draws, number);
    return (e3d_cluster_job){.pass = v->pass,
                             .state = v->state,
                             .draw = v->draw,
                             .instance = v->instance,
                             .number = number,
                             .order = v->pass->draws->instances[number].order};
}

unsigned e3d_draw_group(const e3d_visit *v, unsigned asked, unsigned wanted)
{
    const e3d_mesh *mesh = v->draw->mesh;
    const e3d_cluster *clusters = &mesh->clusters[v->group->first_cluster];
    e3d_cull_result results[E3D_GROUP_CLUSTERS] = {E3D_RESULT_DRAWN};
    if (is_hidden(v, &v->candidate->view)) {
        count_hidden(v, asked & wanted);
        return 0;
    }
    e3d_cluster_job job = job_of(v);
    unsigned open = find_open(v), shown = asked;
    if (mesh->desc.components == 3 && e3d_culls_parts(v->pass->frame))
        shown = find_results(v, &job, asked, open, results);
    int closely = v->in->round.tested && is_wide(&v->candidate->view.samples);
    int inside = v->candidate->view.state == E3D_BOX_INSIDE && v->pass->frustum == v->pass->view;
    unsigned left = e3d_plans(v->pass, E3D_PLAN_FACES) ? shown : 0;
    for (left &= closely ? ~0u : wanted; left; left &= left - 1) {
        int k = __builtin_ctz(left);
        e3d_fetch_next(mesh, clusters, left & (left - 1), v->next);
        job.cluster = &clusters[k];
        job.indices = e3d_cluster_indices(job.cluster, mesh->desc.components);
        e3d_transform_cluster(&job, inside);
        job.open = open >> k & 1 && vertices_reach_aperture(v);
        if (closely && vertices_are_hidden(v)) {
            results[k] = E3D_RESULT_OCCLUDED;
            shown &= ~(1u << k);
        } else if (wanted >> k & 1) {
            e3d_draw_cluster(&job);
        }
    }
    for (left = asked & wanted; left; left &= left - 1)
        count_cluster(v, &clusters[__builtin_ctz(left)], results[__builtin_ctz(left)]);
    return shown;
}
