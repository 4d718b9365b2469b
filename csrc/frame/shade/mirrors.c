/* mirrors: finds what the mirrors' pictures show at the samples of a batch, and lays it over their light (R210-R212, R272). */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"
#include "frame/shade/mirrors.h"
#include "frame/shade/texture_slots.h"

int e3d_may_mirror(const e3d_prepared *pass, const e3d_material *material)
{
    return e3d_plans(pass, E3D_PLAN_REFLECTS) && material->mirror > 0.0f;
}

static int holds_face(const e3d_mirror *mirror, const e3d_surfaces *s, int32_t n)
{
    const float *plane = mirror->plane;
    for (int v = 0; v < 3; v++) {
        float x = s->position[0][v][n], y = s->position[1][v][n], z = s->position[2][v][n];
        float height = ((plane[0] * x + plane[1] * y) + plane[2] * z) - plane[3];
        if (!(fabsf(height) <= mirror->slack))
            return 0;
    }
    return 1;
}

/* R210: the mirror of a surface, or NULL. */
static const e3d_mirror *mirror_of(const e3d_frame *frame, const e3d_surfaces *s, int32_t n)
{
    for (int32_t i = 0; i < frame->mirror_count; i++)
        if (holds_face(&frame->mirrors[i], s, n))
            return &frame->mirrors[i];
    return NULL;
}

/* A channel's mean of 2 x 2 pixels. */
static float mean_of_four(const float *pixel, size_t pitch)
{
    return ((pixel[0] + pixel[3]) + (pixel[pitch] + pixel[pitch + 3])) * 0.25f;
}

/* R213, R272 */
static float mean_of(const float *pixel, size_t pitch, int32_t scale)
{
    const float *lower = pixel + 2 * pitch;
    if (scale == 1)
        return *pixel;
    if (scale == 2)
        return mean_of_four(pixel, pitch);
    float upper = mean_of_four(pixel, pitch) + mean_of_four(pixel + 6, pitch);
    return (upper + (mean_of_four(lower, pitch) + mean_of_four(lower + 6, pitch))) * 0.25f;
}

/* Finds what a mirror shows at a sample of the viewport; 0 where its picture doesn't reach. */
static int find_light(const e3d_mirror *mirror, int32_t x, int32_t y, float out[3])
{
    int32_t column = x - mirror->left, row = y - mirror->top;
    if (column < 0 || row < 0 || column >= mirror->width || row >= mirror->height)
        return 0;
    size_t scale = (size_t)mirror->scale, pitch = 3 * scale * (size_t)mirror->width;
    const float *first = mirror->radiance + scale * (size_t)row * pitch + 3 * scale * (size_t)column;
    for (int k = 0; k < 3; k++)
        out[k] = mean_of(first + k, pitch, mirror->scale);
    return 1;
}

static void set_sample(e3d_mirror_batch *out, int i, float share, const float light[3])
{
    out->share[i] = share;
    out->rest[i] = 1.0f - share;
    for (int k = 0; k < 3; k++)
        out->light[k][i] = light[k];
}

static void find_batch(const e3d_steps *s)
{
    e3d_shade_memory *memory = s->out->memory;
    const e3d_batch *batch = &memory->batch;
    const e3d_tile *tile = &s->out->pixels->tile;
    const e3d_mirror *mirror = NULL;
    for (int i = 0; i < e3d_padded_count(batch); i++) {
        int32_t x = batch->sample[i] & (E3D_TILE - 1), y = batch->sample[i] >> E3D_TILE_SHIFT;
        if (!i || batch->surface[i] != batch->surface[i - 1])
            mirror = mirror_of(s->pass->frame, &memory->surfaces, batch->surface[i]);
        float light[3] = {0.0f, 0.0f, 0.0f};
        int shows = mirror && find_light(mirror, tile->x + x, tile->y + y, light);
        set_sample(&memory->mirrors, i, shows ? s->bucket->material->mirror : 0.0f, light);
    }
}

void e3d_find_mirrors(const e3d_steps *s)
{
    find_batch(s);
    if (s->bucket->material->is_physical)
        e3d_share_mirrors(s->pass, s->bucket, s->out->memory);
}

void e3d_lay_mirrors(const e3d_steps *s)
{
    s->pass->kernels->mirror_light(&s->out->memory->batch, s->bucket->material->is_physical, &s->out->memory->mirrors);
}
