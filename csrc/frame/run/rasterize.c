/* The low-level door: draws a frame of one mesh in clip space, without camera or shading. */
#include "e3d.h"
#include "frame/run/clip_space.h"

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
    const e3d_targets targets = {
        .face_id = face_id, .ndc_depth = depth, .barycentric = barycentric};
    e3d_frame frame = {.width = width, .height = height, .cull = cull};
    return e3d_draw_in_clip_space(&desc, &material, 1, &frame, &targets, backend, threads);
}
