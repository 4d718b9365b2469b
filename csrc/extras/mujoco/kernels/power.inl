/* Powers on vectors (R27). */

static ALWAYS_INLINE vf32 log2_of(vf32 v)
{
    static const float TERMS[7] = {0x1.c5507p-2f, -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                                   0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    vi32 bits = v_asi(v);
    vf32 exponent = v_float(v_subi(v_shr(bits, 23), v_seti(127))), sum = v_setf(TERMS[6]);
    vf32 t = v_sub(v_asf(v_ori(v_andi(bits, v_seti(0x7FFFFF)), v_seti(0x3F800000))), v_setf(1));
    for (int k = 5; k >= 0; k--)
        sum = v_add(v_mul(sum, t), v_setf(TERMS[k]));
    return v_add(exponent, v_add(t, v_mul(v_mul(t, v_sub(v_setf(1), t)), sum)));
}

static ALWAYS_INLINE vf32 exp2_of(vf32 y)
{
    static const float TERMS[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f, 0x1.cb1d4cp-13f};
    y = v_min(v_self(v_gt(y, v_setf(-126)), y, v_setf(-126)), v_setf(126)); /* NaN: the least */
    vi32 whole = v_floori(y);
    vf32 f = v_sub(y, v_float(whole)), sum = v_setf(TERMS[4]);
    for (int k = 3; k >= 0; k--)
        sum = v_add(v_mul(sum, f), v_setf(TERMS[k]));
    vf32 fraction = v_add(v_add(v_setf(1), f), v_mul(v_mul(f, v_sub(f, v_setf(1))), sum));
    return v_mul(fraction, v_asf(v_shl(v_addi(whole, v_seti(127)), 23)));
}

/* x to the power of n, for 0 <= x <= 1; 0 to the power of 0 is 1. */
static ALWAYS_INLINE vf32 power_of(vf32 x, vf32 n)
{
    vf32 power = v_self(v_ge(x, v_setf(0x1p-100f)), exp2_of(v_mul(n, log2_of(x))), v_setf(0));
    return v_self(v_eq(n, v_setf(0)), v_setf(1), power);
}
