/* runs: neighbouring samples of a row that show the same slot, found and spread out again a vector at a time. */

/* Bit x: sample x differs from sample x + 1, or is the row's last. */
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

static int kernel_find_runs(const int32_t *slot, int width, int height, e3d_run *out)
{
    int count = 0;
    for (int y = 0; y < height; y++) {
        const int32_t *row = slot + y * E3D_TILE;
        int first = 0;
        for (uint64_t ends = runs_ends(row, width); ends; ends &= ends - 1) {
            int last = __builtin_ctzll(ends);
            out[count] = (e3d_run){row[first], (uint16_t)(y * E3D_TILE + first),
                                   (uint16_t)(last - first + 1)};
            count += row[first] >= 0;
            first = last + 1;
        }
    }
    return count;
}

/* Whole vectors are written past the end of a run. */
static inline void runs_spread(const e3d_run *run, vi32 owner, int32_t *sample, int32_t *owners)
{
    vi32 at = v_addi(v_seti(run->sample), v_iota());
    for (int i = 0; i < run->length; i += V_LANES) {
        v_storei(sample + i, at);
        v_storei(owners + i, owner);
        at = v_addi(at, v_seti(V_LANES));
    }
}

static inline void batch_pad(e3d_batch *batch, int count)
{
    for (int pad = 0; pad < E3D_PAD; pad += V_LANES) {
        v_storei(batch->sample + count + pad, v_seti(batch->sample[count - 1]));
        v_storei(batch->surface + count + pad, v_seti(batch->surface[count - 1]));
    }
    batch->count = count;
}

static int kernel_take_runs(const e3d_run *runs, int count, int32_t piece, e3d_batch *batch)
{
    int n = batch->count, r = 0;
    for (; r < count && n + runs[r].length <= E3D_BATCH; r++) {
        runs_spread(&runs[r], v_seti(runs[r].owner - piece), batch->sample + n, batch->surface + n);
        n += runs[r].length;
    }
    batch_pad(batch, n);
    return r;
}
