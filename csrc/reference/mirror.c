/* Mirrors: faces that show a picture of what their plane reflects.
 * In: a surface, the frame's mirrors with their pictures. Out: the share of a mirror, and what its picture shows.
 * Rules: R210, R213 and R272 (means of several pixels). */
#include <math.h>

#include "reference/arithmetic.h"
#include "reference/surface.h"

static int is_lit_face(const e3d_frame *frame, const ref_surface *surface)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    return frame->mode == E3D_MODE_LIT && primitive->kind == REF_FACE && !primitive->material->is_unlit;
}

static int holds_face(const e3d_mirror *mirror, const ref_surface *surface)
{
    const float *n = mirror->plane;
    for (int k = 0; k < 3; k++) {
        const float *p = surface->corner_position[k];
        float height = ((n[0] * p[0] + n[1] * p[1]) + n[2] * p[2]) - n[3];
        if (!(fabsf(height) <= mirror->slack))
            return 0;
    }
    return 1;
}

static const e3d_mirror *mirror_of(const e3d_frame *frame, const ref_surface *surface)
{
    for (int32_t i = 0; i < frame->mirror_count; i++)
        if (holds_face(&frame->mirrors[i], surface))
            return &frame->mirrors[i];
    return NULL;
}

/* R213, R272: a channel's mean of scale x scale pixels. */
static float mean_of(const float *pixel, size_t pitch, size_t scale)
{
    if (scale == 1)
        return *pixel;
    size_t half = scale / 2, right = 3 * half, below = half * pitch;
    float a = mean_of(pixel, pitch, half), b = mean_of(pixel + right, pitch, half);
    float c = mean_of(pixel + below, pitch, half), d = mean_of(pixel + below + right, pitch, half);
    return ((a + b) + (c + d)) * 0.25f;
}

/* What a picture shows at a column and a row of the viewport. */
static void find_light(const e3d_mirror *mirror, int32_t column, int32_t row, float out[3])
{
    size_t scale = (size_t)mirror->scale, pitch = 3 * scale * (size_t)mirror->width;
    const float *first = mirror->radiance + scale * (size_t)row * pitch + 3 * scale * (size_t)column;
    for (int c = 0; c < 3; c++)
        out[c] = mean_of(first + c, pitch, scale);
}

/* R210 */
void ref_find_mirror(const e3d_frame *frame, const ref_place *at, ref_surface *surface)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    const e3d_mirror *mirror = NULL;
    surface->mirror = 0.0f;
    if (is_lit_face(frame, surface) && primitive->material->mirror > 0.0f)
        mirror = mirror_of(frame, surface);
    if (!mirror)
        return;
    int32_t column = at->x - mirror->left, row = at->y - mirror->top;
    if (column < 0 || row < 0 || column >= mirror->width || row >= mirror->height)
        return;
    surface->mirror = primitive->material->mirror;
    find_light(mirror, column, row, surface->mirrored_light);
}
