/* Geometry: takes draws, instances and primitives in the order of R16 through transform, clip and setup.
 * In: the frame's draws. Out: the scene's pieces, and the instances that they refer to.
 * Rules: R7 (fans), R16 (order), R24 (materials), R36 (edges).
 * An instance without pieces is forgotten, so that memory grows only with what may be seen. */
#include <stdlib.h>

#include "reference/stages.h"

static ref_corner fetch_corner(const ref_instance *instance, int32_t vertex, int which)
{
    ref_corner corner = {.barycentric = {0.0f, 0.0f, 0.0f}};
    ref_transform_clip(instance, vertex, corner.position);
    corner.barycentric[which] = 1.0f;
    return corner;
}

static e3d_status build_face(ref_scene *scene, const ref_primitive *primitive, const ref_corner corners[3])
{
    ref_corner polygon[REF_MAX_CORNERS];
    scene->stats.triangles++;
    switch (ref_test_primitive(scene, REF_FACE, corners)) {
    case REF_REJECTED:
        return E3D_OK;
    case REF_ACCEPTED:
        return ref_setup_triangle(scene, primitive, corners, 0);
    case REF_NEEDS_CLIPPING:
        break;
    }
    scene->stats.triangles_clipped++;
    int count = ref_clip_triangle(scene, corners, polygon);
    e3d_status status = E3D_OK;
    for (int i = 1; i + 1 < count && status == E3D_OK; i++) {
        ref_corner fan[3] = {polygon[0], polygon[i], polygon[i + 1]};
        status = ref_setup_triangle(scene, primitive, fan, 1);
    }
    return status;
}

static e3d_status build_line(ref_scene *scene, const ref_primitive *primitive, const ref_corner ends[2])
{
    ref_corner cut[2];
    switch (ref_test_primitive(scene, primitive->kind, ends)) {
    case REF_REJECTED:
        return E3D_OK;
    case REF_ACCEPTED:
        return ref_setup_line(scene, primitive, ends, 0);
    case REF_NEEDS_CLIPPING:
        break;
    }
    return ref_clip_line(scene, ends, cut) == 2 ? ref_setup_line(scene, primitive, cut, 1) : E3D_OK;
}

static e3d_status build_point(ref_scene *scene, const ref_primitive *primitive, const ref_corner *corner)
{
    if (ref_test_primitive(scene, REF_POINT, corner) != REF_ACCEPTED)
        return E3D_OK;
    return ref_setup_point(scene, primitive, corner);
}

/* Fills in the rest of a primitive whose kind, index and instance are known; returns its corners. */
static e3d_status describe(const ref_scene *scene, ref_primitive *primitive, ref_corner corners[3])
{
    const ref_instance *instance = &scene->instances[primitive->instance];
    const e3d_mesh_desc *mesh = instance->mesh;
    size_t index = (size_t)primitive->index;
    const int32_t *vertices = NULL;
    int count = 0;
    int64_t material = instance->draw->material_base;
    switch (primitive->kind) {
    case REF_FACE:
        vertices = mesh->faces + 3 * index, count = 3;
        primitive->local = (uint32_t)index;
        material += mesh->material_ids ? mesh->material_ids[index] : 0;
        break;
    case REF_LINE:
        vertices = mesh->lines + 2 * index, count = 2;
        primitive->local = (uint32_t)mesh->faces_count + (uint32_t)index;
        break;
    case REF_POINT:
        vertices = mesh->points + index, count = 1;
        primitive->local = (uint32_t)mesh->faces_count + (uint32_t)mesh->lines_count + (uint32_t)index;
        break;
    case REF_EDGE:
        vertices = mesh->edges + 2 * index, count = 2;
        break;
    }
    if (primitive->kind != REF_EDGE && (material < 0 || material >= scene->frame->material_count))
        return E3D_INVALID_ARGUMENT;
    primitive->material = primitive->kind == REF_EDGE ? NULL : &scene->frame->materials[material];
    for (int k = 0; k < 3; k++)
        primitive->vertices[k] = k < count ? vertices[k] : -1;
    for (int k = 0; k < count; k++)
        corners[k] = fetch_corner(instance, vertices[k], k);
    return E3D_OK;
}

static e3d_status build_primitives(ref_scene *scene, ref_kind kind, int32_t count)
{
    e3d_status status = E3D_OK;
    for (int32_t index = 0; index < count && status == E3D_OK; index++) {
        ref_primitive primitive = {.kind = kind, .index = index, .instance = scene->instance_count - 1};
        ref_corner corners[3];
        status = describe(scene, &primitive, corners);
        if (status != E3D_OK)
            return status;
        if (kind == REF_FACE)
            status = build_face(scene, &primitive, corners);
        else if (kind == REF_POINT)
            status = build_point(scene, &primitive, corners);
        else
            status = build_line(scene, &primitive, corners);
    }
    return status;
}

static e3d_status push_instance(ref_scene *scene, const e3d_draw *draw, int32_t number)
{
    if (scene->instance_count == scene->instance_capacity) {
        int64_t capacity = scene->instance_capacity ? 2 * scene->instance_capacity : 16;
        ref_instance *instances = realloc(scene->instances, (size_t)capacity * sizeof *instances);
        if (!instances)
            return E3D_OUT_OF_MEMORY;
        scene->instances = instances;
        scene->instance_capacity = capacity;
    }
    ref_instance_init(&scene->instances[scene->instance_count++], scene->frame, draw, number);
    return E3D_OK;
}

static e3d_status build_instance(ref_scene *scene, const e3d_draw *draw, int32_t number, int with_edges)
{
    e3d_status status = push_instance(scene, draw, number);
    if (status != E3D_OK)
        return status;
    const e3d_mesh_desc *mesh = e3d_mesh_view(draw->mesh);
    int64_t before = scene->pieces.count + scene->edges.count;
    status = build_primitives(scene, REF_FACE, mesh->faces_count);
    if (status == E3D_OK && !scene->frame->faces_only)
        status = build_primitives(scene, REF_LINE, mesh->lines_count);
    if (status == E3D_OK && !scene->frame->faces_only)
        status = build_primitives(scene, REF_POINT, mesh->points_count);
    if (status == E3D_OK && with_edges)
        status = build_primitives(scene, REF_EDGE, mesh->edges_count);
    if (scene->pieces.count + scene->edges.count == before)
        scene->instance_count--;
    scene->stats.instances++;
    return status;
}

static int32_t instances_of(const e3d_draw *draw)
{
    return draw->pose_kind == E3D_POSE_NONE ? 1 : draw->instances;
}

/* Draws all instances of a draw, or the next one if they are nodes. */
static e3d_status take_turn(ref_scene *scene, const e3d_draw *draw, int32_t *done, int with_edges)
{
    e3d_status status = E3D_OK;
    int32_t end = *done + (draw->pose_kind == E3D_POSE_NODES ? 1 : instances_of(draw));
    if (end > instances_of(draw))
        return E3D_INVALID_ARGUMENT;
    for (; *done < end && status == E3D_OK; ++*done)
        status = build_instance(scene, draw, *done, with_edges);
    return status;
}

e3d_status ref_build_geometry(ref_scene *scene, int with_edges)
{
    const e3d_frame *frame = scene->frame;
    e3d_status status = E3D_OK;
    int32_t *done = calloc((size_t)frame->draw_count + 1, sizeof *done); /* how many nodes of each draw are done */
    int32_t turns = frame->order ? frame->order_count : frame->draw_count;
    if (!done)
        return E3D_OUT_OF_MEMORY;
    for (int32_t turn = 0; turn < turns && status == E3D_OK; turn++) {
        int32_t d = frame->order ? frame->order[turn] : turn;
        if (d < 0 || d >= frame->draw_count)
            status = E3D_INVALID_ARGUMENT;
        else
            status = take_turn(scene, &frame->draws[d], &done[d], with_edges);
    }
    for (int32_t d = 0; d < frame->draw_count && status == E3D_OK; d++)
        if (done[d] != instances_of(&frame->draws[d]))
            status = E3D_INVALID_ARGUMENT;
    free(done);
    scene->stats.draws = frame->draw_count;
    return status;
}
