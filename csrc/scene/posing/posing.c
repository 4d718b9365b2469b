/* posing: poses many meshes at once on several threads. A small mesh is posed whole by one thread, in its caches. Of a large
 * one, first the vertices are shared out, and then its clusters. */
#include "e3d_posing.h"

#include "base/fpenv.h"
#include "base/pool.h"
#include "scene/posing/rest.h"

enum { SMALL = 16384 /* vertices */,
       VERTICES_A_TASK = 2048,
       CLUSTERS_A_TASK = 64 };

typedef struct sharing {
    e3d_pose_job *jobs;
} sharing;

static float *own(const e3d_mesh *posed, const float *array)
{
    return array ? posed->slabs[1] + (array - posed->slabs[1]) : NULL;
}

static int is_small(const e3d_pose_job *job) { return job->rest->mesh->desc.vertices <= SMALL; }

static void pose_some(const e3d_pose_job *job, int32_t first, int32_t count)
{
    const e3d_mesh_desc *d = &job->out->desc;
    const e3d_posed_arrays out = {own(job->out, d->positions), own(job->out, d->normals), own(job->out, d->tangents)};
    e3d_pose_vertices(job, first, count, &out);
}

static void pose_small(void *argument, int i)
{
    e3d_pose_job *job = &((sharing *)argument)->jobs[i];
    if (!is_small(job))
        return;
    pose_some(job, 0, job->rest->mesh->desc.vertices);
    e3d_refit_clusters(job->rest, job->out, 0, job->out->cluster_count);
    e3d_refit_mesh(job->out, job->box);
}

static void pose_part(void *argument, int part)
{
    const e3d_pose_job *job = argument;
    int32_t first = VERTICES_A_TASK * part, left = job->rest->mesh->desc.vertices - first;
    pose_some(job, first, left < VERTICES_A_TASK ? left : VERTICES_A_TASK);
}

static void refit_part(void *argument, int part)
{
    const e3d_pose_job *job = argument;
    int32_t first = CLUSTERS_A_TASK * part, left = job->out->cluster_count - first;
    e3d_refit_clusters(job->rest, job->out, first, left < CLUSTERS_A_TASK ? left : CLUSTERS_A_TASK);
}

static int32_t parts_of(int32_t count, int32_t size) { return (count + size - 1) / size; }

void e3d_pose_meshes(e3d_pose_job *jobs, int32_t count, int threads)
{
    sharing all = {jobs};
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_pool_share(threads, count, pose_small, &all);
    for (int32_t i = 0; i < count; i++) {
        if (is_small(&jobs[i]))
            continue;
        e3d_pool_share(threads, parts_of(jobs[i].rest->mesh->desc.vertices, VERTICES_A_TASK), pose_part, &jobs[i]);
        e3d_pool_share(threads, parts_of(jobs[i].out->cluster_count, CLUSTERS_A_TASK), refit_part, &jobs[i]);
        e3d_refit_mesh(jobs[i].out, jobs[i].box);
    }
    e3d_fpenv_leave(saved);
}
