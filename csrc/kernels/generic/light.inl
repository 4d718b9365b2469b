/* light: Lambert and Blinn-Phong (Blinn 1977) sums of a batch over all lights, in their order (R31). */

/* One vector of lit samples. */
typedef struct lit_lanes {
    vf32 position[3], normal[3], view[3];
    vf32 energy[3], shine[3];
} lit_lanes;

/* Unit vector towards a point light; the attenuation; lanes within range. */
static inline vmask light_towards(const e3d_light *light, const vf32 position[3], vf32 l[3],
                                  vf32 *attenuation)
{
    vf32 one = v_setf(1.0f);
    float range2 = light->range * light->range;
    for (int k = 0; k < 3; k++)
        l[k] = v_sub(v_setf(light->position[k]), position[k]);
    vf32 d2 = dot_three(l, l);
    vmask near = v_mnot(v_ge(d2, v_setf(range2)));
    d2 = v_max(d2, v_setf(0x1p-40f));
    vf32 inverse = v_div(one, v_sqrt(d2));
    for (int k = 0; k < 3; k++)
        l[k] = v_mul(l[k], inverse);
    if (light->falloff == E3D_FALLOFF_WINDOW) {
        vf32 t = v_sub(one, v_mul(d2, v_setf(1.0f / range2)));
        *attenuation = v_mul(t, t);
    } else {
        *attenuation = v_div(one, d2);
    }
    return near;
}

static inline void light_highlight(const e3d_light *light, const vf32 l[3], vf32 facing,
                                   vf32 attenuation, vmask near, float shininess, lit_lanes *lit)
{
    vf32 zero = v_setf(0.0f), h[3];
    for (int k = 0; k < 3; k++)
        h[k] = v_add(l[k], lit->view[k]);
    unit_length(&h[0], &h[1], &h[2]);
    vf32 x = v_max(dot_three(lit->normal, h), zero);
    vmask some = v_mand(v_gt(facing, zero), v_ge(x, v_setf(0x1p-100f)));
    vf32 safe = v_self(some, x, v_setf(1.0f));
    vf32 power = v_self(some, exp2_poly(v_mul(v_setf(shininess), log2_poly(safe))), zero);
    vf32 amount = v_mul(attenuation, power);
    for (int k = 0; k < 3; k++) {
        vf32 more = v_add(lit->shine[k], v_mul(v_setf(light->color[k]), amount));
        lit->shine[k] = v_self(near, more, lit->shine[k]);
    }
}

static inline void light_one(const e3d_light *light, float shininess, lit_lanes *lit)
{
    vf32 zero = v_setf(0.0f), l[3], attenuation = v_setf(1.0f);
    vmask near = v_eq(zero, zero);
    if (light->kind == E3D_LIGHT_DIRECTIONAL)
        for (int k = 0; k < 3; k++)
            l[k] = v_setf(light->to_light[k]);
    else
        near = light_towards(light, lit->position, l, &attenuation);
    if (!v_any(near))
        return;
    vf32 facing = v_max(dot_three(lit->normal, l), zero);
    vf32 amount = v_mul(attenuation, facing);
    for (int k = 0; k < 3; k++) {
        vf32 more = v_add(lit->energy[k], v_mul(v_setf(light->color[k]), amount));
        lit->energy[k] = v_self(near, more, lit->energy[k]);
    }
    if (shininess > 0.0f)
        light_highlight(light, l, facing, attenuation, near, shininess, lit);
}

static inline void light_view(const e3d_lighting *lighting, lit_lanes *lit)
{
    for (int k = 0; k < 3; k++) {
        vf32 eye = v_setf(lighting->eye[k]);
        lit->view[k] = lighting->eye[3] != 0.0f ? v_sub(eye, lit->position[k]) : eye;
    }
    if (lighting->eye[3] != 0.0f)
        unit_length(&lit->view[0], &lit->view[1], &lit->view[2]);
}

static void kernel_light(e3d_batch *batch, const e3d_lighting *lighting, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        lit_lanes lit;
        for (int k = 0; k < 3; k++) {
            lit.position[k] = v_loadf(batch->position[k] + i);
            lit.normal[k] = v_loadf(batch->normal[k] + i);
            lit.energy[k] = v_setf(lighting->ambient[k]);
            lit.shine[k] = lit.view[k] = v_setf(0.0f);
        }
        if (shininess > 0.0f)
            light_view(lighting, &lit);
        for (int n = 0; n < lighting->light_count; n++)
            light_one(&lighting->lights[n], shininess, &lit);
        for (int k = 0; k < 3; k++) {
            vf32 low = v_max(lit.energy[k], v_setf(lighting->clamp[0]));
            v_storef(batch->energy[k] + i, v_min(low, v_setf(lighting->clamp[1])));
            v_storef(batch->shine[k] + i, lit.shine[k]);
        }
    }
}

static void kernel_combine(e3d_batch *batch, const float specular[3], const float emissive[3])
{
    for (int k = 0; k < 3; k++) {
        vf32 glow = v_setf(emissive[k]), ks = v_setf(specular ? specular[k] : 0.0f);
        for (int i = 0; i < batch->count; i += V_LANES) {
            vf32 c = v_mul(v_loadf(batch->color[k] + i), v_loadf(batch->energy[k] + i));
            if (specular)
                c = v_add(c, v_mul(ks, v_loadf(batch->shine[k] + i)));
            v_storef(batch->color[k] + i, v_add(c, glow));
        }
    }
}
