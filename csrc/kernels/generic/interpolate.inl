/* interpolate: barycentrics and attributes of a batch of samples (R18-R26).
 *
 * Neighbouring samples mostly lie on one surface: then its words are broadcast, else gathered.
 */

/* The surfaces of one vector of samples. */
typedef struct surface_lanes {
    const float *words; /* of all surfaces */
    const float *one;   /* of the only surface, or NULL */
    vi32 first;         /* word index of each lane's surface */
} surface_lanes;

enum { SURFACE_WORDS = sizeof(e3d_surface) / 4 };
#define SURFACE_WORD(member) ((int)(offsetof(e3d_surface, member) / 4))

static inline surface_lanes surface_of(const e3d_surface *surfaces, const int32_t *index)
{
    vi32 which = v_loadi(index);
    vmask same = v_eqi(which, v_seti(index[0]));
    surface_lanes s = {(const float *)surfaces, NULL, v_shl(which, 6)};
    if (!v_any(v_mnot(same)))
        s.one = (const float *)&surfaces[index[0]];
    return s;
}

static inline vf32 surface_float(const surface_lanes *s, int word)
{
    if (s->one)
        return v_setf(s->one[word]);
    return v_gatherf(s->words, v_addi(s->first, v_seti(word)));
}

static inline vi32 surface_int(const surface_lanes *s, int word)
{
    return v_asi(surface_float(s, word));
}

static inline vf32 interpolate_three(const vf32 b[3], vf32 v0, vf32 v1, vf32 v2)
{
    return v_add(v_add(v_mul(b[0], v0), v_mul(b[1], v1)), v_mul(b[2], v2));
}

static inline vf32 interpolate_word(const surface_lanes *s, const vf32 b[3], int word)
{
    return interpolate_three(b, surface_float(s, word), surface_float(s, word + 1),
                             surface_float(s, word + 2));
}

/* R19 */
static inline vf32 interpolate_barycentric(const surface_lanes *s, vi32 sample, vf32 b[3])
{
    vi32 x = v_andi(sample, v_seti(E3D_TILE - 1)), y = v_shr(sample, 6);
    vf32 dx = v_float(v_subi(x, surface_int(s, SURFACE_WORD(base_x))));
    vf32 dy = v_float(v_subi(y, surface_int(s, SURFACE_WORD(base_y))));
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), p[3];
    for (int k = 0; k < 3; k++) {
        vf32 along = v_mul(dx, surface_float(s, SURFACE_WORD(px) + k));
        vf32 down = v_mul(dy, surface_float(s, SURFACE_WORD(py) + k));
        p[k] = v_max(v_add(v_add(surface_float(s, SURFACE_WORD(p) + k), along), down), zero);
    }
    vf32 sum = v_add(v_add(p[0], p[1]), p[2]);
    vmask some = v_ge(sum, v_setf(0x1p-126f));
    vf32 r = v_self(some, v_div(one, sum), zero);
    for (int k = 0; k < 3; k++)
        b[k] = v_self(some, v_min(v_mul(p[k], r), one), k ? zero : one);
    return r;
}

/* R22: what has no usable length becomes zero. */
static inline void unit_length(vf32 *x, vf32 *y, vf32 *z)
{
    vf32 zero = v_setf(0.0f);
    vf32 length2 = v_add(v_add(v_mul(*x, *x), v_mul(*y, *y)), v_mul(*z, *z));
    vmask some = v_mand(v_gt(length2, zero), v_lt(length2, v_setf(INFINITY)));
    vf32 inverse = v_div(v_setf(1.0f), v_sqrt(length2));
    *x = v_self(some, v_mul(*x, inverse), zero);
    *y = v_self(some, v_mul(*y, inverse), zero);
    *z = v_self(some, v_mul(*z, inverse), zero);
}

static inline void interpolate_normal(e3d_batch *batch, int i, const surface_lanes *s, const vf32 b[3],
                                      int flat)
{
    vf32 n[3], zero = v_setf(0.0f);
    vmask front = v_eqi(surface_int(s, SURFACE_WORD(back)), v_seti(0));
    for (int k = 0; k < 3; k++) {
        int word = SURFACE_WORD(normal) + 3 * k;
        n[k] = flat ? surface_float(s, word) : interpolate_word(s, b, word);
        n[k] = v_self(front, n[k], v_sub(zero, n[k]));
    }
    unit_length(&n[0], &n[1], &n[2]);
    for (int k = 0; k < 3; k++)
        v_storef(batch->normal[k] + i, n[k]);
}

static void kernel_interpolate(e3d_batch *batch, const e3d_surface *surfaces, int wanted)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        surface_lanes s = surface_of(surfaces, batch->surface + i);
        vf32 b[3];
        vf32 r = interpolate_barycentric(&s, v_loadi(batch->sample + i), b);
        v_storef(batch->r + i, r);
        for (int k = 0; k < 3; k++)
            v_storef(batch->b[k] + i, b[k]);
        if (wanted & E3D_WANT_POSITION)
            for (int k = 0; k < 3; k++)
                v_storef(batch->position[k] + i,
                         interpolate_word(&s, b, SURFACE_WORD(position) + 3 * k));
        if (wanted & E3D_WANT_NORMAL)
            interpolate_normal(batch, i, &s, b, wanted & E3D_WANT_FLAT);
        if (wanted & E3D_WANT_UV)
            for (int k = 0; k < 2; k++)
                v_storef(batch->uv[k] + i, interpolate_word(&s, b, SURFACE_WORD(uv) + 3 * k));
    }
}

static void kernel_tint(e3d_batch *batch, const e3d_surface *surfaces, int by_vertex, int by_instance)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        surface_lanes s = surface_of(surfaces, batch->surface + i);
        vf32 b[3];
        for (int k = 0; k < 3; k++)
            b[k] = v_loadf(batch->b[k] + i);
        for (int k = 0; k < 3; k++) {
            vf32 c = v_loadf(batch->color[k] + i);
            if (by_vertex)
                c = v_mul(c, interpolate_word(&s, b, SURFACE_WORD(color) + 3 * k));
            if (by_instance)
                c = v_mul(c, surface_float(&s, SURFACE_WORD(instance_color) + k));
            v_storef(batch->color[k] + i, c);
        }
    }
}

/* R25: derivative of an interpolated coordinate along one screen axis. */
static inline vf32 level_derivative(const vf32 plane[3], const vf32 corner[3], vf32 value, vf32 r)
{
    vf32 sum = v_add(v_add(plane[0], plane[1]), plane[2]);
    vf32 along = v_add(v_add(v_mul(plane[0], corner[0]), v_mul(plane[1], corner[1])),
                       v_mul(plane[2], corner[2]));
    return v_mul(v_sub(along, v_mul(value, sum)), r);
}

/* R27 */
static inline vf32 log2_poly(vf32 q)
{
    static const float c[7] = {0x1.c5507p-2f,  -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                               0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    vi32 bits = v_asi(q);
    vf32 exponent = v_float(v_subi(v_shr(bits, 23), v_seti(127)));
    vf32 one = v_setf(1.0f);
    vf32 t = v_sub(v_asf(v_ori(v_andi(bits, v_seti(0x7FFFFF)), v_seti(0x3F800000))), one);
    vf32 sum = v_setf(c[6]);
    for (int k = 5; k >= 0; k--)
        sum = v_add(v_mul(sum, t), v_setf(c[k]));
    return v_add(exponent, v_add(t, v_mul(v_mul(t, v_sub(one, t)), sum)));
}

static inline vf32 exp2_poly(vf32 y)
{
    static const float c[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f,
                               0x1.cb1d4cp-13f};
    vf32 one = v_setf(1.0f);
    y = v_min(v_max(y, v_setf(-126.0f)), v_setf(126.0f));
    vi32 whole = v_trunc(y);
    whole = v_subi(whole, v_seli(v_gt(v_float(whole), y), v_seti(1), v_seti(0)));
    vf32 f = v_sub(y, v_float(whole)), sum = v_setf(c[4]);
    for (int k = 3; k >= 0; k--)
        sum = v_add(v_mul(sum, f), v_setf(c[k]));
    vf32 fraction = v_add(v_add(one, f), v_mul(v_mul(f, v_sub(f, one)), sum));
    return v_mul(fraction, v_asf(v_shl(v_addi(whole, v_seti(127)), 23)));
}

static inline vf32 level_length2(const surface_lanes *s, int plane_word, const vf32 corner[2][3],
                                 const vf32 value[2], vf32 r, const vf32 size[2])
{
    vf32 plane[3], square[2];
    for (int k = 0; k < 3; k++)
        plane[k] = surface_float(s, plane_word + k);
    for (int k = 0; k < 2; k++) {
        vf32 texels = v_mul(level_derivative(plane, corner[k], value[k], r), size[k]);
        square[k] = v_mul(texels, texels);
    }
    return v_add(square[0], square[1]);
}

static void kernel_select_level(e3d_batch *batch, const e3d_surface *surfaces,
                                const e3d_texture_view *texture)
{
    const vf32 size[2] = {v_setf((float)texture->levels[0].width),
                          v_setf((float)texture->levels[0].height)};
    vi32 last = v_seti((texture->level_count - 1) * 256);
    for (int i = 0; i < batch->count; i += V_LANES) {
        surface_lanes s = surface_of(surfaces, batch->surface + i);
        vf32 corner[2][3], value[2], r = v_loadf(batch->r + i);
        for (int k = 0; k < 2; k++) {
            value[k] = v_loadf(batch->uv[k] + i);
            for (int j = 0; j < 3; j++)
                corner[k][j] = surface_float(&s, SURFACE_WORD(uv) + 3 * k + j);
        }
        vf32 q = v_max(level_length2(&s, SURFACE_WORD(px), corner, value, r, size),
                       level_length2(&s, SURFACE_WORD(py), corner, value, r, size));
        vmask minified = v_gt(q, v_setf(1.0f));
        q = v_min(v_self(minified, q, v_setf(1.0f)), v_setf(0x1p100f));
        vi32 lod = v_rint(v_mul(log2_poly(q), v_setf(128.0f)));
        v_storei(batch->lod + i, v_mini(v_seli(minified, lod, v_seti(0)), last));
    }
}
