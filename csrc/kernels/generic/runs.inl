/* runs: finds neighbouring samples of a row with the same slot or ID, and spreads them over batches, a vector at a time. If a
 * whole row of blocks is noted, no sample is read: its eight rows are alike. */
#pragma once

#include "base/limits.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/raster.inl"
#include "kernels/generic/visible.inl"

/* Bit x is set if sample x differs from sample x + 1, or is the row's last. */
static inline uint64_t runs_ends(const int32_t *row, int width)
{
    uint64_t ends = 0;
    for (int x = 0; x < E3D_TILE; x += V_LANES) {
        vmask same = v_eqi(v_loadi(row + x), v_loadi(row + x + 1));
        ends |= (uint64_t)(v_bits(v_mnot(same))) << x;
    }
    uint64_t last = (uint64_t)1 << (width - 1);
    return (ends & (last - 1)) | last;
}

/* Bit b is set if all blocks in the row of block b are noted. */
static inline uint64_t runs_noted(uint64_t noted)
{
    for (int step = 1; step < VISIBLE_BLOCKS; step *= 2)
        noted &= noted >> step;
    return (noted & 0x0101010101010101) * 0xFF;
}

/* Finds the runs of a row of blocks that are all noted, whose eight rows are alike. */
static inline int runs_of_blocks(const int32_t *ids, int width, int rows, int sample, e3d_run *out, int32_t *owners)
{
    int count = 0;
    for (int x = 0, end; x < width; x = end) {
        int32_t id = ids[x / RASTER_BLOCK];
        for (end = x + RASTER_BLOCK; end < width && ids[end / RASTER_BLOCK] == id;)
            end += RASTER_BLOCK;
        int length = (end < width ? end : width) - x;
        out[count] = (e3d_run){id, (uint16_t)(sample + x), (uint16_t)length};
        count += id >= 0;
        *owners |= id;
    }
    for (int n = count; n < rows * count; n++) {
        out[n] = out[n - count];
        out[n].sample += E3D_TILE;
    }
    return rows * count;
}

/* Finds the runs of at most a block's rows. Their number is often mispredicted, so the ends of all rows are found first:
 * after a misprediction they are known already. Inside the spheres this takes 303 instead of 349 us a frame. */
static inline int runs_of_rows(const int32_t *row, int width, int rows, int sample, e3d_run *out, int32_t *owners)
{
    uint64_t ends_of[RASTER_BLOCK];
    int32_t all = 0;
    e3d_run *next = out;
    for (int y = 0; y < rows; y++)
        ends_of[y] = runs_ends(row + y * E3D_TILE, width);
    for (int y = 0; y < rows; y++, row += E3D_TILE, sample += E3D_TILE) {
        uint32_t first = (uint32_t)sample;
        for (uint64_t ends = ends_of[y]; ends; ends &= ends - 1) {
            size_t last = (size_t)__builtin_ctzll(ends);
            uint32_t end = (uint32_t)sample + (uint32_t)last + 1;
            int32_t owner = row[last];
            *next = (e3d_run){owner, (uint16_t)first, (uint16_t)(end - first)};
            next += owner >= 0;
            all |= owner;
            first = end;
        }
    }
    *owners |= all;
    return (int)(next - out);
}

static int kernel_find_runs(e3d_visible_tile *tile, int width, int height, e3d_run *out, int *gaps)
{
    uint64_t noted = runs_noted(tile->noted);
    int32_t owners = 0; /* the OR of all owners: its sign bit is set if there is a gap */
    int count = 0;
    for (uint64_t left = tile->noted & ~noted; left; left &= left - 1)
        visible_unfold_ids(tile, __builtin_ctzll(left));
    for (int y = 0; y < height; y += RASTER_BLOCK) {
        int block = y / RASTER_BLOCK * VISIBLE_BLOCKS, rows = height - y < RASTER_BLOCK ? height - y : RASTER_BLOCK, at = y * E3D_TILE;
        count += noted >> block & 1 ? runs_of_blocks(tile->noted_id + block, width, rows, at, out + count, &owners)
                                    : runs_of_rows(tile->id + at, width, rows, at, out + count, &owners);
    }
    *gaps = owners < 0;
    return count;
}

static inline void batch_pad(e3d_batch *batch, int count)
{
    for (int pad = 0; pad < E3D_PAD; pad += V_LANES) {
        v_storei(batch->sample + count + pad, v_seti(batch->sample[count - 1]));
        v_storei(batch->surface + count + pad, v_seti(batch->surface[count - 1]));
    }
    batch->count = count;
}

/* Spreads long runs one by one in whole vectors, which may reach beyond a run's end. */
static inline int runs_take_long(const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch)
{
    int n = batch->count, r = first;
    for (; r < first + count; r++) {
        int32_t run = shown->sample[r], length = run >> E3D_RUN_LENGTH;
        if (n + length > E3D_BATCH)
            break;
        vi32 at = v_addi(v_seti(run & (E3D_TILE_SAMPLES - 1)), v_iota()), surface = v_seti(shown->of[r] - primitive);
        for (int i = n; i < n + length; i += V_LANES, at = v_addi(at, v_seti(V_LANES))) {
            v_storei(batch->sample + i, at);
            v_storei(batch->surface + i, surface);
        }
        n += length;
    }
    batch_pad(batch, n);
    return r - first;
}

/* A run as one word, which all its samples share: its surface, and the distance from its place among the new samples to its
 * first sample. RUN_BEFORE keeps that positive. */
enum { RUN_SURFACE = 16,
       RUN_BEFORE = E3D_BATCH };

/* Writes `count` new samples from place `first` on, each vector once. Their words are the running sums of batch->steps, which
 * are reset to 0. */
static inline void runs_add_up(int first, int count, e3d_batch *batch)
{
    vi32 before = v_seti(0), last = v_seti(count - 1 - RUN_BEFORE), place = v_subi(v_iota(), v_seti(RUN_BEFORE));
    int end = (first + count + E3D_PAD - 1) / E3D_PAD * E3D_PAD - first;
    for (int i = 0; i < end; i += V_LANES, place = v_addi(place, v_seti(V_LANES))) {
        vi32 sums = v_sums(v_loadi(batch->steps + i)), word = v_addi(before, sums);
        before = v_addi(before, v_last(sums));
        v_storei(batch->steps + i, v_seti(0));
        v_storei(batch->sample + first + i, v_addi(v_andi(word, v_seti((1 << RUN_SURFACE) - 1)), v_mini(place, last)));
        v_storei(batch->surface + first + i, v_sra(word, RUN_SURFACE));
    }
}

/* Spreads short runs: at the place where a run begins, the difference to the word before is stored; then every vector is
 * written once. Overlapping stores would take longer: 2 % of the head with AVX2, 4 % with AVX-512. */
static inline int runs_take_short(const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch)
{
    int room = E3D_BATCH - batch->count, n = 0, r = first;
    int32_t before = 0;
    for (; r < first + count; r++) {
        int32_t run = shown->sample[r], length = run >> E3D_RUN_LENGTH;
        if (n + length > room)
            break;
        int32_t word = (shown->of[r] - primitive) * (1 << RUN_SURFACE) + (run & (E3D_TILE_SAMPLES - 1)) - n + RUN_BEFORE;
        batch->steps[n] = word - before;
        before = word;
        n += length;
    }
    if (n)
        runs_add_up(batch->count, n, batch);
    batch->count += n;
    return r - first;
}

/* A tile of at most so many runs has on average 32 samples a run or more: they are copied one by one */
enum { RUNS_LONG = 2 * E3D_TILE };

static int kernel_take_runs(const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch)
{
    return shown->count <= RUNS_LONG ? runs_take_long(shown, first, count, primitive, batch)
                                     : runs_take_short(shown, first, count, primitive, batch);
}
