/* setup: which triangles of a cluster may show (R4-R7, R9, R10), a vector of triangles at a time.
 *
 * Conservative where 32 bits do not hold the area: such a triangle stays, and pipeline/setup.c decides.
 */

static inline vi32 setup_fetch(const int32_t *table, const uint8_t *indices, int i)
{
    return v_gatheri(table, v_loadu8(indices + i));
}

/* First and last sample of each lane's box along one axis (R10). */
typedef struct setup_span {
    vi32 first, last;
} setup_span;

static inline setup_span setup_samples(vi32 lo, vi32 hi, int32_t size)
{
    return (setup_span){v_maxi(v_sra(v_addi(lo, v_seti(127)), 8), v_seti(0)),
                        v_mini(v_sra(v_subi(hi, v_seti(128)), 8), v_seti(size - 1))};
}

/* Lanes with at most two samples along the axis: few enough to try each. */
static inline vmask setup_short(setup_span s)
{
    return v_mnot(v_gti(v_subi(s.last, s.first), v_seti(1)));
}

/* Edge function k (R12) at a sample, at least 0 inside: `sign` is all ones where the winding is the other way. */
typedef struct setup_edge {
    vi32 a, b, c;
} setup_edge;

static inline setup_edge setup_edge_of(const vi32 x[3], const vi32 y[3], int k, vi32 sign, vi32 x0, vi32 y0)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    vi32 zero = v_seti(0), one = v_seti(1);
    setup_edge e = {v_subi(y[i], y[j]), v_subi(x[j], x[i]), zero};
    e.a = v_subi(v_xori(e.a, sign), sign);
    e.b = v_subi(v_xori(e.b, sign), sign);
    vmask top_left = v_mor(v_gti(e.a, zero), v_mand(v_eqi(e.a, zero), v_gti(e.b, zero)));
    vi32 value = v_addi(v_muli(e.a, v_subi(x0, x[i])), v_muli(e.b, v_subi(y0, y[i])));
    e.c = v_subi(value, v_seli(top_left, zero, one));
    return e;
}

/* Lanes, of those with at most 2 x 2 samples, that cover none of them. */
static inline vmask setup_uncovered(const vi32 x[3], const vi32 y[3], vi32 area, setup_span across,
                                    setup_span down)
{
    vi32 half = v_seti(128), sign = v_sra(area, 31), outside[4];
    vi32 x0 = v_addi(v_shl(across.first, 8), half), y0 = v_addi(v_shl(down.first, 8), half);
    vi32 dx = v_shl(v_subi(across.last, across.first), 8), dy = v_shl(v_subi(down.last, down.first), 8);
    for (int k = 0; k < 3; k++) {
        setup_edge e = setup_edge_of(x, y, k, sign, x0, y0);
        vi32 step_x = v_muli(e.a, dx), step_y = v_muli(e.b, dy), below = v_addi(e.c, step_y);
        const vi32 at[4] = {e.c, v_addi(e.c, step_x), below, v_addi(below, step_x)};
        for (int s = 0; s < 4; s++)
            outside[s] = k ? v_ori(outside[s], at[s]) : at[s];
    }
    vi32 none = v_andi(v_andi(outside[0], outside[1]), v_andi(outside[2], outside[3]));
    return v_mand(v_negi(none), v_mand(setup_short(across), setup_short(down)));
}

static inline vi32 setup_min3(vi32 a, vi32 b, vi32 c) { return v_mini(v_mini(a, b), c); }
static inline vi32 setup_max3(vi32 a, vi32 b, vi32 c) { return v_maxi(v_maxi(a, b), c); }

static inline vi32 setup_area(const vi32 x[3], const vi32 y[3])
{
    return v_subi(v_muli(v_subi(x[1], x[0]), v_subi(y[2], y[0])),
                  v_muli(v_subi(x[2], x[0]), v_subi(y[1], y[0])));
}

/* Lanes that face the wrong way or have no area. */
static inline vmask setup_culled(vi32 area, int cull)
{
    vmask drop = v_eqi(area, v_seti(0));
    if (cull < 0)
        drop = v_mor(drop, v_negi(area));
    if (cull > 0)
        drop = v_mor(drop, v_gti(area, v_seti(0)));
    return drop;
}

/* Lanes that cannot show: no sample in the box, and where 32 bits hold the area, facing and exact coverage. */
static inline vmask setup_misses(const vi32 x[3], const vi32 y[3], int cull, const e3d_viewport *viewport)
{
    vi32 xlo = setup_min3(x[0], x[1], x[2]), xhi = setup_max3(x[0], x[1], x[2]);
    vi32 ylo = setup_min3(y[0], y[1], y[2]), yhi = setup_max3(y[0], y[1], y[2]);
    setup_span across = setup_samples(xlo, xhi, viewport->width);
    setup_span down = setup_samples(ylo, yhi, viewport->height);
    vmask empty = v_mor(v_gti(across.first, across.last), v_gti(down.first, down.last));
    vmask wide = v_gti(v_maxi(v_subi(xhi, xlo), v_subi(yhi, ylo)), v_seti(32767));
    vi32 area = setup_area(x, y);
    vmask drop = v_mor(setup_culled(area, cull), setup_uncovered(x, y, area, across, down));
    return v_mor(empty, v_mandnot(drop, wide));
}

static inline int setup_append(uint8_t *list, int count, uint32_t bits, int first)
{
    for (; bits; bits &= bits - 1)
        list[count++] = (uint8_t)(first + __builtin_ctz(bits));
    return count;
}

static void kernel_setup(const e3d_vertices *v, const uint8_t *indices, int triangles, int cull,
                         const e3d_viewport *viewport, e3d_survivors *out)
{
    int draws = 0, clips = 0;
    for (int i = 0; i < triangles; i += V_LANES) {
        vi32 code[3], x[3], y[3];
        for (int k = 0; k < 3; k++) {
            const uint8_t *plane = indices + k * E3D_CLUSTER_TRIANGLES;
            code[k] = setup_fetch(v->code, plane, i);
            x[k] = setup_fetch(v->sx, plane, i);
            y[k] = setup_fetch(v->sy, plane, i);
        }
        vi32 any = v_ori(v_ori(code[0], code[1]), code[2]);
        vi32 all = v_andi(v_andi(code[0], code[1]), code[2]);
        vi32 zero = v_seti(0);
        vmask keep = v_mand(v_eqi(v_andi(all, v_seti(E3D_OUTSIDE)), zero),
                            v_eqi(v_andi(any, v_seti(E3D_NONFINITE)), zero));
        vmask whole = v_eqi(v_andi(any, v_seti(E3D_CLIP)), zero);
        vmask miss = setup_misses(x, y, cull, viewport);
        miss = v_mor(miss, v_mnot(v_eqi(v_andi(any, v_seti(E3D_BAD_SCREEN)), zero)));
        uint32_t tail = triangles - i >= V_LANES ? ~0u : (1u << (triangles - i)) - 1;
        draws = setup_append(out->draw, draws, v_bits(v_mandnot(v_mand(keep, whole), miss)) & tail, i);
        clips = setup_append(out->clip, clips, v_bits(v_mandnot(keep, whole)) & tail, i);
    }
    out->draws = draws;
    out->clips = clips;
}
