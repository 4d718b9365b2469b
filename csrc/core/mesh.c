/* Meshes: arrays are checked once, then cut into clusters in the order of the faces.
 *
 * A cluster's positions are contiguous structure-of-arrays, so that transforming them is a straight
 * run and nothing outside a cache line's neighbourhood is touched. Padding repeats vertex 0.
 */
#include "core/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct builder {
    e3d_mesh *mesh;
    int32_t *local;     /* per mesh vertex: local index in the cluster being built, or -1 */
    int32_t *members;   /* mesh vertices of that cluster */
    e3d_cluster *now;
    uint8_t *indices;
} builder;

static int indices_fit(const int32_t *indices, size_t count, int32_t vertices)
{
    for (size_t i = 0; i < count; i++)
        if (indices[i] < 0 || indices[i] >= vertices)
            return 0;
    return 1;
}

/* -1 if one is negative. */
static int32_t greatest_material(const e3d_mesh_desc *d)
{
    int32_t most = 0;
    for (int32_t f = 0; d->material_ids && f < d->faces_count; f++) {
        if (d->material_ids[f] < 0)
            return -1;
        most = d->material_ids[f] > most ? d->material_ids[f] : most;
    }
    return most;
}

static int desc_is_valid(const e3d_mesh_desc *d)
{
    if (d->vertices < 0 || d->faces_count < 0 || d->lines_count < 0 || d->points_count < 0 ||
        d->edges_count < 0 || (d->components != 3 && d->components != 4))
        return 0;
    if ((d->vertices && !d->positions) || (d->faces_count && !d->faces) ||
        (d->lines_count && !d->lines) || (d->points_count && !d->points) ||
        (d->edges_count && !d->edges) || (d->colors_u8 && d->colors_f32))
        return 0;
    return indices_fit(d->faces, 3 * (size_t)d->faces_count, d->vertices) &&
           indices_fit(d->lines, 2 * (size_t)d->lines_count, d->vertices) &&
           indices_fit(d->points, (size_t)d->points_count, d->vertices) &&
           indices_fit(d->edges, 2 * (size_t)d->edges_count, d->vertices);
}

static void grow_bounds(const float *p, float lo[3], float hi[3], int32_t *any)
{
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
        return;
    for (int k = 0; k < 3; k++) {
        lo[k] = *any && lo[k] < p[k] ? lo[k] : p[k];
        hi[k] = *any && hi[k] > p[k] ? hi[k] : p[k];
    }
    *any = 1;
}

static void open_cluster(builder *b, e3d_cluster *cluster, int32_t face, size_t positions,
                         size_t indices)
{
    memset(cluster, 0, sizeof *cluster);
    cluster->first = face;
    cluster->positions = positions;
    cluster->indices = indices;
    b->now = cluster;
}

/* Copies the members' positions, plane by plane, and forgets the local indices. */
static void close_cluster(builder *b)
{
    e3d_cluster *c = b->now;
    const e3d_mesh_desc *d = &b->mesh->desc;
    c->stride = (c->vertices + 15) & ~15;
    float *out = b->mesh->positions + c->positions;
    for (int32_t v = 0; v < c->stride; v++) {
        const float *p = d->positions + (size_t)b->members[v < c->vertices ? v : 0] * d->components;
        for (int k = 0; k < d->components; k++)
            out[k * c->stride + v] = p[k];
        if (v < c->vertices)
            grow_bounds(p, c->lo, c->hi, &c->any_finite);
    }
    for (int32_t v = 0; v < c->vertices; v++)
        b->local[b->members[v]] = -1;
}

static int new_vertices(const builder *b, const int32_t *face)
{
    int fresh = 0;
    for (int k = 0; k < 3; k++)
        fresh += b->local[face[k]] < 0;
    return fresh;
}

static void add_face(builder *b, const int32_t *face)
{
    e3d_cluster *c = b->now;
    for (int k = 0; k < 3; k++) {
        int32_t v = face[k];
        if (b->local[v] < 0) {
            b->members[c->vertices] = v;
            b->local[v] = c->vertices++;
        }
        b->indices[c->indices + (size_t)k * E3D_CLUSTER_TRIANGLES + c->triangles] =
            (uint8_t)b->local[v];
    }
    c->triangles++;
}

/* Clusters hold at least 42 triangles (128 / 3) except the last, so this bounds their number. */
static size_t cluster_bound(int32_t faces) { return (size_t)faces / 42 + 1; }

static void build_clusters(builder *b)
{
    e3d_mesh *mesh = b->mesh;
    size_t positions = 0, indices = 0;
    int32_t count = 0;
    for (int32_t f = 0; f < mesh->desc.faces_count; f++) {
        const int32_t *face = mesh->desc.faces + 3 * (size_t)f;
        if (!b->now || b->now->triangles == E3D_CLUSTER_TRIANGLES ||
            b->now->vertices + new_vertices(b, face) > E3D_CLUSTER_VERTICES) {
            if (b->now) {
                close_cluster(b);
                positions += (size_t)b->now->stride * mesh->desc.components;
                indices += 3 * E3D_CLUSTER_TRIANGLES;
            }
            open_cluster(b, &mesh->clusters[count++], f, positions, indices);
        }
        add_face(b, face);
    }
    if (b->now)
        close_cluster(b);
    mesh->cluster_count = count;
}

/* An upper bound of the padded positions: 3 vertices a triangle, and 15 of padding a cluster. */
static size_t positions_bound(const e3d_mesh_desc *d)
{
    size_t vertices = 3 * (size_t)d->faces_count + 16 * cluster_bound(d->faces_count);
    return vertices * d->components;
}

static int allocate(builder *b)
{
    e3d_mesh *mesh = b->mesh;
    size_t clusters = cluster_bound(mesh->desc.faces_count);
    mesh->clusters = malloc(clusters * sizeof *mesh->clusters);
    mesh->groups = malloc((clusters / E3D_GROUP_CLUSTERS + 1) * sizeof *mesh->groups);
    mesh->positions = malloc(positions_bound(&mesh->desc) * sizeof(float));
    mesh->faces = malloc(((size_t)mesh->desc.faces_count + E3D_CLUSTER_TRIANGLES) * sizeof *mesh->faces);
    mesh->indices = calloc(clusters, 3 * E3D_CLUSTER_TRIANGLES);
    b->indices = mesh->indices;
    b->local = malloc(((size_t)mesh->desc.vertices + 1) * sizeof *b->local);
    b->members = malloc(E3D_CLUSTER_VERTICES * sizeof *b->members);
    if (!mesh->clusters || !mesh->groups || !mesh->positions || !mesh->indices || !mesh->faces || !b->local || !b->members)
        return 0;
    for (int32_t f = 0; f < mesh->desc.faces_count; f++)
        mesh->faces[f] = f;
    memset(mesh->faces + mesh->desc.faces_count, 0, E3D_CLUSTER_TRIANGLES * sizeof *mesh->faces);
    memset(b->local, 0xFF, ((size_t)mesh->desc.vertices + 1) * sizeof *b->local);
    return 1;
}

static void shrink(e3d_mesh *mesh)
{
    size_t used = 0;
    if (mesh->cluster_count) {
        const e3d_cluster *last = &mesh->clusters[mesh->cluster_count - 1];
        used = last->positions + (size_t)last->stride * mesh->desc.components;
    }
    float *positions = realloc(mesh->positions, (used + 1) * sizeof(float));
    if (positions)
        mesh->positions = positions;
}

static void group_clusters(e3d_mesh *mesh)
{
    for (int32_t c = 0; c < mesh->cluster_count; c++) {
        e3d_group_box *group = &mesh->groups[c / E3D_GROUP_CLUSTERS];
        const e3d_cluster *cluster = &mesh->clusters[c];
        if (c % E3D_GROUP_CLUSTERS == 0)
            *group = (e3d_group_box){.first_cluster = c};
        group->clusters++;
        group->triangles += cluster->triangles;
        if (cluster->any_finite) {
            grow_bounds(cluster->lo, group->lo, group->hi, &group->any_finite);
            grow_bounds(cluster->hi, group->lo, group->hi, &group->any_finite);
        }
    }
    mesh->group_count = (mesh->cluster_count + E3D_GROUP_CLUSTERS - 1) / E3D_GROUP_CLUSTERS;
}

static void bound_mesh(e3d_mesh *mesh)
{
    const e3d_mesh_desc *d = &mesh->desc;
    for (int32_t c = 0; c < mesh->cluster_count; c++)
        if (mesh->clusters[c].any_finite) {
            grow_bounds(mesh->clusters[c].lo, mesh->lo, mesh->hi, &mesh->any_finite);
            grow_bounds(mesh->clusters[c].hi, mesh->lo, mesh->hi, &mesh->any_finite);
        }
    for (size_t i = 0; i < 2 * (size_t)d->lines_count; i++)
        grow_bounds(d->positions + (size_t)d->lines[i] * d->components, mesh->lo, mesh->hi,
                    &mesh->any_finite);
    for (int32_t i = 0; i < d->points_count; i++)
        grow_bounds(d->positions + (size_t)d->points[i] * d->components, mesh->lo, mesh->hi,
                    &mesh->any_finite);
}

e3d_status e3d_mesh_create(const e3d_mesh_desc *desc, e3d_mesh **out)
{
    *out = NULL;
    int32_t material_most = greatest_material(desc);
    if (!desc_is_valid(desc) || material_most < 0)
        return E3D_INVALID_ARGUMENT;
    e3d_mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh)
        return E3D_OUT_OF_MEMORY;
    mesh->desc = *desc;
    mesh->material_most = material_most;
    builder b = {.mesh = mesh};
    int enough = allocate(&b);
    if (enough) {
        build_clusters(&b);
        shrink(mesh);
        group_clusters(mesh);
        bound_mesh(mesh);
    }
    free(b.local);
    free(b.members);
    if (!enough) {
        e3d_mesh_destroy(mesh);
        return E3D_OUT_OF_MEMORY;
    }
    *out = mesh;
    return E3D_OK;
}

void e3d_mesh_destroy(e3d_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->clusters);
    free(mesh->groups);
    free(mesh->positions);
    free(mesh->indices);
    free(mesh->faces);
    free(mesh);
}

void e3d_mesh_set_normals(e3d_mesh *mesh, const float *normals) { mesh->desc.normals = normals; }

void e3d_mesh_set_face_normals(e3d_mesh *mesh, const float *face_normals)
{
    mesh->desc.face_normals = face_normals;
}

e3d_status e3d_mesh_set_edges(e3d_mesh *mesh, const int32_t *edges, int32_t count)
{
    if (count < 0 || (count && !edges) || !indices_fit(edges, 2 * (size_t)count, mesh->desc.vertices))
        return E3D_INVALID_ARGUMENT;
    mesh->desc.edges = edges;
    mesh->desc.edges_count = count;
    return E3D_OK;
}

const e3d_mesh_desc *e3d_mesh_view(const e3d_mesh *mesh) { return &mesh->desc; }
