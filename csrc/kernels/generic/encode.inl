/* encode: colours, clamped to [0, 1] (R33), to 8 bits (R34).
 *
 * The sRGB code is the number of thresholds <= v. A guess from the float's exponent and first mantissa
 * bits is at most ENCODE_STEPS too small (encode_tables.h is made so), and is then counted up.
 */

static inline vf32 encode_clamp(const float *v)
{
    return v_min(v_max(v_loadf(v), v_setf(0.0f)), v_setf(1.0f));
}

static inline vi32 encode_srgb(vf32 v)
{
    vi32 bucket = v_subi(v_shr(v_asi(v), ENCODE_SHIFT), v_seti(ENCODE_FIRST));
    bucket = v_mini(v_maxi(bucket, v_seti(0)), v_seti(ENCODE_BUCKETS - 1));
    vi32 code = v_gatheri(ENCODE_GUESS, bucket), one = v_seti(1), zero = v_seti(0);
    for (int step = 0; step < ENCODE_STEPS; step++) {
        vf32 next = v_gatherf(SRGB_THRESHOLDS, code);
        code = v_addi(code, v_seli(v_ge(v, next), one, zero));
    }
    return code;
}

static inline vi32 encode_linear(vf32 v)
{
    return v_trunc(v_add(v_mul(v_setf(255.0f), v), v_setf(0.5f)));
}

static void kernel_encode(const float *red, const float *green, const float *blue, int count, int srgb,
                          uint32_t *rgba)
{
    for (int i = 0; i < count; i += V_LANES) {
        vf32 r = encode_clamp(red + i), g = encode_clamp(green + i), b = encode_clamp(blue + i);
        vi32 cr = srgb ? encode_srgb(r) : encode_linear(r);
        vi32 cg = srgb ? encode_srgb(g) : encode_linear(g);
        vi32 cb = srgb ? encode_srgb(b) : encode_linear(b);
        vi32 low = v_ori(cr, v_shl(cg, 8)), high = v_ori(v_shl(cb, 16), v_seti((int32_t)0xFF000000));
        v_storei(rgba + i, v_ori(low, high));
    }
}
