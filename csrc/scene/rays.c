/* rays: many rays at once, shared among threads. Each ray is cast as if it were alone (ray.c), so that neither the number of
 * threads nor the other rays change what it meets.
 * In: rays, and for each what it lacks: 0 or more, not cast yet. Out: what they meet; -1 for each ray that is done, else the
 * number of an object whose shape is missing. */
#include <string.h>

#include "base/pool.h"
#include "e3d_scene.h"

enum { RAYS_A_TASK = 256 };

typedef struct rays_job {
    const e3d_graph *graph;
    const e3d_tree *tree;
    const e3d_shape *shapes;
    int32_t shape_count;
    const e3d_rays *rays;
} rays_job;

static void write_hit(const e3d_hit *hit, int32_t *ids, double *values)
{
    ids[0] = hit->slot;
    ids[1] = hit->instance;
    ids[2] = hit->face;
    values[0] = hit->distance;
    memcpy(values + 1, hit->position, sizeof hit->position);
    memcpy(values + 4, hit->normal, sizeof hit->normal);
    memcpy(values + 7, hit->barycentric, sizeof hit->barycentric);
}

static void cast_some(void *argument, int task)
{
    const rays_job *job = argument;
    const e3d_rays *rays = job->rays;
    int32_t first = RAYS_A_TASK * task, end = rays->count - first < RAYS_A_TASK ? rays->count : first + RAYS_A_TASK;
    for (int32_t i = first; i < end; i++) {
        const double *origin = rays->origins + 3 * (size_t)i, *direction = rays->directions + 3 * (size_t)i;
        e3d_hit hit;
        if (rays->lacks[i] < 0)
            continue;
        rays->lacks[i] = e3d_graph_ray(job->graph, job->tree, job->shapes, job->shape_count, origin, direction, rays->farthest,
                                       rays->cull, &hit);
        if (rays->lacks[i] < 0)
            write_hit(&hit, rays->ids + 3 * (size_t)i, rays->values + 10 * (size_t)i);
    }
}

int e3d_graph_rays(const e3d_graph *graph, const e3d_tree *tree, const e3d_shape *shapes, int32_t shape_count,
                   const e3d_rays *rays, int threads)
{
    rays_job job = {graph, tree, shapes, shape_count, rays};
    e3d_pool_share(threads, (rays->count + RAYS_A_TASK - 1) / RAYS_A_TASK, cast_some, &job);
    for (int32_t i = 0; i < rays->count; i++)
        if (rays->lacks[i] >= 0)
            return 0;
    return 1;
}
