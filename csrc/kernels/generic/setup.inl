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

/* Lanes with at most so many samples along one axis. */
static inline vmask setup_narrow(setup_span s, int32_t samples)
{
    return v_mnot(v_gti(v_subi(s.last, s.first), v_seti(samples - 1)));
}

/* Lanes that cannot show: no sample in the box, or the wrong facing where 32 bits hold the area; and those that are small. */
typedef struct setup_boxes {
    vmask miss, small;
} setup_boxes;

static inline setup_boxes setup_boxes_of(const vi32 x[3], const vi32 y[3], int cull, const e3d_viewport *viewport)
{
    vi32 xlo = setup_min3(x[0], x[1], x[2]), xhi = setup_max3(x[0], x[1], x[2]);
    vi32 ylo = setup_min3(y[0], y[1], y[2]), yhi = setup_max3(y[0], y[1], y[2]);
    setup_span across = setup_samples(xlo, xhi, viewport->width);
    setup_span down = setup_samples(ylo, yhi, viewport->height);
    vmask empty = v_mor(v_gti(across.first, across.last), v_gti(down.first, down.last));
    vi32 size = v_maxi(v_subi(xhi, xlo), v_subi(yhi, ylo));
    vmask wide = v_gti(size, v_seti(32767)), large = v_gti(size, v_seti(E3D_SMALL_REACH));
    vmask narrow = v_mand(setup_narrow(across, E3D_SMALL), setup_narrow(down, E3D_SMALL));
    return (setup_boxes){v_mor(empty, v_mandnot(setup_culled(setup_area(x, y), cull), wide)), v_mandnot(narrow, large)};
}

static inline int setup_append(uint8_t *list, int count, uint32_t bits, int first)
{
    for (; bits; bits &= bits - 1)
        list[count++] = (uint8_t)(first + __builtin_ctz(bits));
    return count;
}

/* Lanes that are drawn as they are, or clipped, as far as outcodes tell (R4-R7). */
typedef struct setup_fate {
    vmask draw, clip;
} setup_fate;

static inline setup_fate setup_fate_of(const e3d_vertices *v, const uint8_t *indices, int i)
{
    vi32 any = v_seti(0), all = v_seti(-1), zero = v_seti(0);
    for (int k = 0; k < 3; k++) {
        vi32 code = setup_fetch(v->code, indices + k * E3D_CLUSTER_TRIANGLES, i);
        any = v_ori(any, code);
        all = v_andi(all, code);
    }
    vmask keep = v_mand(v_eqi(v_andi(all, v_seti(E3D_OUTSIDE)), zero),
                        v_eqi(v_andi(any, v_seti(E3D_NONFINITE)), zero));
    vmask whole = v_eqi(v_andi(any, v_seti(E3D_CLIP)), zero);
    vmask good = v_eqi(v_andi(any, v_seti(E3D_BAD_SCREEN)), zero);
    return (setup_fate){v_mand(v_mand(keep, whole), good), v_mandnot(keep, whole)};
}

static inline int setup_any_code(const e3d_vertices *v)
{
    int32_t any = 0;
    for (int i = 0; i < V_LANES; i++)
        any |= v->codes[i];
    return any;
}

static void kernel_setup(const e3d_vertices *v, const uint8_t *indices, int triangles, int cull, int fragments,
                         const e3d_viewport *viewport, e3d_survivors *out)
{
    int draws = 0, smalls = 0, clips = 0, codes = setup_any_code(v);
    const vtable across = v_table(v->sx, v->count), down = v_table(v->sy, v->count);
    for (int i = 0; i < triangles; i += V_LANES) {
        vi32 x[3], y[3];
        for (int k = 0; k < 3; k++) {
            vi32 at = v_loadu8(indices + k * E3D_CLUSTER_TRIANGLES + i);
            x[k] = v_lookup(&across, at);
            y[k] = v_lookup(&down, at);
        }
        uint32_t tail = triangles - i >= V_LANES ? ~0u : (1u << (triangles - i)) - 1;
        vi32 triangle = v_addi(v_seti(i), v_iota());
        setup_boxes boxes = setup_boxes_of(x, y, cull, viewport);
        uint32_t draw = v_bits(v_mnot(boxes.miss)) & tail;
        if (codes) { /* a vertex isn't well inside the frustum */
            setup_fate fate = setup_fate_of(v, indices, i);
            draw &= v_bits(fate.draw);
            clips = setup_append(out->clip, clips, v_bits(fate.clip) & tail, i);
        }
        uint32_t small = fragments ? draw & v_bits(boxes.small) : 0;
        smalls += v_pack8(out->small + smalls, triangle, small);
        draws += v_pack8(out->draw + draws, triangle, draw & ~small);
    }
    out->draws = draws;
    out->smalls = smalls;
    out->clips = clips;
}
