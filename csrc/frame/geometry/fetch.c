/* geometry: prefetches, since the data of clusters and instances may lie anywhere in memory. */
#include <stddef.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "frame/geometry/fetch.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

enum { LINE = 64 };

/* Prefetches a cluster's positions and indices, which follow each other. */
static ALWAYS_INLINE void fetch_cluster(const e3d_cluster *c, int32_t components)
{
    const char *from = (const char *)c->positions, *end = (const char *)e3d_cluster_indices(c, components) + 3 * E3D_CLUSTER_TRIANGLES;
    for (; from < end; from += LINE)
        __builtin_prefetch(from);
}

void e3d_fetch_next(const e3d_mesh *mesh, const e3d_cluster *clusters, unsigned left, e3d_next_clusters *next)
{
    if (left) {
        fetch_cluster(&clusters[__builtin_ctz(left)], mesh->desc.components);
    } else if (next->left) {
        fetch_cluster(&next->clusters[__builtin_ctz(next->left)], 3);
        next->left &= next->left - 1;
    }
}

/* Which clusters of a candidate showed when they were last tested; other threads may write it at the same time. */
static unsigned seen_of(const e3d_geometry_out *out, const e3d_candidate *candidate)
{
    return __atomic_load_n(&out->seen[candidate->number], __ATOMIC_RELAXED);
}

void e3d_fetch_instance(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate)
{
    const char *instance = (const char *)&in->pass->view->instances[candidate->instance];
    if (in->round.choice == E3D_ALL_CANDIDATES || seen_of(out, candidate))
        for (size_t at = 0; at < sizeof(e3d_view_instance); at += LINE)
            __builtin_prefetch(instance + at);
}

void e3d_fetch_seen(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate)
{
    if (in->round.choice != E3D_ALL_CANDIDATES)
        __builtin_prefetch(&out->seen[candidate->number]);
}

e3d_next_clusters e3d_find_next(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate)
{
    const e3d_mesh *mesh = in->pass->draws->states[candidate->draw].mesh;
    size_t first = (size_t)candidate->group * E3D_GROUP_CLUSTERS, count = (size_t)mesh->cluster_count;
    unsigned may = in->round.choice == E3D_ALL_CANDIDATES ? ~0u : 0;
    if (in->round.choice == E3D_SEEN_CANDIDATES)
        may = seen_of(out, candidate);
    e3d_next_clusters next = {&mesh->clusters[first], 0};
    if (mesh->desc.components != 3 || count <= E3D_GROUP_CLUSTERS)
        return next;
    for (size_t k = 0; k < E3D_GROUP_CLUSTERS && first + k < count; k++) {
        __builtin_prefetch(&next.clusters[k]);
        if (may >> k & 1 && !(next.left & (next.left - 1)))
            next.left |= 1u << k;
    }
    return next;
}
