/* shade: finds how far the surfaces of a batch shift what is behind them, and how much they blur it (R164, R165, R273). */
#include <string.h>

#include "e3d.h"
#include "data/views/whole_picture.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "kernels/types/texture_slots.h"
#include "frame/pass/view.h"
#include "frame/shade/bend.h"
#include "frame/shade/texture_slots.h"

/* R164: the indices of refraction of red, green and blue. */
static void find_indices(const e3d_physical *p, float index[3])
{
    float half = ((p->ior - 1.0f) * 0.025f) * p->dispersion;
    const float raw[3] = {p->ior - half, p->ior, p->ior + half};
    for (int c = 0; c < 3; c++)
        index[c] = raw[c] > 1.0f ? raw[c] : 1.0f;
}

static float unit(float v)
{
    v = v > 0.0f ? v : 0.0f;
    return v < 1.0f ? v : 1.0f;
}

static void find_rows(const e3d_frame *frame, float rows[3][4])
{
    static const int ROWS[3] = {0, 1, 3};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 4; k++)
            rows[r][k] = (float)frame->clip_from_world[4 * ROWS[r] + k];
}

static e3d_bending bending_of(const e3d_steps *s)
{
    const e3d_frame *frame = s->pass->frame;
    const e3d_physical *p = &s->bucket->material->physical;
    const e3d_texture_memory *textures = &s->out->memory->textures;
    const e3d_tile *tile = &s->out->pixels->tile;
    const e3d_batch *batch = &s->out->memory->batch;
    const e3d_whole whole = e3d_whole_of(frame);
    e3d_bending out = {.sample = batch->sample,
                       .width = (float)frame->width,
                       .height = (float)frame->height,
                       .x = tile->x,
                       .y = tile->y,
                       .pixels_a_sample = 1.0f / (float)frame->samples_axis,
                       .is_dispersive = p->dispersion != 0.0f,
                       .is_body = p->thickness != 0.0f,
                       .blur_share = unit(p->ior * 2.0f - 2.0f),
                       .blur_width = (float)whole.width,
                       .blur_area = whole.fineness * whole.fineness,
                       .thickness = e3d_varying_of(textures, E3D_SLOT_THICKNESS, 1, p->thickness),
                       .roughness = e3d_varying_of(textures, E3D_SLOT_METALLIC_ROUGHNESS, 1, p->roughness)};
    for (int k = 0; k < 3; k++) {
        out.normal[k] = batch->normal[k];
        out.position[k] = e3d_batch_places(batch)[k];
        out.lit_position[k] = batch->position[k];
    }
    memcpy(out.eye, frame->eye, sizeof out.eye);
    find_rows(frame, out.rows);
    find_indices(p, out.index);
    memcpy(out.depth_row, s->pass->view->rows + 8, sizeof out.depth_row);
    return out;
}

void e3d_find_bends(const e3d_steps *s)
{
    e3d_shade_memory *memory = s->out->memory;
    const e3d_bending bending = bending_of(s);
    s->pass->kernels->bend(&bending, memory->textures.batch.depth, memory->batch.count, &memory->bends);
}
