/* Vertices, triangles and samples on vectors (R257, R258). */
#include "extras/mujoco/kernels/block.h"

#define MUJ_MAGIC 12582912.0f /* 1.5 * 2^23: adding it rounds a number below 2^22 to a whole one, in the low bits */
#define MUJ_MAGIC_BITS 0x4B400000

static ALWAYS_INLINE vf32 vertex_row(const muj_projection *projection, int r, const vf32 at[3])
{
    vf32 sum = v_add(v_mul(v_setf(projection->column[0][r]), at[0]), v_mul(v_setf(projection->column[1][r]), at[1]));
    return v_add(sum, v_add(v_mul(v_setf(projection->column[2][r]), at[2]), v_setf(projection->column[3][r])));
}

static ALWAYS_INLINE vmask clip_side(const float clip[4], const vf32 at[3])
{
    vf32 sum = v_add(v_mul(v_setf(clip[0]), at[0]), v_mul(v_setf(clip[1]), at[1]));
    return v_ge(v_add(sum, v_add(v_mul(v_setf(clip[2]), at[2]), v_setf(clip[3]))), v_setf(0));
}

static ALWAYS_INLINE vmask within(vf32 v, float most)
{
    return v_mand(v_gt(v, v_setf(-most)), v_lt(v, v_setf(most)));
}

static ALWAYS_INLINE vi32 snapped(vf32 v) { return v_subi(v_asi(v_add(v, v_setf(MUJ_MAGIC))), v_seti(MUJ_MAGIC_BITS)); }

/* Loads threes of words, from number `first` on; of those from `count` on the last one. A row of eight words is loaded for each
 * where there are as many. */
static ALWAYS_INLINE void load_threes(const void *threes, int32_t first, int32_t count, vi32 out[3])
{
    const char *from = (const char *)threes + 12 * (size_t)first;
    if (first + V_LANES + 2 <= count) {
        const void *row[V_LANES];
        vi32 word[8];
        for (int l = 0; l < V_LANES; l++)
            row[l] = from + 12 * l;
        v_load_rows(row, word);
        memcpy(out, word, 3 * sizeof *out);
        return;
    }
    vi32 place = v_muli(v_mini(v_iota(), v_seti(count - 1 - first)), v_seti(3));
    for (int k = 0; k < 3; k++)
        out[k] = v_gatheri(from + 4 * k, place);
}

static void kernel_transform(const muj_projection *projection, const float *positions, int32_t count, const muj_vertices *out)
{
    for (int32_t i = 0; i < count; i += V_LANES) {
        vi32 words[3];
        vf32 at[3], inverse, place[3];
        for (int k = 0; k < 3; k++)
            __builtin_prefetch(positions + 3 * (size_t)i + 256 + k * V_LANES);
        load_threes(positions, i, count, words);
        for (int c = 0; c < 3; c++)
            at[c] = v_asf(words[c]);
        vf32 w = vertex_row(projection, 3, at);
        inverse = v_div(v_setf(1), w);
        for (int c = 0; c < 3; c++)
            place[c] = v_mul(vertex_row(projection, c, at), inverse);
        vmask inside = v_mand(v_gt(w, v_setf(0)), v_ge(v_setf(1), place[2]));
        inside = v_mand(inside, v_mand(within(place[0], projection->most), within(place[1], projection->most)));
        if (projection->has_clip)
            inside = v_mand(inside, clip_side(projection->clip, at));
        v_storef(out->x + i, place[0]);
        v_storef(out->y + i, place[1]);
        v_storef(out->z + i, place[2]);
        v_store_pairs(out->snapped + i, v_seli(inside, snapped(place[0]), v_seti(MUJ_OUTSIDE)), v_seli(inside, snapped(place[1]), v_seti(0)));
    }
}

/* The box of triangles along an axis, in 1/256 pixel. */
typedef struct boxes {
    vi32 low, high;
} boxes;

static ALWAYS_INLINE boxes boxes_of(const vi32 v[3])
{
    return (boxes){v_mini(v_mini(v[0], v[1]), v[2]), v_maxi(v_maxi(v[0], v[1]), v[2])};
}

/* The pixels whose sample, `at` 1/256 pixel from where they begin, lies in the boxes. */
static ALWAYS_INLINE boxes pixels_in(boxes in, int32_t at)
{
    return (boxes){v_sra(v_addi(in.low, v_seti(255 - at)), 8), v_sra(v_subi(in.high, v_seti(at)), 8)};
}

/* Whether none of them counts. */
static ALWAYS_INLINE vmask none_of(const muj_choice *choice, int axis, boxes in)
{
    return v_gti(v_maxi(in.low, v_seti(choice->low[axis])), v_mini(in.high, v_seti(choice->high[axis])));
}

/* The triangles that don't have a point inside or on an edge. They are small. */
static ALWAYS_INLINE vmask excludes(const vi32 x[3], const vi32 y[3], vi32 px, vi32 py)
{
    vi32 all = v_seti(0), none = v_seti(0);
    for (int k = 0; k < 3; k++) {
        int q = (k + 1) % 3;
        vi32 edge = v_subi(v_muli(v_subi(x[q], x[k]), v_subi(py, y[k])), v_muli(v_subi(y[q], y[k]), v_subi(px, x[k])));
        all = v_ori(all, edge), none = v_ori(none, v_subi(v_seti(0), edge));
    }
    return v_mand(v_negi(all), v_negi(none));
}

/* The triangles that surely cover no sample number `s`: of those with one of them in their box, the edges tell. */
static ALWAYS_INLINE vmask misses(const muj_choice *choice, int s, const vi32 x[3], const vi32 y[3])
{
    boxes columns = pixels_in(boxes_of(x), choice->at[0][s]), rows = pixels_in(boxes_of(y), choice->at[1][s]);
    vmask one = v_mand(v_eqi(columns.low, columns.high), v_eqi(rows.low, rows.high));
    vi32 px = v_addi(v_shl(columns.low, 8), v_seti(choice->at[0][s])), py = v_addi(v_shl(rows.low, 8), v_seti(choice->at[1][s]));
    return v_mor(v_mor(none_of(choice, 0, columns), none_of(choice, 1, rows)), v_mand(one, excludes(x, y, px, py)));
}

/* The triangles that surely show the side that is culled: rounding errors don't change the sign of their area. */
static ALWAYS_INLINE vmask turned_away(int32_t facing, const vi32 x[3], const vi32 y[3])
{
    vf32 one = v_mul(v_float(v_subi(x[1], x[0])), v_float(v_subi(y[2], y[0])));
    vf32 other = v_mul(v_float(v_subi(x[2], x[0])), v_float(v_subi(y[1], y[0])));
    vf32 zero = v_setf(0), area = v_sub(one, other);
    vf32 error = v_mul(v_add(v_max(one, v_sub(zero, one)), v_max(other, v_sub(zero, other))), v_setf(0x1p-22f));
    return facing > 0 ? v_gt(area, error) : v_lt(area, v_sub(zero, error));
}

static ALWAYS_INLINE void load_snapped(const muj_vertices *vertices, vi32 number, vi32 *x, vi32 *y)
{
    int32_t at[V_LANES];
    vf32 first, second;
    v_storei(at, v_shl(number, 1));
    v_load_pairs((const float *)vertices->snapped, at, &first, &second);
    *x = v_asi(first), *y = v_asi(second);
}

static int32_t kernel_choose(const muj_choice *choice, const muj_vertices *vertices, const int32_t *corners, int32_t first, int32_t end,
                             int32_t *out)
{
    int32_t count = 0;
    for (int32_t t = first; t < end; t += V_LANES) {
        vi32 number = v_addi(v_seti(t), v_iota()), corner[3], x[3], y[3];
        vmask outside = v_gti(v_seti(0), v_seti(0)), shows = v_gti(v_seti(end), number);
        load_threes(corners, t, end, corner);
        for (int k = 0; k < 3; k++) {
            load_snapped(vertices, corner[k], &x[k], &y[k]);
            outside = v_mor(outside, v_eqi(x[k], v_seti(MUJ_OUTSIDE)));
        }
        if (choice->facing)
            shows = v_mand(shows, v_mor(outside, v_mnot(turned_away(choice->facing, x, y))));
        if (!v_any(shows))
            continue;
        vmask hidden = misses(choice, 0, x, y);
        for (int s = 1; s < choice->samples; s++)
            hidden = v_mand(hidden, misses(choice, s, x, y));
        shows = v_mand(shows, v_mor(outside, v_mnot(hidden)));
        count += v_pack(out + count, number, v_bits(shows));
    }
    return count;
}

/* ---- samples ---- */

/* A vector has the samples of GROUPS groups; with one lane, the samples of a group are PIECES vectors. */
enum { GROUPS = V_LANES < 4 ? 1 : V_LANES / 4,
       PIECES = V_LANES < 4 ? 4 / V_LANES : 1,
       SMALL = 32 };

/* Where the samples of a piece are in the first group, in 1/256 pixel, and in pixels. */
typedef struct lane_places {
    vi32 x, y;
    vf64 px[V_HALVES], py[V_HALVES];
} lane_places;

/* A record in rows of groups: edges and depths at the samples of a piece of the first groups. */
typedef struct sample_planes {
    vi32 edge[3];
    int32_t across[3], down[3];     /* for a group, for a row */
    vf32 z;
    float z_across, z_down;
} sample_planes;

static ALWAYS_INLINE vi32 four_repeated(const void *four, int piece)
{
    int32_t all[V_LANES], from[4];
    memcpy(from, four, sizeof from);
    for (int l = 0; l < V_LANES; l++)
        all[l] = from[(l + piece * V_LANES) & 3];
    return v_loadi(all);
}

static ALWAYS_INLINE void set_places(const muj_raster *raster, lane_places out[PIECES])
{
    for (int piece = 0; piece < PIECES; piece++) {
        out[piece].x = four_repeated(raster->lane_x, piece), out[piece].y = four_repeated(raster->lane_y, piece);
        for (int h = 0; h < V_HALVES; h++) {
            out[piece].px[h] = v_muld(v_wideni(out[piece].x, h), v_setd(1.0 / MUJ_SUB));
            out[piece].py[h] = v_muld(v_wideni(out[piece].y, h), v_setd(1.0 / MUJ_SUB));
        }
    }
}

/* Draws where samples in `inside` are not hidden. */
static ALWAYS_INLINE void draw_samples(vf32 z, vmask inside, int32_t number, float *depth, int32_t *shown)
{
    vf32 before = v_loadf(depth);
    vmask seen = v_mand(v_mand(v_ge(z, before), v_ge(v_setf(1), z)), inside);
    if (!v_any(seen))
        return;
    v_storef(depth, v_self(seen, z, before));
    v_storei(shown, v_seli(seen, v_seti(number), v_loadi(shown)));
}

/* Draws rows of groups of a piece, of which all samples are inside. */
static ALWAYS_INLINE void draw_whole_rows(const sample_planes *in, int32_t rows, int32_t groups, int32_t number, float *depth, int32_t *shown,
                                          size_t stride)
{
    vi32 group = v_sra(v_iota(), 2);
    for (int32_t y = 0; y < rows; y++, depth += stride, shown += stride) {
        vf32 z_row = v_add(in->z, v_setf(in->z_down * (float)y));
        for (int32_t i = 0; i < groups; i += GROUPS) {
            vf32 z = v_add(z_row, v_mul(v_setf(in->z_across), v_float(v_addi(v_seti(i), group))));
            draw_samples(z, v_gti(v_seti(groups - i), group), number, depth + 4 * i, shown + 4 * i);
        }
    }
}

/* Draws rows of groups of a piece. */
static ALWAYS_INLINE void draw_rows(const sample_planes *in, int32_t rows, int32_t groups, int32_t number, float *depth, int32_t *shown,
                                    size_t stride)
{
    vi32 group = v_sra(v_iota(), 2), first[3];
    for (int k = 0; k < 3; k++)
        first[k] = v_addi(in->edge[k], v_muli(v_seti(in->across[k]), group));
    for (int32_t y = 0; y < rows; y++, depth += stride, shown += stride) {
        vi32 edge[3];
        vf32 z_row = v_add(in->z, v_setf(in->z_down * (float)y));
        for (int k = 0; k < 3; k++)
            edge[k] = v_addi(first[k], v_seti(in->down[k] * y));
        for (int32_t i = 0; i < groups; i += GROUPS) {
            vi32 all = v_ori(v_ori(edge[0], edge[1]), edge[2]);
            if (GROUPS > 1)
                all = v_ori(all, v_subi(v_seti(groups - 1 - i), group));
            vmask inside = v_mnot(v_negi(all));
            for (int k = 0; k < 3; k++)
                edge[k] = v_addi(edge[k], v_seti(in->across[k] * GROUPS));
            if (!v_any(inside))
                continue;
            vf32 z = v_add(z_row, v_mul(v_setf(in->z_across), v_float(v_addi(v_seti(i), group))));
            draw_samples(z, inside, number, depth + 4 * i, shown + 4 * i);
        }
    }
}

/* Draws a record of which all edges fit 32 bits, at once. */
static ALWAYS_INLINE void draw_small(const muj_raster *raster, const muj_record *record, int32_t number, const lane_places *places, int32_t top,
                                     int32_t bottom)
{
    int32_t pixels = raster->group_pixels, first = record->x0 / pixels, groups = record->x1 / pixels - first + 1;
    int32_t dx = first * pixels - record->x0, dy = top - record->y0;
    size_t at = (size_t)(top - raster->top) * raster->stride + 4 * (size_t)first;
    double z = record->z + (record->zx * (double)dx + record->zy * (double)dy);
    sample_planes in = {.z_across = (float)(record->zx * pixels), .z_down = (float)record->zy};
    for (int piece = 0; piece < PIECES; piece++) {
        vf64 half[V_HALVES];
        for (int k = 0; k < 3; k++) {
            int32_t a = record->a[k], b = record->b[k], e = (int32_t)record->e[k] + MUJ_SUB * (a * dx + b * dy);
            vi32 slope = v_addi(v_muli(v_seti(a), places[piece].x), v_muli(v_seti(b), places[piece].y));
            in.edge[k] = v_sra(v_addi(v_seti(e), slope), 8);
            in.across[k] = a * pixels, in.down[k] = b;
        }
        for (int h = 0; h < V_HALVES; h++)
            half[h] = v_addd(v_setd(z), v_addd(v_muld(v_setd(record->zx), places[piece].px[h]), v_muld(v_setd(record->zy), places[piece].py[h])));
        in.z = v_narrow(half);
        draw_rows(&in, bottom - top + 1, groups, number, raster->depth + at + piece * V_LANES, raster->shown + at + piece * V_LANES, raster->stride);
    }
}

static void draw_large(const muj_raster *raster, const muj_record *record, int32_t number, int32_t top, int32_t bottom)
{
    int32_t pixels = raster->group_pixels;
    muj_block block;
    for (int32_t left = record->x0 / pixels * pixels; left <= record->x1; left += MUJ_BLOCK) {
        int32_t right = left + MUJ_BLOCK - 1 < record->x1 ? left + MUJ_BLOCK - 1 : record->x1;
        right = right / pixels * pixels + pixels - 1; /* whole groups */
        if (!muj_begin_block(raster, record, left, top, right, bottom, &block))
            continue;
        size_t at = (size_t)(top - raster->top) * raster->stride + 4 * (size_t)(left / pixels);
        sample_planes in = {.z_across = block.z_across, .z_down = block.z_down};
        memcpy(in.across, block.across, sizeof in.across);
        memcpy(in.down, block.down, sizeof in.down);
        for (int piece = 0; piece < PIECES; piece++, at += V_LANES) {
            in.z = v_asf(four_repeated(block.z, piece));
            for (int k = 0; k < 3; k++)
                in.edge[k] = four_repeated(block.edge[k], piece);
            (block.is_inside ? draw_whole_rows : draw_rows)(&in, bottom - top + 1, (right - left + 1) / pixels, number, raster->depth + at,
                                                            raster->shown + at, raster->stride);
        }
    }
}

static void kernel_draw(const muj_raster *raster, muj_record *const *records, const int32_t *numbers, int32_t count)
{
    lane_places places[PIECES];
    set_places(raster, places);
    for (int32_t i = 0; i < count; i++) {
        const muj_record *record = records[numbers[i]];
        int32_t top = record->y0 > raster->top ? record->y0 : raster->top, bottom = record->y1 < raster->end ? record->y1 : raster->end - 1;
        if (record->x1 - record->x0 < SMALL && record->y1 - record->y0 < SMALL && muj_is_narrow(record))
            draw_small(raster, record, numbers[i], places, top, bottom);
        else
            draw_large(raster, record, numbers[i], top, bottom);
    }
}

/* ---- shadows ---- */

static int32_t kernel_cover(const muj_shadow_test *test, const muj_lookups *lookups, int32_t first, int32_t end, int32_t *out)
{
    int32_t count = 0;
    for (int32_t i = first; i < end; i += V_LANES) {
        vi32 number = v_addi(v_seti(i), v_iota()), x = v_loadi(lookups->x + i), y = v_loadi(lookups->y + i);
        vi32 right = v_subi(v_seti(test->high[0]), x), below = v_subi(v_seti(test->high[1]), y);
        x = v_subi(x, v_seti(test->low[0])), y = v_subi(y, v_seti(test->low[1]));
        vi32 outside = v_ori(v_ori(x, y), v_ori(right, below));
        outside = v_ori(outside, v_subi(v_seti(test->bound), v_loadi(lookups->step + i)));
        outside = v_ori(outside, v_subi(v_seti(end - 1), number));
        if (!v_any(v_mnot(v_negi(outside))))
            continue;
        for (int k = 0; k < 3; k++) {
            vi32 slope = v_addi(v_muli(v_seti(test->across[k]), x), v_muli(v_seti(test->down[k]), y));
            outside = v_ori(outside, v_addi(v_seti(test->edge[k]), slope));
        }
        count += v_pack(out + count, number, v_bits(v_mnot(v_negi(outside))));
    }
    return count;
}
