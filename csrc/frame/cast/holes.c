/* cast: the alpha of a caster where a ray hits it (R80, R101), by level 0 of its texture. */
#include "frame/cast/holes.h"

#include <math.h>

#include "base/limits.h"
#include "data/mesh/mesh.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/cast/faces.h"

/* R29 */
static float wrapped(float s, e3d_wrap wrap)
{
    if (wrap == E3D_REPEAT) {
        float f = s - floorf(s);
        return f > 0.0f ? f : 0.0f;
    }
    s = s > -0x1p22f ? s : -0x1p22f;
    s = s < 0x1p22f ? s : 0x1p22f;
    if (wrap == E3D_CLAMP) {
        s = s > 0.0f ? s : 0.0f;
        return s < 1.0f ? s : 1.0f;
    }
    float h = s * 0.5f, m = (h - floorf(h)) * 2.0f;
    return m > 1.0f ? 2.0f - m : m;
}

/* A level has a border, and where the texture repeats, that is the opposite side. So the neighbours of any column are column and
 * column + 1, from -1 on. */
static int32_t texel_alpha(const e3d_texture_view *view, int32_t column, int32_t row)
{
    const e3d_level *level = &view->levels[0];
    size_t at = 4 * ((size_t)(row + 1) * (size_t)(level->width + 2) + (size_t)(column + 1)) + 3;
    return view->channel_bits == 8 ? ((const int8_t *)level->texels)[at] + 128 : ((const int16_t *)level->texels)[at];
}

static int32_t below(float s, int32_t size)
{
    int32_t i = (int32_t)(s * (float)size);
    return i < size ? i : size - 1;
}

/* R30: the fourth channel, nearest or bilinear; and its unit. */
static float sampled(const e3d_texture_view *view, float s, float t)
{
    int32_t width = view->levels[0].width, height = view->levels[0].height;
    if (view->filter == E3D_NEAREST)
        return (float)texel_alpha(view, below(s, width), below(t, height));
    int32_t px = (int32_t)lrintf(s * (float)(256 * width)) - 128, py = (int32_t)lrintf(t * (float)(256 * height)) - 128;
    int32_t x = px >> 8, y = py >> 8, fx = px & 255, fy = py & 255;
    int32_t t00 = texel_alpha(view, x, y), t01 = texel_alpha(view, x + 1, y);
    int32_t t10 = texel_alpha(view, x, y + 1), t11 = texel_alpha(view, x + 1, y + 1);
    if (view->channel_bits == 8) {
        int32_t upper = t00 * (255 - fx) + t01 * fx, lower = t10 * (255 - fx) + t11 * fx;
        return (float)(upper * (255 - fy) + lower * fy);
    }
    int32_t left = t00 + (((t10 - t00) * fy + 128) >> 8), right = t01 + (((t11 - t01) * fy + 128) >> 8);
    return (float)(left * (256 - fx) + right * fx);
}

static float between(const float weight[3], float a, float b, float c) { return (weight[0] * a + weight[1] * b) + weight[2] * c; }

/* R45: one coordinate of the texture at the hit, interpolated between the corners. */
static float coordinate(const e3d_texture_use *use, const float *uvs, const int32_t *face, const float weight[3], int axis)
{
    float corner[3];
    const float *m = use->matrix + 3 * axis;
    for (int k = 0; k < 3; k++) {
        const float *uv = uvs + 2 * (size_t)face[k];
        corner[k] = use->is_moved ? (m[0] * uv[0] + m[1] * uv[1]) + m[2] : uv[axis];
    }
    return between(weight, corner[0], corner[1], corner[2]);
}

static float color_alpha(const uint8_t *u8, const float *f32, size_t index)
{
    return f32 ? f32[4 * index + 3] : (float)(u8[4 * index + 3] * 257) * E3D_UNORM16;
}

static float texture_alpha(const e3d_material *m, const e3d_mesh_desc *mesh, const int32_t *face, const float weight[3])
{
    const float *uvs = m->texture.uv_set ? mesh->uvs1 : mesh->uvs;
    if (!m->texture.texture || !uvs)
        return m->alpha;
    const e3d_texture_view *view = e3d_texture_get_view(m->texture.texture);
    float s = wrapped(coordinate(&m->texture, uvs, face, weight, 0), view->wrap[0]);
    float t = wrapped(1.0f - coordinate(&m->texture, uvs, face, weight, 1), view->wrap[1]);
    return sampled(view, s, t) * (m->alpha * e3d_texture_unit(view));
}

int e3d_caster_is_open(const e3d_caster_index *index, uint32_t caster, const float weight[3])
{
    const e3d_caster_faces *faces = index->source;
    const e3d_caster_instance *instance = e3d_caster_instance_of(faces, caster);
    const e3d_draw *draw = &faces->casters.draws[instance->draw];
    const e3d_mesh_desc *mesh = &draw->mesh->desc;
    size_t f = (size_t)((int64_t)caster - instance->first);
    const int32_t *face = mesh->faces + 3 * f;
    const e3d_material *m = &faces->casters.materials[draw->material_base + (mesh->material_ids ? mesh->material_ids[f] : 0)];
    float alpha = texture_alpha(m, mesh, face, weight);
    if (mesh->colors_u8 || mesh->colors_f32) {
        float corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = color_alpha(mesh->colors_u8, mesh->colors_f32, (size_t)face[k]);
        alpha = alpha * between(weight, corner[0], corner[1], corner[2]);
    }
    if (draw->instance_colors_u8 || draw->instance_colors_f32)
        alpha = alpha * color_alpha(draw->instance_colors_u8, draw->instance_colors_f32, (size_t)instance->number);
    alpha = alpha > 0.0f ? alpha : 0.0f;
    alpha = alpha < 1.0f ? alpha : 1.0f;
    return !(alpha >= (m->alpha_mode == E3D_ALPHA_MASK ? m->alpha_cutoff : E3D_BLENDED_CASTER));
}
