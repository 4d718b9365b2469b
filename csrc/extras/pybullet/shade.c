/* Shades a picture as TinyRenderer does: rules R268 to R270.
 * In: an e3d_tiny_picture. Out: its colours, depths and masks. Always: a row is one thread's. */
#include "e3d_pybullet.h"

#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "e3d_backends.h"

/* Rows that a thread takes at once; smaller pictures are one thread's. */
enum { ROWS = 16,
       ALONE = 1 << 14 };

static const float SHADE = 0.8f, BIAS = 0.05f;

static float row_at(const float *row, const float *position)
{
    return ((position[0] * row[0] + position[1] * row[1]) + position[2] * row[2]) + row[3];
}

/* Which of `count` texels a coordinate lies in, the nearest if in none, the last if it is no number. */
static int32_t texel(float along, float w, int32_t count)
{
    const float place = (along / w + 1.0f) * (0.5f * (float)count);
    const float most = (float)(count - 1);
    const float below = place < most ? place : most;
    return (int32_t)(below > 0.0f ? below : 0.0f);
}

/* R269: the share of light that passes to a pixel. */
static float light_through(const e3d_tiny_picture *p, const float *position)
{
    const float *clip = p->shadows.clip;
    const float w = row_at(clip + 12, position);
    const int32_t x = texel(row_at(clip, position), w, p->width);
    const int32_t y = p->height - 1 - texel(row_at(clip + 4, position), w, p->height);
    const float depth = p->shadows.depths[(size_t)y * (size_t)p->width + (size_t)x];
    if (!(depth < 1e30f)) {
        return 1.0f;
    }
    const float nearest = p->lens.is_parallel ? depth : depth * p->lens.scale / (depth + p->lens.offset);
    const float own = (row_at(clip + 8, position) + w) * 0.5f - BIAS;
    return nearest > own ? 1.0f : SHADE;
}

/* R268: a code of a colour in light. */
static uint8_t lit(float light, float color, float ambient, uint8_t own)
{
    const float value = (light * color + ambient) * (float)own;
    const float below = value < 255.0f ? value : 255.0f;
    return (uint8_t)(below > 0.0f ? below : 0.0f);
}

static void shade_pixel(const e3d_tiny_picture *p, size_t i)
{
    const e3d_tiny_light *light = &p->light;
    const float *normal = p->normals + 3 * i, *to = light->direction;
    const float facing = (normal[0] * to[0] + normal[1] * to[1]) + normal[2] * to[2];
    const float mirrored = (normal[2] * facing) * 2.0f - to[2];
    const float glance = mirrored > 0.0f ? mirrored : 0.0f;
    const float diffuse = (facing > 0.0f ? facing : 0.0f) * light->diffuse;
    float all = diffuse + (glance * glance) * light->specular;
    if (p->shadows.depths) {
        all *= light_through(p, p->shadows.positions + 3 * i);
    }
    for (int channel = 0; channel < 3; channel++) {
        p->colors[4 * i + (size_t)channel] =
            lit(all, light->color[channel], light->ambient, p->own[4 * i + (size_t)channel]);
    }
    p->colors[4 * i + 3] = 255;
}

/* R270: depths as PyBullet computes them, which for perspectives are those of OpenGL's window. */
static float window_depth(const e3d_tiny_lens *lens, float depth)
{
    if (!lens->is_parallel) {
        return (depth < 1.0f ? depth : 1.0f) * 0.5f + 0.5f;
    }
    const double near = lens->scale / (lens->offset - 1.0), far = lens->scale / (lens->offset + 1.0);
    const double z = depth < 1e30f ? depth : far;
    const float share = (float)(far * (near + z) / (2.0 * far * near + far * z - near * z));
    return share == share ? share : 1.0f;
}

static void shade_rows(void *argument, int part)
{
    const e3d_tiny_picture *p = argument;
    const size_t width = (size_t)p->width;
    const size_t first = (size_t)part * ROWS * width, all = width * (size_t)p->height;
    const size_t end = first + ROWS * width < all ? first + ROWS * width : all;
    const e3d_fpenv before = e3d_fpenv_enter();
    for (size_t i = first; i < end; i++) {
        const int32_t shown = p->shown[i];
        const int is_there = shown >= 0 && shown < p->mask_count - 1;
        p->shown_masks[i] = p->masks[is_there ? shown : p->mask_count - 1];
        p->window_depths[i] = window_depth(&p->lens, p->depths[i]);
        if (is_there) {
            shade_pixel(p, i);
        } else {
            memset(p->colors + 4 * i, 255, 4);
        }
    }
    e3d_fpenv_leave(before);
}

void e3d_tiny_shade(const e3d_tiny_picture *picture, int32_t threads)
{
    const int most = threads > 0 ? threads : e3d_thread_count();
    const int parts = (picture->height + ROWS - 1) / ROWS;
    const int is_small = (int64_t)picture->width * picture->height < ALONE;
    e3d_pool_share(is_small ? 1 : most, parts, shade_rows, (void *)(uintptr_t)picture);
}
