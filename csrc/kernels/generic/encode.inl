/* encode: colours, clamped to [0, 1] (R33), to 8 bits (R34). */

/* The number of thresholds <= v, which is in [0, 1], as encode_tables.h finds it. */
static inline vi32 encode_bucket(vf32 v) { return v_maxi(v_subi(v_shr(v_asi(v), 16), v_seti(ENCODE_FIRST)), v_seti(0)); }
static inline vi32 encode_code(vf32 v, vi32 sum) { return v_shr(v_addi(sum, v_andi(v_asi(v), v_seti(0xFFFF))), 17); }
static inline vi32 encode_srgb(vf32 v) { return encode_code(v, v_gatheri(ENCODE_SUMS, encode_bucket(v))); }

/* Whether all samples are grey. */
static inline int encode_is_grey(const vf32 color[3])
{
    vi32 differ = v_ori(v_xori(v_asi(color[0]), v_asi(color[1])), v_xori(v_asi(color[0]), v_asi(color[2])));
    return !v_any(v_mnot(v_eqi(differ, v_seti(0))));
}

static inline vf32 encode_clamp(vf32 v) { return v_min(v_max(v, v_setf(0.0f)), v_setf(1.0f)); }

/* One vector of colours, which are not clamped yet. */
static inline vi32 encode_vector_linear(const vf32 color[3])
{
    vi32 code[3];
    for (int k = 0; k < 3; k++)
        code[k] = v_rint(v_mul(v_setf(255.0f), v_min(v_setf(1.0f), color[k]))); /* of no number: below 0 */
    return v_rgba(code);
}

/* Looking up takes long, and white in white light is common. */
static inline vi32 encode_vector_srgb(const vf32 color[3])
{
    vi32 code[3];
    int grey = encode_is_grey(color);
    for (int k = 0; k < 3; k++)
        code[k] = k > 0 && grey ? code[0] : encode_srgb(encode_clamp(color[k]));
    return v_rgba(code);
}

static inline vi32 encode_vector(const vf32 color[3], int srgb)
{
    return srgb ? encode_vector_srgb(color) : encode_vector_linear(color);
}

static void kernel_encode(const float *red, const float *green, const float *blue, int count, int srgb,
                          uint32_t *rgba)
{
    for (int i = 0; i < count; i += V_LANES) {
        const vf32 color[3] = {v_loadf(red + i), v_loadf(green + i), v_loadf(blue + i)};
        v_storei(rgba + i, encode_vector(color, srgb));
    }
}
