/* shade: finds the IDs of visible samples if little else is asked for, run by run, without surfaces, buckets or batches (R35).
 * In: runs of samples, and the IDs that own them.
 * Out: the outputs of IDs, in the tile's gathered outputs. */
#include <string.h>

#include "base/limits.h"
#include "base/vectors.h"
#include "e3d.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/shade/identities.h"
#include "frame/store/outputs.h"
#include "frame/store/store.h"

/* ---- what owners are ---- */

enum { SOME = 256 };
_Static_assert(SOME >= (int)E3D_MOST_COVERING, "all primitives of spans are looked up at once");

/* Owners of runs: their IDs, and the primitives that these stand for. */
typedef struct owners {
    int32_t count;
    uint32_t id[SOME];
    int32_t primitive[SOME], instance[SOME]; /* the primitive's number in its mesh, the instance's in its draw */
    const e3d_draw_state *draw[SOME];
} owners;

/* Finds the primitives of all owners. (Prefetching records, or separating them from fragments, takes longer: 7 to 12 % of a
 * frame of small triangles.) */
static void find_primitives(const e3d_shade_in *in, e3d_instance_finder *finder, owners *out)
{
    const e3d_draws *draws = in->pass->draws;
    for (int32_t n = 0; n < out->count; n++) {
        uint32_t id = out->id[n];
        int32_t triangle;
        if (id & E3D_FRAGMENT_ID) {
            const e3d_drawn_cluster *drawn = e3d_drawn_at(in->table, id, &triangle);
            out->primitive[n] = e3d_find_face(draws, drawn, triangle, finder);
        } else {
            out->primitive[n] = e3d_find_primitive(draws, e3d_record_at(in->table, id)->order, finder);
        }
        out->instance[n] = finder->instance;
        out->draw[n] = finder->draw;
    }
}

/* ---- what is written of them ---- */

static const e3d_output_kind IDENTITIES[] = {E3D_OUTPUT_FACE_ID, E3D_OUTPUT_OBJECT_ID, E3D_OUTPUT_INSTANCE_ID, E3D_OUTPUT_MATERIAL_ID};
enum { KINDS = sizeof IDENTITIES / sizeof *IDENTITIES,
       NOTHING = -1 };

static void find_values(const e3d_frame *frame, e3d_output_kind kind, const owners *of, int32_t *values)
{
    for (int32_t n = 0; n < of->count && kind == E3D_OUTPUT_FACE_ID; n++)
        values[n] = e3d_face_of(of->draw[n], of->primitive[n]);
    for (int32_t n = 0; n < of->count && kind == E3D_OUTPUT_OBJECT_ID; n++)
        values[n] = e3d_object_id(of->draw[n]->draw, of->instance[n]);
    for (int32_t n = 0; n < of->count && kind == E3D_OUTPUT_INSTANCE_ID; n++)
        values[n] = e3d_instance_id(of->draw[n]->draw, of->instance[n]);
    for (int32_t n = 0; n < of->count && kind == E3D_OUTPUT_MATERIAL_ID; n++)
        values[n] = e3d_material_at(frame, of->draw[n], of->primitive[n])->id;
}

/* ---- samples to pixels ---- */

static int64_t count_samples(const e3d_run *runs, int32_t count)
{
    int64_t samples = 0;
    for (int32_t r = 0; r < count; r++)
        samples += runs[r].length;
    return samples;
}

/* The first pixel of a row whose middle sample is at sample x or behind it. */
static int32_t first_pixel(int32_t x, int32_t axis) { return (x + axis - 1 - axis / 2) / axis; }

/* The pixels whose middle samples are in a run; there may be none. */
static e3d_run pixels_of(e3d_run run, int32_t axis)
{
    int32_t x = run.sample % E3D_TILE, y = run.sample / E3D_TILE;
    if (axis == 1)
        return run;
    if (y % axis != axis / 2)
        return (e3d_run){run.owner, 0, 0};
    int32_t first = first_pixel(x, axis), end = first_pixel(x + run.length, axis);
    return (e3d_run){run.owner, (uint16_t)(y / axis * E3D_TILE + first), (uint16_t)(end - first)};
}

/* Turns runs of samples into runs of pixels, which are as many or fewer; returns how many. */
static int32_t reduce(e3d_run *runs, int32_t count, int32_t axis)
{
    int32_t left = 0;
    if (axis == 1)
        return count;
    for (int32_t r = 0; r < count; r++) {
        runs[left] = pixels_of(runs[r], axis);
        left += runs[left].length > 0;
    }
    return left;
}

/* ---- pixels ---- */

static void fill(int32_t *pixels, int32_t first, int32_t end, int32_t value)
{
    for (int32_t i = first; i < end; i++)
        pixels[i] = value;
}

/* Writes runs that follow each other from pixel `end` on, and the background between them; returns where the last one ends. The
 * length of a run is unpredictable, so whole vectors are written beyond its end, and the next run overwrites them. */
static int32_t write_in_order(const e3d_run *runs, int32_t count, const int32_t *values, int32_t end, int32_t *pixels)
{
    for (int32_t r = 0; r < count; r++) {
        int32_t first = runs[r].sample;
        int4 value = {values[r], values[r], values[r], values[r]};
        if (first > end)
            fill(pixels, end, first, NOTHING);
        end = first + runs[r].length;
        memcpy(pixels + first, &value, sizeof value);
        memcpy(pixels + first + 4, &value, sizeof value);
        for (int32_t i = first + 8; i < end; i += 4)
            memcpy(pixels + i, &value, sizeof value);
    }
    return end;
}
_Static_assert(E3D_PAD >= 7, "the last run of a tile may be written so far past its end");

/* Writes the pixels of some runs, in order, to all outputs that are asked for; returns where the last run ends. */
static int32_t write_outputs(const e3d_shade_in *in, const e3d_run *runs, const owners *of, int32_t before, const e3d_shade_out *out)
{
    int32_t end = before, values[SOME];
    for (int k = 0; k < KINDS; k++) {
        int32_t *pixels = e3d_outputs_gathered(in->store, out->pixels, IDENTITIES[k]);
        if (!pixels)
            continue;
        find_values(in->pass->frame, IDENTITIES[k], of, values);
        end = write_in_order(runs, of->count, values, before, pixels);
    }
    return end;
}

void e3d_identify_runs(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, const e3d_shade_out *out)
{
    e3d_run *runs = out->memory->runs.rows;
    int32_t axis = in->pass->frame->samples_axis, end = 0;
    e3d_instance_finder finder = {0};
    owners of;
    out->memory->shaded += count_samples(runs, count);
    count = reduce(runs, count, axis);
    for (int32_t first = 0; first < count; first += SOME) {
        of.count = count - first < SOME ? count - first : SOME;
        for (int32_t n = 0; n < of.count; n++)
            of.id[n] = (uint32_t)runs[first + n].owner;
        find_primitives(in, &finder, &of);
        end = write_outputs(in, runs + first, &of, end, out);
    }
    for (int k = 0; k < KINDS; k++) {
        int32_t *pixels = e3d_outputs_gathered(in->store, out->pixels, IDENTITIES[k]);
        if (pixels)
            fill(pixels, end, tile->height / axis * E3D_TILE, NOTHING);
    }
}

/* ---- lists of what shows ---- */

/* Run r of a list; its owner isn't set. */
static e3d_run run_of(const e3d_shown *shown, int32_t r)
{
    int32_t run = shown->sample[r];
    return (e3d_run){E3D_NO_SLOT, (uint16_t)(run & (E3D_TILE_SAMPLES - 1)), (uint16_t)(run >> E3D_RUN_LENGTH)};
}

void e3d_identify_shown(const e3d_shade_in *in, const e3d_shade_out *out)
{
    const e3d_shown *shown = &out->memory->shown;
    e3d_instance_finder finder = {0};
    int32_t axis = in->pass->frame->samples_axis, values[SOME];
    owners of = {.count = shown->primitives};
    for (int32_t n = 0; n < of.count; n++)
        of.id[n] = shown->primitive[n].id;
    find_primitives(in, &finder, &of);
    for (int k = 0; k < KINDS; k++) {
        int32_t *pixels = e3d_outputs_gathered(in->store, out->pixels, IDENTITIES[k]);
        if (!pixels)
            continue;
        find_values(in->pass->frame, IDENTITIES[k], &of, values);
        for (int32_t r = 0; r < shown->count; r++) {
            e3d_run at = pixels_of(run_of(shown, r), axis);
            fill(pixels, at.sample, at.sample + at.length, values[shown->of[r]]);
        }
    }
    for (int32_t r = 0; r < shown->count; r++)
        out->memory->shaded += run_of(shown, r).length;
}
