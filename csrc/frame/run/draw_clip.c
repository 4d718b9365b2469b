/* The low-level door with colours: draws a frame of one mesh in clip space, in mode unlit, without a camera. */
#include <math.h>
#include <stdlib.h>

#include "e3d.h"

static e3d_frame unlit_frame(int32_t width, int32_t height, int32_t samples)
{
    e3d_frame frame = {.width = width,
                       .height = height,
                       .samples_axis = 1,
                       .msaa_samples = samples > 1 ? samples : 0,
                       .mode = E3D_MODE_UNLIT,
                       .exposure = 1,
                       .light_clamp = {0, INFINITY},
                       .line_width = 1,
                       .point_size = 1,
                       .depth_far = 1};
    for (int k = 0; k < 4; k++)
        frame.clip_from_world[5 * k] = frame.view_from_world[5 * k] = 1;
    return frame;
}

/* Opaque, blended, and blended with each of the textures. */
static e3d_material *materials_of(const e3d_clip_triangles *drawn)
{
    e3d_material *materials = calloc((size_t)drawn->texture_count + 2, sizeof *materials);
    for (int32_t k = 0; materials && k < drawn->texture_count + 2; k++) {
        materials[k] = (e3d_material){.color = {1, 1, 1}, .alpha = 1, .shininess = 1, .is_unlit = 1};
        materials[k].alpha_mode = k ? E3D_ALPHA_BLEND : E3D_ALPHA_OPAQUE;
        materials[k].texture.texture = k > 1 ? drawn->textures[k - 2] : NULL;
    }
    return materials;
}

static e3d_status draw_mesh(const e3d_mesh *mesh, const e3d_material *materials, int32_t count, e3d_frame *frame,
                            e3d_backend backend, int32_t threads, uint8_t *rgba)
{
    e3d_renderer *renderer = NULL;
    e3d_status status = e3d_renderer_create(backend, threads, &renderer);
    if (status == E3D_OK) {
        e3d_draw draw = {.mesh = mesh, .instances = 1};
        for (int k = 0; k < 4; k++)
            draw.world_from_node[5 * k] = 1;
        frame->draws = &draw;
        frame->draw_count = 1;
        frame->materials = materials;
        frame->material_count = count;
        const e3d_targets targets = {.color = rgba};
        status = e3d_render(renderer, frame, &targets, NULL);
    }
    e3d_renderer_destroy(renderer);
    return status;
}

e3d_status e3d_draw_clip(const e3d_clip_triangles *drawn, int32_t width, int32_t height, int32_t samples,
                         e3d_backend backend, int32_t threads, uint8_t *rgba)
{
    const e3d_mesh_desc desc = {.positions = drawn->clip,
                                .components = 4,
                                .vertices = drawn->vertices,
                                .faces = drawn->faces,
                                .faces_count = drawn->faces_count,
                                .material_ids = drawn->looks,
                                .uvs = drawn->uvs,
                                .colors_u8 = drawn->colors};
    e3d_frame frame = unlit_frame(width, height, samples);
    e3d_mesh *mesh = NULL;
    e3d_material *materials = materials_of(drawn);
    e3d_status status = materials ? e3d_mesh_create(&desc, threads, &mesh) : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK)
        status = draw_mesh(mesh, materials, drawn->texture_count + 2, &frame, backend, threads, rgba);
    e3d_mesh_destroy(mesh);
    free(materials);
    return status;
}
