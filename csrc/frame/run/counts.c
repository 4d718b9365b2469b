/* counts: counts the nodes, clusters and triangles that a frame submitted, and what became of them.
 * In: the workers' counters and the instances' marks, after the last tile.
 * Out: e3d_stats. */
#include "frame/cull/cull.h"
#include "frame/run/counts.h"
#include "frame/geometry/records.h"
#include "frame/geometry/round.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"

void e3d_count_submitted(const e3d_frame *frame, e3d_stats *stats)
{
    int32_t last = -1;
    int64_t nodes = 0;
    stats->draws = frame->draw_count;
    stats->instances = 0;
    stats->clusters = stats->triangles = 0;
    for (int32_t d = 0; d < frame->draw_count; d++) {
        const e3d_draw *draw = &frame->draws[d];
        stats->clusters += (int64_t)draw->mesh->cluster_count * draw->instances;
        stats->triangles += (int64_t)draw->mesh->desc.faces_count * draw->instances;
        stats->instances += draw->instances;
        if (draw->pose_kind == E3D_POSE_NODES)
            nodes += draw->instances;
        else if (draw->instances && draw->node_id != last) {
            nodes++;
            last = draw->node_id; /* the instances of a node follow each other */
        }
    }
    stats->nodes_unoccluded = stats->nodes_drawn = nodes;
    stats->instances_drawn = stats->instances;
    stats->clusters_in_frustum = stats->clusters_unoccluded = stats->clusters_drawn = stats->clusters;
    stats->triangles_in_frustum = stats->triangles_unoccluded = stats->triangles_drawn = stats->triangles;
}

/* Counts the instances of which anything shows; lines and points count, wherever they are. */
static int64_t count_instances(const e3d_draws *draws, const uint8_t *all)
{
    int64_t drawn = 0;
    for (int32_t d = 0; d < draws->count; d++) {
        const e3d_draw_state *state = &draws->states[d];
        if (state->units)
            drawn += state->draw->instances;
        else
            for (int32_t i = 0; i < state->draw->instances; i++)
                drawn += all[state->instance_base + i] & E3D_MARK_DRAWN ? 1 : 0;
    }
    return drawn;
}

/* The marks of one entry; `all` are those of all instances. */
static int marks_of(const e3d_draws *draws, const uint8_t *all, const e3d_order_entry *entry)
{
    const e3d_draw_state *state = &draws->states[entry->draw];
    const uint8_t *marks = all + state->instance_base + entry->instance;
    int32_t instances = state->draw->pose_kind == E3D_POSE_NODES ? 1 : state->draw->instances;
    int found = state->units && instances ? E3D_MARK_UNOCCLUDED | E3D_MARK_DRAWN : 0;
    for (int32_t i = 0; i < instances && !(found & E3D_MARK_DRAWN); i++)
        found |= marks[i];
    return found;
}

/* Counts nodes; a node may have several entries, which follow each other. */
static void count_nodes(const e3d_draws *draws, const uint8_t *all, e3d_stats *stats)
{
    int marks = 0;
    int32_t node = -1;
    for (int32_t t = 0; t <= draws->order_count; t++) {
        const e3d_order_entry *entry = t < draws->order_count ? &draws->order[t] : NULL;
        int32_t id = entry ? e3d_object_id(draws->states[entry->draw].draw, entry->instance) : -1;
        if (!entry || id != node) {
            stats->nodes_unoccluded += marks & E3D_MARK_UNOCCLUDED ? 1 : 0;
            stats->nodes_drawn += marks & E3D_MARK_DRAWN ? 1 : 0;
            marks = 0;
            node = id;
        }
        marks |= entry ? marks_of(draws, all, entry) : 0;
    }
}

static void add_culled(e3d_stats *stats, const e3d_cull_counters *c)
{
    const int64_t *clusters = c->clusters, *triangles = c->triangles;
    stats->clusters_drawn += clusters[E3D_RESULT_DRAWN];
    stats->clusters_unoccluded += clusters[E3D_RESULT_DRAWN] + clusters[E3D_RESULT_BACKFACING];
    stats->clusters_occluded += clusters[E3D_RESULT_OCCLUDED];
    stats->clusters_culled += clusters[E3D_RESULT_OUTSIDE] + clusters[E3D_RESULT_BACKFACING];
    stats->triangles_unoccluded += triangles[E3D_RESULT_DRAWN] + triangles[E3D_RESULT_BACKFACING];
    stats->triangles_occluded += triangles[E3D_RESULT_OCCLUDED];
    stats->triangles_culled += triangles[E3D_RESULT_OUTSIDE] + triangles[E3D_RESULT_BACKFACING];
}

static void add_worker(e3d_stats *stats, const e3d_worker *worker, int32_t threads)
{
    const e3d_geometry_counters *c = &worker->geometry.counters;
    add_culled(stats, &worker->cull.counters);
    add_culled(stats, &c->culled);
    stats->triangles_drawn += c->triangles_drawn;
    stats->triangles_culled += c->triangles_rejected;
    stats->triangles_clipped += c->triangles_clipped;
    stats->triangles_setup += c->records;
    stats->bin_entries += c->bin_entries;
    stats->pixels_shaded += worker->tile.shade.shaded;
    stats->ms_raster += (double)worker->tile.ns_raster * 1e-6 / threads;
    stats->ms_shade += (double)worker->tile.ns_shade * 1e-6 / threads;
    stats->ms_resolve += (double)worker->tile.ns_resolve * 1e-6 / threads;
}

void e3d_count(const e3d_prepared *pass, const e3d_renderer *renderer, e3d_stats *stats)
{
    e3d_count_submitted(pass->frame, stats);
    stats->nodes_unoccluded = stats->nodes_drawn = 0;
    stats->clusters_unoccluded = stats->clusters_drawn = stats->triangles_unoccluded = stats->triangles_drawn = 0;
    for (int32_t t = 0; t < renderer->threads; t++)
        add_worker(stats, renderer->workers[t], renderer->threads);
    stats->clusters_in_frustum = stats->clusters_unoccluded + stats->clusters_occluded;
    stats->triangles_in_frustum = stats->triangles_unoccluded + stats->triangles_occluded;
    count_nodes(pass->draws, renderer->marks.data, stats);
    stats->instances_drawn = count_instances(pass->draws, renderer->marks.data);
    stats->threads = renderer->threads;
    stats->tiles = (int32_t)e3d_tile_count(pass->view);
    stats->backend = renderer->backend;
    stats->plan = pass->plan;
}
