/* The low-level door with colours: draws a frame of one mesh in clip space, in mode unlit, without a camera. */
#include <math.h>
#include <stdlib.h>

#include "e3d.h"
#include "frame/run/clip_space.h"

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
    e3d_frame frame = {.width = width,
                       .height = height,
                       .msaa_samples = samples > 1 ? samples : 0,
                       .mode = E3D_MODE_UNLIT,
                       .exposure = 1,
                       .light_clamp = {0, INFINITY}};
    const e3d_targets targets = {.color = rgba};
    e3d_material *materials = materials_of(drawn);
    e3d_status status = E3D_OUT_OF_MEMORY;
    if (materials)
        status = e3d_draw_in_clip_space(&desc, materials, drawn->texture_count + 2, &frame, &targets, backend, threads);
    free(materials);
    return status;
}
