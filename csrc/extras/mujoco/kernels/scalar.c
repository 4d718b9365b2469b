/* The kernels as backend `scalar`: the rules of section 29, one number at a time. What vectors do must agree with it. */
#include <math.h>

#include "extras/mujoco/kernels/block.h"
#include "extras/mujoco/kernels/kernels.h"
#include "extras/mujoco/kernels/power.h"
#include "extras/mujoco/kernels/texel.h"

/* ---- vertices and triangles (R257) ---- */

static float row_of(const muj_projection *projection, int r, const float at[3])
{
    const float (*column)[4] = projection->column;
    return (column[0][r] * at[0] + column[1][r] * at[1]) + (column[2][r] * at[2] + column[3][r]);
}

static void scalar_transform(const muj_projection *projection, const float *positions, int32_t count, const muj_vertices *out)
{
    float most = projection->most;
    for (int32_t i = 0; i < count; i++) {
        const float *at = positions + 3 * (size_t)i, *clip = projection->clip;
        float w = row_of(projection, 3, at), inverse = 1 / w;
        float x = row_of(projection, 0, at) * inverse, y = row_of(projection, 1, at) * inverse, z = row_of(projection, 2, at) * inverse;
        int inside = w > 0 && z <= 1 && x > -most && x < most && y > -most && y < most;
        if (projection->has_clip)
            inside = inside && (clip[0] * at[0] + clip[1] * at[1]) + (clip[2] * at[2] + clip[3]) >= 0;
        out->x[i] = x, out->y[i] = y, out->z[i] = z;
        out->snapped[i][0] = inside ? (int32_t)rintf(x) : MUJ_OUTSIDE;
        out->snapped[i][1] = inside ? (int32_t)rintf(y) : 0;
    }
}

/* All triangles may show: what is sorted out by other backends is so later, too. */
static int32_t scalar_choose(const muj_choice *choice, const muj_vertices *vertices, const int32_t *corners, int32_t first, int32_t end,
                             int32_t *out)
{
    (void)choice, (void)vertices, (void)corners;
    for (int32_t t = first; t < end; t++)
        out[t - first] = t;
    return end - first;
}

/* ---- samples (R258) ---- */

static void draw_sample(const muj_block *block, int32_t x, int32_t y, int s, int32_t number, float *depth, int32_t *shown)
{
    float z = (block->z[s] + block->z_down * (float)y) + block->z_across * (float)x;
    for (int k = 0; k < 3; k++)
        if ((block->edge[k][s] + block->down[k] * y) + block->across[k] * x < 0)
            return;
    if (z >= *depth && z <= 1)
        *depth = z, *shown = number;
}

/* Draws a record in columns of blocks. x counts groups. */
static void draw_record(const muj_raster *raster, const muj_record *record, int32_t number)
{
    int32_t pixels = raster->group_pixels, first = record->x0 / pixels * pixels;
    int32_t top = record->y0 > raster->top ? record->y0 : raster->top, bottom = record->y1 < raster->end ? record->y1 : raster->end - 1;
    muj_block block;
    for (int32_t left = first; left <= record->x1 && top <= bottom; left += MUJ_BLOCK) {
        int32_t right = left + MUJ_BLOCK - 1 < record->x1 ? left + MUJ_BLOCK - 1 : record->x1;
        if (!muj_begin_block(raster, record, left, top, right / pixels * pixels + pixels - 1, bottom, &block))
            continue;
        for (int32_t y = 0; y <= bottom - top; y++)
            for (int32_t x = 0; x <= right / pixels - left / pixels; x++)
                for (int s = 0; s < 4; s++) {
                    size_t at = (size_t)(top - raster->top + y) * raster->stride + 4 * (size_t)(left / pixels + x) + (size_t)s;
                    draw_sample(&block, x, y, s, number, raster->depth + at, raster->shown + at);
                }
    }
}

static void scalar_draw(const muj_raster *raster, muj_record *const *records, const int32_t *numbers, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        draw_record(raster, records[numbers[i]], numbers[i]);
}

/* ---- shadows (R265) ---- */

static int32_t scalar_cover(const muj_shadow_test *test, const muj_lookups *lookups, int32_t first, int32_t end, int32_t *out)
{
    int32_t count = 0;
    for (int32_t i = first; i < end; i++) {
        int32_t x = lookups->x[i] - test->low[0], y = lookups->y[i] - test->low[1];
        int inside = x >= 0 && y >= 0 && lookups->x[i] <= test->high[0] && lookups->y[i] <= test->high[1];
        for (int k = 0; k < 3 && inside; k++)
            inside = test->edge[k] + test->across[k] * x + test->down[k] * y >= 0;
        if (inside)
            out[count++] = i;
    }
    return count;
}

/* ---- light (R261) ---- */

static float dot(const float a[3], const float b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static float make_unit(float a[3])
{
    float length = sqrtf(dot(a, a)), scale = length > 0 ? 1 / length : 1;
    for (int c = 0; c < 3; c++)
        a[c] *= scale;
    return length;
}

static float unit_range(float v) { return v > 0 ? v < 1 ? v : 1 : 0; }

static float strength_of(const muj_lamp *lamp, const float place[3], float to_light[3])
{
    const float *a = lamp->attenuation;
    for (int c = 0; c < 3; c++)
        to_light[c] = lamp->is_directional ? -lamp->dir[c] : lamp->pos[c] - place[c];
    if (lamp->is_directional)
        return 1;
    float distance = make_unit(to_light), inside = 0 - dot(to_light, lamp->dir), cone = 1;
    if (lamp->cutoff_cosine > -1)
        cone = inside < lamp->cutoff_cosine ? 0 : muj_power(unit_range(inside), lamp->exponent);
    return cone == 0 ? 0 : cone / ((a[0] + a[1] * distance) + a[2] * (distance * distance));
}

static void add_lamp(const muj_lamp *lamp, const muj_corners *corners, int i, const float place[3], const float normal[3],
                     const float to_eye[3], float out[3])
{
    float to_light[3], strength = strength_of(lamp, place, to_light), shine = 0;
    if (strength == 0)
        return;
    float facing = dot(normal, to_light), most = facing > 0 ? facing : 0;
    if (facing > 0 && corners->specular[i] != 0) {
        float half[3] = {to_light[0] + to_eye[0], to_light[1] + to_eye[1], to_light[2] + to_eye[2]};
        make_unit(half);
        shine = muj_power(unit_range(dot(normal, half)), corners->shininess[i] * 128);
    }
    for (int c = 0; c < 3; c++) {
        float rgb = corners->rgb[c][i], dull = lamp->ambient[c] * rgb + most * (lamp->diffuse[c] * rgb);
        out[c] += strength * (dull + shine * (lamp->specular[c] * corners->specular[i]));
    }
}

static void scalar_light(const muj_lamps *lamps, muj_corners *corners)
{
    for (int i = 0; i < corners->count; i++) {
        float place[3], normal[3], to_eye[3], sum[MUJ_PASSES][3] = {{0}};
        for (int c = 0; c < 3; c++) {
            place[c] = corners->place[c][i], normal[c] = corners->normal[c][i];
            to_eye[c] = lamps->eye[c] - place[c];
            sum[0][c] = corners->emission[i] * corners->rgb[c][i] + lamps->ambient * corners->rgb[c][i];
        }
        make_unit(normal);
        make_unit(to_eye);
        for (int k = 0; k < lamps->count; k++)
            add_lamp(&lamps->lamp[k], corners, i, place, normal, to_eye, sum[lamps->lamp[k].pass]);
        for (int p = 0; p < lamps->passes; p++)
            for (int c = 0; c < 3; c++)
                corners->color[p][c][i] = unit_range(sum[p][c]);
    }
}

/* ---- fragments (R259, R263, R264, R267) ---- */

static void weigh(const muj_face *face, int32_t x, int32_t y, float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (face->base[k] + (float)x * face->across[k]) + (float)y * face->down[k];
    float scale = 1 / ((out[0] + out[1]) + out[2]);
    for (int k = 0; k < 3; k++)
        out[k] *= scale;
}

/* Of a triangle seen from the side, weights are no numbers, and any will do. */
static void mend(float weight[3])
{
    if (isfinite(weight[0]) && isfinite(weight[1]) && isfinite(weight[2]))
        return;
    for (int k = 0; k < 3; k++)
        weight[k] = 1.0f / 3;
}

static float mix(const float weight[3], const float corner[3])
{
    return (weight[0] * corner[0] + weight[1] * corner[1]) + weight[2] * corner[2];
}

static void mix3(const float weight[3], const float corner[3][3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = mix(weight, corner[c]);
}

static muj_level level_of(const e3d_muj_texture *texture, const float at[3][3])
{
    float detail = 0, place[3][2];
    for (int k = 0; k < 3; k++) {
        memcpy(place[k], at[k], sizeof place[k]);
        if (texture->faces == 6)
            muj_place_on(muj_face_of(at[0]), at[k], place[k]);
    }
    for (int c = 0; c < 2; c++)
        for (int k = 1; k < 3; k++) {
            float change = fabsf(place[k][c] - place[0][c]) * (float)(c ? texture->height : texture->width);
            detail = change > detail ? change : detail;
        }
    if (!(detail > 1))
        return (muj_level){0, 0};
    float lod = muj_log2(detail < MUJ_FAR_OUT ? detail : MUJ_FAR_OUT);
    int32_t number = (int32_t)lod;
    if (number >= texture->levels - 1)
        return (muj_level){texture->levels - 1, 0};
    return (muj_level){number, lod - (float)number};
}

static void find_texel(const muj_batch *batch, const muj_face *face, int32_t x, int32_t y, float out[4])
{
    int32_t left = x & ~1, low = batch->bottom - ((batch->bottom - y) & ~1);
    const int32_t around[3][2] = {{left, low}, {left + 1, low}, {left, low - 1}};
    float weight[3], at[3], beside[3][3];
    for (int k = 0; k < 3; k++) {
        weigh(face, around[k][0], around[k][1], weight);
        mix3(weight, face->coordinates, beside[k]);
    }
    weigh(face, x, y, weight);
    mend(weight);
    mix3(weight, face->coordinates, at);
    muj_sample(batch->texture, at, level_of(batch->texture, (const float (*)[3])beside), out);
}

static uint32_t code_of(float v) { return (uint32_t)(unit_range(v) * 255 + 0.5f); }

static void scalar_shade(muj_batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        const muj_face *face = (const muj_face *)(batch->faces + batch->face[i]);
        float weight[3], texel[4] = {1, 1, 1, 1}, share = 1;
        weigh(face, batch->x[i], batch->y[i], weight);
        mend(weight);
        if (batch->texture)
            find_texel(batch, face, batch->x[i], batch->y[i], texel);
        if (batch->fog)
            share = unit_range((batch->fog->end - fabsf(mix(weight, face->ahead))) / batch->fog->range);
        for (int p = 0; p < batch->passes; p++) {
            batch->code[p][i] = 0;
            for (int c = 0; c < 3; c++) {
                float v = unit_range(mix(weight, batch->faces + batch->face[i] + muj_color_at(p) + 3 * c)) * texel[c];
                if (batch->fog)
                    v = v * share + (p ? 0 : batch->fog->color[c]) * (1 - share);
                batch->code[p][i] |= code_of(v) << 8 * c;
            }
        }
        batch->alpha[i] = mix(weight, face->alpha) * texel[3];
        for (int c = 0; c < 3 && batch->needs_place; c++)
            batch->place[c][i] = mix(weight, face->place[c]);
    }
}

extern const muj_kernels muj_kernels_scalar;
const muj_kernels muj_kernels_scalar = {scalar_transform, scalar_choose, scalar_draw, scalar_cover, scalar_light, scalar_shade};
