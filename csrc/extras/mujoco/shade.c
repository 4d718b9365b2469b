/* Shading: the colours of a triangle at the centres of four pixels of a row (R259 - R264).
 * In: a record and pixels. Out: a colour for each pass. */
#include <math.h>

#include "extras/mujoco/shading.h"

void muj_begin_shading(muj_shader *shader, const muj_picture *picture, const muj_view *view, int all_lights)
{
    shader->picture = picture;
    shader->view = view;
    shader->all_lights = all_lights;
    shader->grid.draw = MUJ_NONE;
    shader->number++; /* memory begins with faces of picture 0 */
}

static const muj_face *find_face(muj_shader *shader, const muj_draw *draw, int32_t number, int32_t triangle)
{
    muj_face *face = &shader->face[((uint32_t)triangle * 5 + (uint32_t)number * 31) % MUJ_FACES];
    if (face->draw != number || face->triangle != triangle || face->picture != shader->number) {
        muj_set_face(shader->picture, shader->view, draw, number, triangle, shader->all_lights, face);
        face->picture = shader->number;
    }
    return face;
}

static float4 clamp4(float4 v) { return less_of(more_of(v, splat(0)), splat(1)); }

/* The shares of the corners at the centres of four pixels; computed from pixel `first` of them. */
static void weigh(const muj_face *face, int32_t x, int32_t y, int first, float4 out[3])
{
    double w[3], sum = 0, px = x + first + 0.5, py = y + 0.5;
    for (int k = 0; k < 3; k++) {
        w[k] = (face->row[k][0] * px + face->row[k][1] * py) + face->row[k][2];
        sum += w[k];
    }
    double scale = 1 / sum;
    float4 step = (float4){0, 1, 2, 3} - splat((float)first), total;
    if (!(scale - scale == 0)) { /* seen from the side: any point of it will do */
        out[0] = out[1] = out[2] = splat(1.0f / 3);
        return;
    }
    for (int k = 0; k < 3; k++)
        out[k] = splat((float)(w[k] * scale)) + step * splat((float)(face->row[k][0] * scale));
    total = splat(1) / ((out[0] + out[1]) + out[2]);
    for (int k = 0; k < 3; k++)
        out[k] *= total;
}

static float4 mix(const float4 weight[3], float a, float b, float c) { return (weight[0] * splat(a) + weight[1] * splat(b)) + weight[2] * splat(c); }

static void mix3(const float4 weight[3], const float corner[3][3], float4 out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = mix(weight, corner[0][c], corner[1][c], corner[2][c]);
}

/* Multiplies all passes by texels. Their level is found once for each block of 2 x 2 pixels, which are counted from below. */
static void apply_texture(const e3d_muj_frame *frame, const muj_draw *draw, const muj_face *face, const float4 weight[3], int32_t x, int32_t y,
                          int first, uint32_t lanes, int passes, muj_colors *out)
{
    int32_t low = frame->height - 1 - ((frame->height - 1 - y) & ~1);
    float4 beside[3], row[2][3], texel[4] = {{0}};
    weigh(face, x, y == low ? low - 1 : low, first, beside);
    mix3(weight, face->coordinates, row[y != low]);
    mix3(beside, face->coordinates, row[y == low]);
    const float4 *own = row[y != low];
    muj_level levels[2];
    muj_find_levels(draw->texture, row[0], row[1], levels);
    for (int l = 0; l < 4; l++) {
        float sample[4] = {0};
        if (lanes >> l & 1)
            muj_sample(draw->texture, (float[3]){own[0][l], own[1][l], own[2][l]}, levels[l >> 1], sample);
        for (int c = 0; c < 4; c++)
            texel[c][l] = sample[c];
    }
    for (int p = 0; p < passes; p++)
        for (int c = 0; c < 3; c++)
            out->rgb[p][c] *= texel[c];
    out->alpha *= texel[3];
}

/* Fog is black in the passes of lights with shadows. */
static void apply_fog(const e3d_muj_frame *frame, float4 ahead, int passes, muj_colors *out)
{
    float range = frame->fog_end - frame->fog_start;
    float4 share = clamp4((splat(frame->fog_end) - size_of(ahead)) / splat(range != 0 ? range : 1));
    for (int p = 0; p < passes; p++)
        for (int c = 0; c < 3; c++)
            out->rgb[p][c] = out->rgb[p][c] * share + splat(p ? 0 : frame->fog[c]) * (splat(1) - share);
}

/* Shades lanes that show one triangle; the first one is number `first`. */
static void shade_triangle(muj_shader *shader, const muj_draw *draw, int32_t number, int32_t triangle, int32_t x, int32_t y, int first,
                           uint32_t lanes, muj_colors *out)
{
    const e3d_muj_frame *frame = shader->picture->frame;
    const muj_face *face = find_face(shader, draw, number, triangle);
    int passes = shader->all_lights ? 1 : 1 + shader->picture->shadow_count;
    float4 weight[3];
    weigh(face, x, y, first, weight);
    for (int p = 0; p < passes; p++) {
        mix3(weight, face->color[p], out->rgb[p]);
        for (int c = 0; c < 3; c++)
            out->rgb[p][c] = clamp4(out->rgb[p][c]);
    }
    out->alpha = mix(weight, face->alpha[0], face->alpha[1], face->alpha[2]);
    if (passes > 1)
        mix3(weight, face->place, out->place);
    if (draw->mapping != MUJ_UNTEXTURED)
        apply_texture(frame, draw, face, weight, x, y, first, lanes, passes, out);
    if (frame->has_fog)
        apply_fog(frame, mix(weight, face->ahead[0], face->ahead[1], face->ahead[2]), passes, out);
}

/* Takes some lanes of b. */
static void take_lanes(const muj_shader *shader, const muj_colors *b, uint32_t lanes, muj_colors *out)
{
    int passes = shader->all_lights ? 1 : 1 + shader->picture->shadow_count;
    int4 mask;
    for (int l = 0; l < 4; l++)
        mask[l] = lanes >> l & 1 ? -1 : 0;
    for (int c = 0; c < 3; c++) {
        for (int p = 0; p < passes; p++)
            out->rgb[p][c] = choose(mask, b->rgb[p][c], out->rgb[p][c]);
        if (passes > 1)
            out->place[c] = choose(mask, b->place[c], out->place[c]);
    }
    out->alpha = choose(mask, b->alpha, out->alpha);
}

static int first_of(uint32_t lanes) { return lanes & 1 ? 0 : lanes & 2 ? 1
                                                         : lanes & 4   ? 2
                                                                       : 3; }

static int last_of(uint32_t lanes) { return lanes & 8 ? 3 : lanes & 4 ? 2
                                                        : lanes & 2   ? 1
                                                                      : 0; }

/* A plane's cells may change between the lanes. */
static void shade_grid(muj_shader *shader, const muj_draw *draw, int32_t number, int32_t x, int32_t y, uint32_t lanes, muj_colors *out)
{
    if (shader->grid.draw != number) {
        muj_set_grid(shader->view, draw, &shader->grid);
        shader->grid.draw = number;
    }
    int first = first_of(lanes), last = last_of(lanes);
    int32_t from = muj_cell_at(draw, &shader->grid, x + first + 0.5, y + 0.5);
    int32_t to = first == last ? from : muj_cell_at(draw, &shader->grid, x + last + 0.5, y + 0.5);
    if (from == to) {
        shade_triangle(shader, draw, number, from, x, y, first, lanes, out);
        return;
    }
    for (int l = first; l <= last; l++)
        if (lanes >> l & 1) {
            muj_colors one;
            int32_t cell = muj_cell_at(draw, &shader->grid, x + l + 0.5, y + 0.5);
            shade_triangle(shader, draw, number, cell, x, y, l, 1u << l, &one);
            take_lanes(shader, &one, 1u << l, out);
        }
}

void muj_shade(muj_shader *shader, const muj_record *record, int32_t x, int32_t y, uint32_t lanes, muj_colors *out)
{
    const muj_draw *draw = muj_draw_of(shader->picture, record->draw);
    if (draw->kind == MUJ_GRID)
        shade_grid(shader, draw, record->draw, x, y, lanes, out);
    else
        shade_triangle(shader, draw, record->draw, record->triangle, x, y, first_of(lanes), lanes, out);
}
