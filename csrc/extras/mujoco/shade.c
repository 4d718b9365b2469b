/* Shading: the colours of fragments, those with the same texture together (R259 - R264).
 * In: records and pixels of a band. Out: the codes of each pass. */
#include <stdlib.h>

#include "extras/mujoco/shading.h"

#define LEAST_ALPHA 0.99f /* less doesn't receive the light of lights with shadows */

typedef struct chain {
    int32_t first, last;
} chain;

void muj_begin_shading(muj_shader *shader, const muj_picture *picture, const muj_view *view, int all_lights, int is_blending)
{
    const e3d_muj_frame *frame = picture->frame;
    float range = frame->fog_end - frame->fog_start;
    shader->picture = picture;
    shader->view = view;
    shader->is_blending = is_blending;
    muj_set_lamps(picture, view, all_lights, &shader->lamps);
    shader->stride = muj_color_at(shader->lamps.passes);
    shader->fog = (muj_fog){frame->fog_end, range != 0 ? range : 1, {frame->fog[0], frame->fog[1], frame->fog[2]}};
    shader->seen.number = MUJ_NONE;
}

int muj_begin_band(muj_shader *shader, int32_t top, muj_fragments *fragments)
{
    size_t textures = 1 + (size_t)shader->picture->frame->texture_count;
    shader->top = top;
    shader->serial++; /* memory begins with faces of band 0 */
    shader->faces.count = fragments->runs.count = 0;
    shader->corners.count = 0; /* some wait still if memory was out in the band before */
    fragments->count = 0;
    if (!e3d_array_reserve(&shader->chains, textures, sizeof(chain)))
        return 0;
    memset(shader->chains.data, 0xFF, textures * sizeof(chain)); /* MUJ_NONE */
    return 1;
}

/* Whether a triangle is of the side that reflects: of a plane, or the upper one of a box. */
static int reflects(const muj_draw *draw, int32_t triangle)
{
    return draw->is_reflective && (draw->kind == MUJ_GRID || draw->shape->normals[9 * (size_t)triangle + 2] > 0.5f);
}

/* Adds a run of one face. */
static int add_face(muj_shader *shader, const muj_draw *draw, muj_run run, muj_fragments *fragments)
{
    int32_t texture = draw->mapping == MUJ_UNTEXTURED ? 0 : 1 + (int32_t)(draw->texture - shader->picture->frame->textures);
    int32_t number = (int32_t)fragments->runs.count;
    chain *of = (chain *)shader->chains.data + texture;
    if (fragments->count > INT32_MAX - run.count || !e3d_array_reserve(&fragments->runs, (size_t)number + 1, sizeof run))
        return 0;
    muj_run *runs = fragments->runs.data;
    if (of->first == MUJ_NONE)
        of->first = number;
    else
        runs[of->last].next = number;
    of->last = number;
    run.next = MUJ_NONE;
    run.first = fragments->count;
    runs[number] = run;
    fragments->runs.count++;
    fragments->count += run.count;
    return 1;
}

/* Where the pixels end that show the same triangle of a plane as pixel x: along a row they follow each other. */
static int32_t end_of_cell(const muj_draw *draw, const muj_grid *grid, int32_t triangle, int32_t x, int32_t end, int32_t y)
{
    int32_t same = x, other = end;
    if (muj_cell_at(draw, grid, end - 0.5, y + 0.5) == triangle)
        return end;
    while (other - same > 1) {
        int32_t middle = same + (other - same) / 2;
        if (muj_cell_at(draw, grid, middle + 0.5, y + 0.5) == triangle)
            same = middle;
        else
            other = middle;
    }
    return other;
}

int muj_add_run(muj_shader *shader, const muj_record *record, int32_t x, int32_t end, int32_t y, uint32_t mask, muj_fragments *fragments)
{
    const muj_draw *draw = muj_draw_of(shader->picture, record->draw);
    muj_run run = {.y = (uint8_t)(y - shader->top), .mask = (uint8_t)mask, .is_unlit = !draw->geom};
    run.adds = (uint8_t)reflects(draw, record->triangle);
    while (x < end) {
        int32_t column = x / MUJ_COLUMN, last = (column + 1) * MUJ_COLUMN < end ? (column + 1) * MUJ_COLUMN : end, triangle = record->triangle;
        if (draw->kind == MUJ_GRID) {
            muj_see(shader, draw, record->draw);
            triangle = muj_cell_at(draw, &shader->seen.grid, x + 0.5, y + 0.5);
            last = end_of_cell(draw, &shader->seen.grid, triangle, x, last, y);
        }
        run.face = muj_find_face(shader, draw, record->draw, triangle, column);
        run.x = (uint8_t)(x % MUJ_COLUMN);
        run.pixel = y * shader->picture->frame->width + x;
        run.count = last - x;
        if (run.face < 0 || !add_face(shader, draw, run, fragments))
            return 0;
        x = last;
    }
    return 1;
}

/* ---- batches ---- */

/* Which fragments a batch has: parts of runs. */
typedef struct parts {
    int32_t count, first[MUJ_BATCH], length[MUJ_BATCH], is_unlit[MUJ_BATCH];
} parts;

/* Finds the lights with shadows that don't matter to fragments: they are too transparent, or the lights add nothing. */
static void set_shadowed(const muj_batch *batch, int from, int count, int is_unlit, uint8_t *out)
{
    if (is_unlit) {
        memset(out, 0xFF, (size_t)count);
        return;
    }
    for (int i = 0; i < count; i++)
        out[i] = batch->alpha[from + i] >= LEAST_ALPHA ? 0 : 0xFF;
    for (int p = 1; p < batch->passes; p++)
        for (int i = 0; i < count; i++)
            out[i] |= (uint8_t)((batch->code[p][from + i] == 0) << (p - 1));
}

/* Most parts are one fragment, for which a call takes longer than the copy. */
static inline void copy_codes(const uint32_t *from, int32_t count, uint32_t *to)
{
    if (count == 1)
        *to = *from;
    else
        memcpy(to, from, (size_t)count * sizeof *to);
}

static void write_batch(const muj_shader *shader, const parts *of, muj_fragments *fragments)
{
    const muj_batch *batch = &shader->batch;
    int from = 0;
    for (int k = 0; k < of->count; from += of->length[k++]) {
        size_t first = (size_t)of->first[k], bytes = (size_t)of->length[k] * 4;
        for (int p = 0; p < batch->passes; p++)
            copy_codes(batch->code[p] + from, of->length[k], muj_codes_of(fragments, p) + first);
        for (int i = 0; shader->is_blending && i < of->length[k]; i++)
            muj_codes_of(fragments, 0)[first + (size_t)i] |= (uint32_t)muj_code(batch->alpha[from + i]) << 24;
        for (int c = 0; c < 3 && batch->needs_place; c++)
            memcpy(muj_places_of(fragments, c) + first, batch->place[c] + from, bytes);
        if (batch->needs_place)
            set_shadowed(batch, from, of->length[k], of->is_unlit[k], (uint8_t *)fragments->shadowed.data + first);
    }
}

static void shade_batch(muj_shader *shader, parts *of, muj_fragments *fragments)
{
    muj_batch *batch = &shader->batch;
    if (!batch->count)
        return;
    for (int i = batch->count; i & 15; i++) /* whole vectors */
        batch->face[i] = batch->face[i - 1], batch->x[i] = batch->x[i - 1], batch->y[i] = batch->y[i - 1];
    shader->picture->kernels->shade(batch);
    write_batch(shader, of, fragments);
    batch->count = of->count = 0;
}

/* Repeats the last fragment of a batch in the pixels after it, so that there are `length` of them. */
static void fill_batch(muj_batch *batch, int length)
{
    int32_t *face = batch->face + batch->count, *x = batch->x + batch->count, *y = batch->y + batch->count;
    for (int i = 1; i < length; i++)
        face[i] = face[0], x[i] = x[0] + i, y[i] = y[0];
}

/* Adds a run to batches, and shades those that are full. */
static void take_run(muj_shader *shader, const muj_run *run, parts *of, muj_fragments *fragments)
{
    muj_batch *batch = &shader->batch;
    for (int32_t done = 0; done < run->count;) {
        int32_t room = MUJ_BATCH - batch->count, left = run->count - done, length = left < room ? left : room;
        batch->face[batch->count] = run->face; /* most runs are one fragment */
        batch->x[batch->count] = run->x + done, batch->y[batch->count] = run->y;
        if (length > 1)
            fill_batch(batch, length);
        of->first[of->count] = run->first + done, of->length[of->count] = length;
        of->is_unlit[of->count++] = run->is_unlit;
        batch->count += length;
        done += length;
        if (batch->count == MUJ_BATCH)
            shade_batch(shader, of, fragments);
    }
}

static int reserve_results(const muj_batch *batch, muj_fragments *fragments)
{
    size_t count = (size_t)fragments->count;
    return e3d_array_reserve(&fragments->codes, count * (size_t)batch->passes, sizeof(uint32_t)) &&
           (!batch->needs_place || (e3d_array_reserve(&fragments->places, 3 * count, sizeof(float)) &&
                                    e3d_array_reserve(&fragments->shadowed, count, 1)));
}

int muj_shade_all(muj_shader *shader, muj_fragments *fragments)
{
    const muj_picture *picture = shader->picture;
    const chain *chains = shader->chains.data;
    const muj_run *runs = fragments->runs.data;
    muj_batch *batch = &shader->batch;
    parts of = {.count = 0};
    muj_light_faces(shader);
    batch->faces = shader->faces.data;
    batch->fog = picture->frame->has_fog ? &shader->fog : NULL;
    batch->bottom = picture->frame->height - 1 - shader->top;
    batch->passes = shader->lamps.passes;
    batch->needs_place = batch->passes > 1;
    batch->needs_alpha = batch->needs_place || shader->is_blending;
    batch->count = 0;
    fragments->passes = batch->passes;
    if (!reserve_results(batch, fragments))
        return 0;
    for (int32_t k = 0; k <= picture->frame->texture_count; k++) {
        batch->texture = k ? &picture->frame->textures[k - 1] : NULL;
        for (int32_t i = chains[k].first; i != MUJ_NONE; i = runs[i].next)
            take_run(shader, &runs[i], &of, fragments);
        shade_batch(shader, &of, fragments);
    }
    return 1;
}

void muj_free_shader(muj_shader *shader)
{
    e3d_array_free(&shader->faces);
    e3d_array_free(&shader->chains);
}

void muj_free_fragments(muj_fragments *fragments)
{
    e3d_array_free(&fragments->runs);
    e3d_array_free(&fragments->codes);
    e3d_array_free(&fragments->places);
    e3d_array_free(&fragments->shadowed);
}
