/* rest: lays out, for posing, what moves the vertices of a mesh, and makes posed meshes.
 * In: a mesh, joints and weights of its vertices, morph targets. Out: for each vertex the joints whose weight is not 0; for
 * each cluster the vertices that it was made from; meshes with memory of their own for what posing writes. */
#include "scene/posing/rest.h"

#include <stdlib.h>
#include <string.h>

enum { INDEX_FLOATS = 3 * E3D_CLUSTER_TRIANGLES / 4,
       PAD = 4 /* positions are read as vectors of four */ };

static int take_influences(e3d_rest *rest)
{
    const e3d_pose_desc *d = &rest->desc;
    size_t vertices = (size_t)rest->mesh->desc.vertices, width = (size_t)d->influences, used = 0;
    if (!width)
        return 1;
    for (size_t i = 0; i < vertices * width; i++)
        used += d->weights[i] != 0;
    rest->starts = malloc((vertices + 1) * sizeof *rest->starts);
    rest->influences = malloc((used + 1) * sizeof *rest->influences);
    if (!rest->starts || !rest->influences)
        return 0;
    used = 0;
    for (size_t v = 0; v < vertices; v++) {
        rest->starts[v] = (uint32_t)used;
        for (size_t i = v * width; i < (v + 1) * width; i++) {
            if (d->weights[i] == 0)
                continue;
            rest->influences[used++] = (e3d_influence){d->weights[i], E3D_JOINT_MATRIX * (int32_t)d->joints[i]};
            rest->joints = d->joints[i] >= rest->joints ? d->joints[i] + 1 : rest->joints;
        }
    }
    rest->starts[vertices] = (uint32_t)used;
    return 1;
}

/* Finds a cluster's vertices in the mesh by the corners of its triangles; padding repeats the first one. */
static void list_members(const e3d_mesh *mesh, const e3d_cluster *c, int32_t *members)
{
    const uint8_t *indices = e3d_cluster_indices(c, 3);
    for (int t = 0; t < c->triangles; t++)
        for (int k = 0; k < 3; k++)
            members[indices[k * E3D_CLUSTER_TRIANGLES + t]] = mesh->desc.faces[3 * (size_t)mesh->faces[c->first + t] + (size_t)k];
    for (int v = c->vertices; v < c->stride; v++)
        members[v] = members[0];
}

static int take_members(e3d_rest *rest)
{
    const e3d_mesh *mesh = rest->mesh;
    size_t total = 0;
    for (int32_t i = 0; i < mesh->cluster_count; i++)
        total += mesh->clusters[i].stride;
    rest->member_starts = malloc(((size_t)mesh->cluster_count + 1) * sizeof *rest->member_starts);
    rest->members = malloc((total + 1) * sizeof *rest->members);
    if (!rest->member_starts || !rest->members)
        return 0;
    rest->cluster_floats = 3 * total + (size_t)mesh->cluster_count * INDEX_FLOATS;
    total = 0;
    for (int32_t i = 0; i < mesh->cluster_count; i++) {
        rest->member_starts[i] = total;
        list_members(mesh, &mesh->clusters[i], rest->members + total);
        total += mesh->clusters[i].stride;
    }
    return 1;
}

e3d_status e3d_rest_create(const e3d_mesh *mesh, const e3d_pose_desc *desc, e3d_rest **out)
{
    *out = NULL;
    if (mesh->desc.components != 3 || desc->influences < 0 || desc->targets < 0 ||
        (desc->influences && (!desc->joints || !desc->weights)) ||
        (size_t)mesh->desc.vertices * (size_t)desc->influences > UINT32_MAX)
        return E3D_INVALID_ARGUMENT;
    e3d_rest *rest = calloc(1, sizeof *rest);
    if (!rest)
        return E3D_OUT_OF_MEMORY;
    rest->mesh = mesh;
    rest->desc = *desc;
    if (!take_influences(rest) || !take_members(rest)) {
        e3d_rest_destroy(rest);
        return E3D_OUT_OF_MEMORY;
    }
    *out = rest;
    return E3D_OK;
}

void e3d_rest_destroy(e3d_rest *rest)
{
    if (!rest)
        return;
    free(rest->starts);
    free(rest->influences);
    free(rest->member_starts);
    free(rest->members);
    free(rest);
}

int32_t e3d_rest_joints(const e3d_rest *rest) { return rest->joints; }

/* ---- a mesh to be posed ---- */

static float *new_floats(size_t count)
{
    void *block;
    if (posix_memalign(&block, 64, (count + PAD) * sizeof(float)))
        return NULL;
    memset(block, 0, (count + PAD) * sizeof(float));
    return block;
}

/* Places the clusters' positions in memory of their own; their indices, which follow, stay the same. */
static void place_clusters(const e3d_mesh *mesh, e3d_mesh *posed, float *data)
{
    memcpy(posed->clusters, mesh->clusters, (size_t)mesh->cluster_count * sizeof *mesh->clusters);
    for (int32_t i = 0; i < mesh->cluster_count; i++) {
        e3d_cluster *c = &posed->clusters[i];
        size_t count = 3 * (size_t)c->stride + INDEX_FLOATS;
        memcpy(data, c->positions, count * sizeof *data);
        c->positions = data;
        data += count;
    }
    memcpy(posed->groups, mesh->groups, (size_t)mesh->group_count * sizeof *mesh->groups);
}

e3d_status e3d_posed_create(const e3d_rest *rest, int face_normals, e3d_mesh **out)
{
    const e3d_mesh *mesh = rest->mesh;
    size_t vertices = (size_t)mesh->desc.vertices, faces = (size_t)mesh->desc.faces_count;
    size_t normals = rest->desc.normals ? 3 * vertices + PAD : 0, tangents = rest->desc.tangents ? 4 * vertices : 0;
    *out = NULL;
    e3d_mesh *posed = calloc(1, sizeof *posed);
    if (!posed)
        return E3D_OUT_OF_MEMORY;
    *posed = *mesh;
    posed->borrows_faces = 1;
    posed->clusters = malloc(((size_t)mesh->cluster_count + 1) * sizeof *posed->clusters);
    posed->groups = malloc(((size_t)mesh->group_count + 1) * sizeof *posed->groups);
    posed->slabs = calloc(2, sizeof *posed->slabs);
    posed->slab_count = 2;
    float *clusters = new_floats(rest->cluster_floats);
    float *own = new_floats(3 * vertices + PAD + normals + tangents + (face_normals ? 3 * faces : 0));
    if (posed->slabs) {
        posed->slabs[0] = clusters;
        posed->slabs[1] = own;
    }
    if (!posed->clusters || !posed->groups || !posed->slabs || !clusters || !own) {
        if (!posed->slabs) {
            free(clusters);
            free(own);
        }
        e3d_mesh_destroy(posed);
        return E3D_OUT_OF_MEMORY;
    }
    if (mesh->cluster_count)
        place_clusters(mesh, posed, clusters);
    posed->desc.positions = own;
    posed->desc.normals = normals ? own + 3 * vertices + PAD : NULL;
    posed->desc.tangents = tangents ? own + 3 * vertices + PAD + normals : NULL;
    posed->desc.face_normals = face_normals ? own + 3 * vertices + PAD + normals + tangents : NULL;
    *out = posed;
    return E3D_OK;
}

const float *e3d_posed_positions(const e3d_mesh *posed) { return posed->desc.positions; }
const float *e3d_posed_normals(const e3d_mesh *posed) { return posed->desc.normals; }
const float *e3d_posed_tangents(const e3d_mesh *posed) { return posed->desc.tangents; }
