/* interpolate: barycentrics and attributes of a batch of samples (R18-R26).
 *
 * Samples of one surface stand together: a run of them is evaluated with the surface's words broadcast. A run's last
 * vector spills over its end; the next run, or nothing, writes there afterwards.
 */

static inline vf32 interpolate_three(const vf32 b[3], const vf32 v[3])
{
    return v_add(v_add(v_mul(b[0], v[0]), v_mul(b[1], v[1])), v_mul(b[2], v[2]));
}

static inline void broadcast_three(const float *words, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_setf(words[k]);
}

/* The end of the run of one surface that starts at sample `first` of the batch. */
static inline int run_end(const e3d_batch *batch, int first)
{
    int end = first + 1;
    while (end < batch->count && batch->surface[end] == batch->surface[first])
        end++;
    return end;
}

/* The planes of R18, broadcast. */
typedef struct plane_lanes {
    vf32 p[3], px[3], py[3];
    vi32 base_x, base_y;
} plane_lanes;

static inline plane_lanes broadcast_planes(const e3d_surface *s)
{
    plane_lanes planes;
    broadcast_three(s->p, planes.p);
    broadcast_three(s->px, planes.px);
    broadcast_three(s->py, planes.py);
    planes.base_x = v_seti(s->base_x);
    planes.base_y = v_seti(s->base_y);
    return planes;
}

/* R19 */
static inline vf32 interpolate_barycentric(const plane_lanes *planes, vi32 sample, vf32 b[3])
{
    vi32 x = v_andi(sample, v_seti(E3D_TILE - 1)), y = v_shr(sample, 6);
    vf32 dx = v_float(v_subi(x, planes->base_x)), dy = v_float(v_subi(y, planes->base_y));
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), p[3];
    for (int k = 0; k < 3; k++) {
        vf32 along = v_mul(dx, planes->px[k]), down = v_mul(dy, planes->py[k]);
        p[k] = v_max(v_add(v_add(planes->p[k], along), down), zero);
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

static inline void load_barycentric(const e3d_batch *batch, int i, vf32 b[3])
{
    for (int k = 0; k < 3; k++)
        b[k] = v_loadf(batch->b[k] + i);
}

static void run_barycentric(e3d_batch *batch, int first, int end, const e3d_surface *s)
{
    plane_lanes planes = broadcast_planes(s);
    for (int i = first; i < end; i += V_LANES) {
        vf32 b[3], r = interpolate_barycentric(&planes, v_loadi(batch->sample + i), b);
        v_storef(batch->r + i, r);
        for (int k = 0; k < 3; k++)
            v_storef(batch->b[k] + i, b[k]);
    }
}

/* `words`: `channels` rows of three corner values. */
static void run_attribute(e3d_batch *batch, int first, int end, const float *words, int channels,
                          e3d_lane_array *out)
{
    for (int c = 0; c < channels; c++) {
        vf32 corner[3], b[3];
        broadcast_three(words + 3 * c, corner);
        for (int i = first; i < end; i += V_LANES) {
            load_barycentric(batch, i, b);
            v_storef(out[c] + i, interpolate_three(b, corner));
        }
    }
}

static void run_normal(e3d_batch *batch, int first, int end, const e3d_surface *s, int flat)
{
    vf32 corner[3][3], zero = v_setf(0.0f);
    for (int c = 0; c < 3; c++)
        broadcast_three(s->normal[c], corner[c]);
    for (int i = first; i < end; i += V_LANES) {
        vf32 b[3], n[3];
        load_barycentric(batch, i, b);
        for (int c = 0; c < 3; c++) {
            n[c] = flat ? corner[c][0] : interpolate_three(b, corner[c]);
            n[c] = s->back ? v_sub(zero, n[c]) : n[c];
        }
        unit_length(&n[0], &n[1], &n[2]);
        for (int c = 0; c < 3; c++)
            v_storef(batch->normal[c] + i, n[c]);
    }
}

static void kernel_interpolate(e3d_batch *batch, const e3d_surface *surfaces, int wanted)
{
    for (int first = 0, end; first < batch->count; first = end) {
        const e3d_surface *s = &surfaces[batch->surface[first]];
        end = run_end(batch, first);
        run_barycentric(batch, first, end, s);
        if (wanted & E3D_WANT_POSITION)
            run_attribute(batch, first, end, s->position[0], 3, batch->position);
        if (wanted & E3D_WANT_NORMAL)
            run_normal(batch, first, end, s, wanted & E3D_WANT_FLAT);
        if (wanted & E3D_WANT_UV)
            run_attribute(batch, first, end, s->uv[0], 2, batch->uv);
    }
}

/* Read and written in place: the last vector of a run must leave the next run's samples alone. */
static void run_tint(e3d_batch *batch, int first, int end, const e3d_surface *s, int by_vertex,
                     int by_instance)
{
    for (int c = 0; c < 3; c++) {
        vf32 corner[3], instance = v_setf(s->instance_color[c]);
        broadcast_three(s->color[c], corner);
        for (int i = first; i < end; i += V_LANES) {
            vf32 b[3], old = v_loadf(batch->color[c] + i), v = old;
            load_barycentric(batch, i, b);
            if (by_vertex)
                v = v_mul(v, interpolate_three(b, corner));
            if (by_instance)
                v = v_mul(v, instance);
            vmask own = v_gti(v_seti(end - i), v_iota());
            v_storef(batch->color[c] + i, v_self(own, v, old));
        }
    }
}

static void kernel_tint(e3d_batch *batch, const e3d_surface *surfaces, int by_vertex, int by_instance)
{
    for (int first = 0, end; first < batch->count; first = end) {
        end = run_end(batch, first);
        run_tint(batch, first, end, &surfaces[batch->surface[first]], by_vertex, by_instance);
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

/* Squared length, in texels, of the step of both coordinates along one screen axis. */
static inline vf32 level_length2(const float *plane_words, const e3d_surface *s, const vf32 value[2],
                                 vf32 r, const vf32 size[2])
{
    vf32 plane[3], corner[3], square[2];
    broadcast_three(plane_words, plane);
    for (int k = 0; k < 2; k++) {
        broadcast_three(s->uv[k], corner);
        vf32 texels = v_mul(level_derivative(plane, corner, value[k], r), size[k]);
        square[k] = v_mul(texels, texels);
    }
    return v_add(square[0], square[1]);
}

static void run_level(e3d_batch *batch, int first, int end, const e3d_surface *s, const vf32 size[2],
                      vi32 last)
{
    vf32 one = v_setf(1.0f);
    for (int i = first; i < end; i += V_LANES) {
        vf32 r = v_loadf(batch->r + i);
        const vf32 value[2] = {v_loadf(batch->uv[0] + i), v_loadf(batch->uv[1] + i)};
        vf32 q = v_max(level_length2(s->px, s, value, r, size), level_length2(s->py, s, value, r, size));
        vmask minified = v_gt(q, one);
        q = v_min(v_self(minified, q, one), v_setf(0x1p100f));
        vi32 lod = v_rint(v_mul(log2_poly(q), v_setf(128.0f)));
        v_storei(batch->lod + i, v_mini(v_seli(minified, lod, v_seti(0)), last));
    }
}

static void kernel_select_level(e3d_batch *batch, const e3d_surface *surfaces,
                                const e3d_texture_view *texture)
{
    const vf32 size[2] = {v_setf((float)texture->levels[0].width),
                          v_setf((float)texture->levels[0].height)};
    vi32 last = v_seti((texture->level_count - 1) * 256);
    for (int first = 0, end; first < batch->count; first = end) {
        end = run_end(batch, first);
        run_level(batch, first, end, &surfaces[batch->surface[first]], size, last);
    }
}
