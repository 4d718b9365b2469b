/* The low-level door: draws a frame of one mesh in clip space, without camera or shading. */
#include "e3d.h"

static e3d_frame clip_frame(int32_t width, int32_t height, e3d_cull cull)
{
    e3d_frame frame = {.width = width,
                       .height = height,
                       .samples_axis = 1,
                       .cull = cull,
                       .line_width = 1,
                       .point_size = 1,
                       .depth_far = 1};
    for (int k = 0; k < 4; k++)
        frame.clip_from_world[5 * k] = frame.view_from_world[5 * k] = 1;
    return frame;
}

e3d_status e3d_rasterize(const float *clip, int32_t vertices, const int32_t *faces, int32_t faces_count,
                         int32_t width, int32_t height, e3d_cull cull, e3d_backend backend,
                         int32_t threads, int32_t *face_id, float *depth, float *barycentric)
{
    const e3d_mesh_desc desc = {.positions = clip,
                                .components = 4,
                                .vertices = vertices,
                                .faces = faces,
                                .faces_count = faces_count};
    const e3d_material material = {.shininess = 1};
    e3d_renderer *renderer = NULL;
    e3d_mesh *mesh = NULL;
    e3d_status status = e3d_mesh_create(&desc, threads, &mesh);
    if (status == E3D_OK)
        status = e3d_renderer_create(backend, threads, &renderer);
    if (status == E3D_OK) {
        e3d_frame frame = clip_frame(width, height, cull);
        e3d_draw draw = {.mesh = mesh, .instances = 1};
        for (int k = 0; k < 4; k++)
            draw.world_from_node[5 * k] = 1;
        frame.draws = &draw;
        frame.draw_count = 1;
        frame.materials = &material;
        frame.material_count = 1;
        const e3d_targets targets = {
            .face_id = face_id, .ndc_depth = depth, .barycentric = barycentric};
        status = e3d_render(renderer, &frame, &targets, NULL);
    }
    e3d_renderer_destroy(renderer);
    e3d_mesh_destroy(mesh);
    return status;
}
