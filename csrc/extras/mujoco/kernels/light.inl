/* Light on corners, on vectors (R261). */

static ALWAYS_INLINE vf32 dot_of(const vf32 a[3], const vf32 b[3])
{
    return v_add(v_add(v_mul(a[0], b[0]), v_mul(a[1], b[1])), v_mul(a[2], b[2]));
}

/* Makes vectors unit, but those of length 0; returns their lengths. */
static ALWAYS_INLINE vf32 make_unit(vf32 a[3])
{
    vf32 length = v_sqrt(dot_of(a, a)), scale = v_self(v_gt(length, v_setf(0)), v_div(v_setf(1), length), v_setf(1));
    for (int c = 0; c < 3; c++)
        a[c] = v_mul(a[c], scale);
    return length;
}

static ALWAYS_INLINE vf32 unit_range(vf32 v) { return v_min(v_self(v_gt(v, v_setf(0)), v, v_setf(0)), v_setf(1)); }

/* How much of a light arrives, and from where. */
static ALWAYS_INLINE vf32 strength_of(const muj_lamp *lamp, const vf32 place[3], vf32 to_light[3])
{
    const float *a = lamp->attenuation;
    vf32 dir[3], cone = v_setf(1);
    for (int c = 0; c < 3; c++) {
        dir[c] = v_setf(lamp->dir[c]);
        to_light[c] = lamp->is_directional ? v_setf(-lamp->dir[c]) : v_sub(v_setf(lamp->pos[c]), place[c]);
    }
    if (lamp->is_directional)
        return cone;
    vf32 distance = make_unit(to_light), inside = v_sub(v_setf(0), dot_of(to_light, dir));
    if (lamp->cutoff_cosine > -1) {
        vmask beyond = v_lt(inside, v_setf(lamp->cutoff_cosine));
        if (!v_any(v_mnot(beyond)))
            return v_setf(0);
        cone = v_self(beyond, v_setf(0), power_of(unit_range(inside), v_setf(lamp->exponent)));
    }
    vf32 loss = v_add(v_add(v_setf(a[0]), v_mul(v_setf(a[1]), distance)), v_mul(v_setf(a[2]), v_mul(distance, distance)));
    return v_self(v_eq(cone, v_setf(0)), v_setf(0), v_div(cone, loss));
}

static ALWAYS_INLINE void add_lamp(const muj_lamp *lamp, const muj_corners *corners, int i, const vf32 place[3], const vf32 normal[3],
                                   const vf32 to_eye[3], vf32 out[3])
{
    vf32 to_light[3], zero = v_setf(0), strength = strength_of(lamp, place, to_light), shine = zero;
    vmask dark = v_eq(strength, zero);
    if (!v_any(v_mnot(dark)))
        return;
    vf32 facing = dot_of(normal, to_light), specular = v_loadf(corners->specular + i);
    vmask shines = v_mandnot(v_gt(facing, zero), v_eq(specular, zero));
    if (v_any(shines)) {
        vf32 half[3];
        for (int c = 0; c < 3; c++)
            half[c] = v_add(to_light[c], to_eye[c]);
        make_unit(half);
        vf32 sharpness = v_mul(v_loadf(corners->shininess + i), v_setf(128));
        shine = v_self(shines, power_of(unit_range(dot_of(normal, half)), sharpness), zero);
    }
    vf32 most = v_self(v_gt(facing, zero), facing, zero);
    for (int c = 0; c < 3; c++) {
        vf32 rgb = v_loadf(corners->rgb[c] + i);
        vf32 dull = v_add(v_mul(v_setf(lamp->ambient[c]), rgb), v_mul(most, v_mul(v_setf(lamp->diffuse[c]), rgb)));
        vf32 all = v_add(dull, v_mul(shine, v_mul(v_setf(lamp->specular[c]), specular)));
        out[c] = v_add(out[c], v_self(dark, zero, v_mul(strength, all)));
    }
}

static void kernel_light(const muj_lamps *lamps, muj_corners *corners)
{
    for (int i = 0; i < corners->count; i += V_LANES) {
        vf32 place[3], normal[3], to_eye[3], sum[MUJ_PASSES][3];
        for (int c = 0; c < 3; c++) {
            place[c] = v_loadf(corners->place[c] + i);
            normal[c] = v_loadf(corners->normal[c] + i);
            to_eye[c] = v_sub(v_setf(lamps->eye[c]), place[c]);
            vf32 rgb = v_loadf(corners->rgb[c] + i);
            sum[0][c] = v_add(v_mul(v_loadf(corners->emission + i), rgb), v_mul(v_setf(lamps->ambient), rgb));
            for (int p = 1; p < lamps->passes; p++)
                sum[p][c] = v_setf(0);
        }
        make_unit(normal);
        make_unit(to_eye);
        for (int k = 0; k < lamps->count; k++)
            add_lamp(&lamps->lamp[k], corners, i, place, normal, to_eye, sum[lamps->lamp[k].pass]);
        for (int p = 0; p < lamps->passes; p++)
            for (int c = 0; c < 3; c++)
                v_storef(corners->color[p][c] + i, unit_range(sum[p][c]));
    }
}
