/* One mesh in clip space: a frame whose matrices change nothing, drawn by a renderer of its own. */
#include "frame/run/clip_space.h"

static void fill_frame(e3d_frame *frame, const e3d_draw *draw, const e3d_material *materials, int32_t material_count)
{
    frame->samples_axis = 1;
    frame->line_width = 1;
    frame->point_size = 1;
    frame->depth_far = 1;
    for (int k = 0; k < 4; k++)
        frame->clip_from_world[5 * k] = frame->view_from_world[5 * k] = 1;
    frame->draws = draw;
    frame->draw_count = 1;
    frame->materials = materials;
    frame->material_count = material_count;
}

e3d_status e3d_draw_in_clip_space(const e3d_mesh_desc *desc, const e3d_material *materials, int32_t material_count, e3d_frame *frame,
                                  const e3d_targets *targets, e3d_backend backend, int32_t threads)
{
    e3d_renderer *renderer = NULL;
    e3d_mesh *mesh = NULL;
    e3d_status status = e3d_mesh_create(desc, threads, &mesh);
    if (status == E3D_OK)
        status = e3d_renderer_create(backend, threads, &renderer);
    if (status == E3D_OK) {
        e3d_draw draw = {.mesh = mesh, .instances = 1};
        for (int k = 0; k < 4; k++)
            draw.world_from_node[5 * k] = 1;
        fill_frame(frame, &draw, materials, material_count);
        status = e3d_render(renderer, frame, targets, NULL);
    }
    e3d_renderer_destroy(renderer);
    e3d_mesh_destroy(mesh);
    return status;
}
