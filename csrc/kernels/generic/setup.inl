/* setup: which triangles of a cluster may show (R4-R7, R9, R10), a vector of triangles at a time.
 *
 * Conservative where 32 bits do not hold the area: such a triangle stays, and emit.c decides.
 */

static inline vi32 setup_fetch(const int32_t *table, const uint8_t *indices, int i)
{
    return v_gatheri(table, v_loadu8(indices + i));
}

/* Lanes whose box of sample centres is empty in the viewport. */
static inline vmask setup_no_sample(vi32 lo, vi32 hi, int32_t size)
{
    vi32 first = v_maxi(v_sra(v_addi(lo, v_seti(127)), 8), v_seti(0));
    vi32 last = v_mini(v_sra(v_subi(hi, v_seti(128)), 8), v_seti(size - 1));
    return v_gti(first, last);
}

static inline vi32 setup_min3(vi32 a, vi32 b, vi32 c) { return v_mini(v_mini(a, b), c); }
static inline vi32 setup_max3(vi32 a, vi32 b, vi32 c) { return v_maxi(v_maxi(a, b), c); }

/* Lanes that face the wrong way or have no area; lanes too wide for 32 bits are left alone. */
static inline vmask setup_culled(const vi32 x[3], const vi32 y[3], vi32 width, vi32 height, int cull)
{
    vi32 area = v_subi(v_muli(v_subi(x[1], x[0]), v_subi(y[2], y[0])),
                       v_muli(v_subi(x[2], x[0]), v_subi(y[1], y[0])));
    vmask wide = v_gti(v_maxi(width, height), v_seti(32767));
    vmask drop = v_eqi(area, v_seti(0));
    if (cull < 0)
        drop = v_mor(drop, v_negi(area));
    if (cull > 0)
        drop = v_mor(drop, v_gti(area, v_seti(0)));
    return v_mandnot(drop, wide);
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
        vi32 xlo = setup_min3(x[0], x[1], x[2]), xhi = setup_max3(x[0], x[1], x[2]);
        vi32 ylo = setup_min3(y[0], y[1], y[2]), yhi = setup_max3(y[0], y[1], y[2]);
        vmask miss = v_mor(setup_no_sample(xlo, xhi, viewport->width),
                           setup_no_sample(ylo, yhi, viewport->height));
        miss = v_mor(miss, setup_culled(x, y, v_subi(xhi, xlo), v_subi(yhi, ylo), cull));
        miss = v_mor(miss, v_mnot(v_eqi(v_andi(any, v_seti(E3D_BAD_SCREEN)), zero)));
        uint32_t tail = triangles - i >= V_LANES ? ~0u : (1u << (triangles - i)) - 1;
        draws = setup_append(out->draw, draws, v_bits(v_mandnot(v_mand(keep, whole), miss)) & tail, i);
        clips = setup_append(out->clip, clips, v_bits(v_mandnot(keep, whole)) & tail, i);
    }
    out->draws = draws;
    out->clips = clips;
}
