/* A mesh's box, and the parts of a mesh that may change: its vertices' attributes. */
#include "data/mesh/mesh.h"

#include <stdlib.h>

#include "data/bounds.h"

void e3d_mesh_bound(e3d_mesh *mesh)
{
    const e3d_mesh_desc *d = &mesh->desc;
    mesh->any_finite = 0;
    for (int32_t c = 0; c < mesh->cluster_count; c++)
        if (mesh->clusters[c].any_finite) {
            e3d_grow_bounds(mesh->clusters[c].lo, mesh->lo, mesh->hi, &mesh->any_finite);
            e3d_grow_bounds(mesh->clusters[c].hi, mesh->lo, mesh->hi, &mesh->any_finite);
        }
    for (size_t i = 0; i < 2 * (size_t)d->lines_count; i++)
        e3d_grow_bounds(d->positions + (size_t)d->lines[i] * d->components, mesh->lo, mesh->hi,
                        &mesh->any_finite);
    for (int32_t i = 0; i < d->points_count; i++)
        e3d_grow_bounds(d->positions + (size_t)d->points[i] * d->components, mesh->lo, mesh->hi,
                        &mesh->any_finite);
}

void e3d_mesh_destroy(e3d_mesh *mesh)
{
    if (!mesh)
        return;
    for (int32_t i = 0; mesh->slabs && i < mesh->slab_count; i++)
        free(mesh->slabs[i]);
    free(mesh->slabs);
    free(mesh->clusters);
    free(mesh->groups);
    if (!mesh->borrows_faces)
        free(mesh->faces);
    free(mesh);
}

void e3d_mesh_desc_set(e3d_mesh_desc *desc, e3d_vertex_attribute attribute, const void *array)
{
    switch (attribute) {
#define SET(attribute, name, ...) \
    case attribute: desc->name = array; return;
        E3D_EACH_VERTEX_ATTRIBUTE(SET)
    case E3D_VERTEX_ATTRIBUTES: return;
    }
}

#define FORMAT(attribute, name, type, channels) {#name, channels, sizeof(type), (type)0.5f != 0},
const e3d_array_format E3D_VERTEX_FORMATS[E3D_VERTEX_ATTRIBUTES] = {E3D_EACH_VERTEX_ATTRIBUTE(FORMAT)};

void e3d_mesh_set_attribute(e3d_mesh *mesh, e3d_vertex_attribute attribute, const void *array)
{
    e3d_mesh_desc_set(&mesh->desc, attribute, array);
}

void e3d_mesh_set_face_normals(e3d_mesh *mesh, const float *face_normals)
{
    mesh->desc.face_normals = face_normals;
}

const e3d_mesh_desc *e3d_mesh_view(const e3d_mesh *mesh) { return &mesh->desc; }
