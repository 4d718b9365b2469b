/* Meshes: their arrays are checked once, and then cut into clusters; the caller keeps owning the arrays. */
#include <stdlib.h>

#include "data/mesh/clusters.h"
#include "base/fpenv.h"
#include "data/mesh/mesh.h"

/* Both index and vertices - 1 - index have a clear sign bit exactly if the index is in range. */
static int indices_fit(const int32_t *indices, size_t count, int32_t vertices)
{
    int32_t signs = 0;
    for (size_t i = 0; i < count; i++)
        signs |= indices[i] | (int32_t)((uint32_t)vertices - 1u - (uint32_t)indices[i]);
    return signs >= 0;
}

/* The greatest material ID; negative if any of them is. */
static int32_t greatest_material(const e3d_mesh_desc *d)
{
    int32_t most = 0, signs = 0;
    for (int32_t f = 0; d->material_ids && f < d->faces_count; f++) {
        signs |= d->material_ids[f];
        most = d->material_ids[f] > most ? d->material_ids[f] : most;
    }
    return signs < 0 ? -1 : most;
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

e3d_status e3d_mesh_create(const e3d_mesh_desc *desc, int32_t threads, e3d_mesh **out)
{
    *out = NULL;
    int32_t material_most = greatest_material(desc);
    if (!desc_is_valid(desc) || material_most < 0)
        return E3D_INVALID_ARGUMENT;
    e3d_mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh)
        return E3D_OUT_OF_MEMORY;
    mesh->desc = *desc;
    mesh->like = mesh;
    mesh->material_most = material_most;
    e3d_fpenv saved = e3d_fpenv_enter();
    int built = e3d_clusters_build(mesh, threads ? threads : e3d_thread_count());
    e3d_fpenv_leave(saved);
    if (!built) {
        e3d_mesh_destroy(mesh);
        return E3D_OUT_OF_MEMORY;
    }
    e3d_mesh_bound(mesh);
    *out = mesh;
    return E3D_OK;
}

e3d_status e3d_mesh_set_edges(e3d_mesh *mesh, const int32_t *edges, int32_t count)
{
    if (count < 0 || (count && !edges) || !indices_fit(edges, 2 * (size_t)count, mesh->desc.vertices))
        return E3D_INVALID_ARGUMENT;
    mesh->desc.edges = edges;
    mesh->desc.edges_count = count;
    return E3D_OK;
}
