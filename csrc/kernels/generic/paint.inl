/* paint: a batch of samples to pixels at once (R19-R34): what interpolate, select_level, texture, tint, light, combine and
 * encode do one after the other over memory, here goes through registers.
 */

/* One vector on its way: what texels and light need. */
typedef struct paint_lanes {
    vf32 b[3], position[3], normal[3];
} paint_lanes;

static inline void paint_interpolate(const e3d_surfaces *s, const element_lanes *lanes, int same, vi32 sample,
                                     const e3d_paint *paint, texture_plan *plan, int i, paint_lanes *out)
{
    vf32 r = interpolate_barycentric(s, lanes, same, sample, out->b);
    for (int c = 0; c < 3 && paint->wanted & E3D_WANT_POSITION; c++)
        out->position[c] = interpolate_one(s->position[c], lanes, same, out->b);
    if (paint->wanted & E3D_WANT_NORMAL)
        interpolate_normal(s, lanes, same, paint->wanted & E3D_WANT_FLAT, out->b, out->normal);
    if (paint->texture) {
        const vf32 uv[2] = {interpolate_one(s->uv[0], lanes, same, out->b), interpolate_one(s->uv[1], lanes, same, out->b)};
        vi32 lod = v_seti(0);
        if (paint->texture->filter == E3D_TRILINEAR)
            lod = level_of(s, lanes, uv, r, paint->texture);
        texture_find(plan, i, uv[0], uv[1], lod);
    }
}

/* R31 of all lights: there are few. */
static inline void paint_light(const e3d_paint *paint, const paint_lanes *lanes, vf32 color[3])
{
    const e3d_lighting *lighting = paint->lighting;
    lit_lanes lit;
    for (int k = 0; k < 3; k++) {
        lit.position[k] = lanes->position[k];
        lit.normal[k] = lanes->normal[k];
        lit.view[k] = v_setf(0.0f);
        lit.energy[k] = v_setf(lighting->ambient[k]);
        lit.shine[k] = v_setf(0.0f);
    }
    if (paint->shininess > 0.0f)
        light_view(lighting, &lit);
    for (int n = 0; n < lighting->light_count; n++)
        light_one(lighting, n, paint->shininess, &lit);
    for (int k = 0; k < 3; k++)
        lit.energy[k] = light_clamp(lighting, lit.energy[k]);
    combine_vector(lit.energy, lit.shine, paint->specular, paint->emissive, color);
}

/* Lanes past the batch's end are the last sample again. */
static inline void paint_store(const int32_t *sample, vi32 pixels, uint32_t *rgba)
{
    vi32 row = v_addi(v_seti(sample[0]), v_iota());
    if (!v_any(v_mnot(v_eqi(v_loadi(sample), row)))) {
        v_storei(rgba + sample[0], pixels);
        return;
    }
    uint32_t lanes[V_LANES];
    v_storei(lanes, pixels);
    for (int lane = 0; lane < V_LANES; lane++)
        rgba[sample[lane]] = lanes[lane];
}

static inline void paint_finish(const e3d_batch *batch, const e3d_surfaces *s, const element_lanes *lanes,
                                const e3d_paint *paint, const texture_plan *plan, int i, const paint_lanes *in,
                                uint32_t *rgba)
{
    vf32 color[3] = {v_setf(paint->base[0]), v_setf(paint->base[1]), v_setf(paint->base[2])};
    if (paint->texture) {
        texel_lanes texel = texture_read(plan, i);
        texture_color(&texel, paint->base, color);
    }
    if (paint->by_vertex || paint->by_instance)
        tint_vector(s, lanes, in->b, paint->by_vertex, paint->by_instance, color);
    if (paint->lighting)
        paint_light(paint, in, color);
    paint_store(batch->sample + i, encode_vector(color, paint->srgb), rgba);
}

static void kernel_paint(const e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba)
{
    enum { VECTORS = (E3D_BATCH + V_LANES - 1) / V_LANES };
    paint_lanes waiting[VECTORS]; /* for texels on their way to the cache */
    texture_plan plan;
    if (paint->texture)
        texture_begin(&plan, paint->texture);
    for (int i = 0; i < batch->count; i += V_LANES) {
        element_lanes lanes = lanes_of(batch->surface + i);
        paint_lanes *out = &waiting[paint->texture ? i / V_LANES : 0];
        const e3d_surfaces *s = surfaces_from(surfaces, &lanes);
        vi32 sample = v_loadi(batch->sample + i);
        if (lanes.same)
            paint_interpolate(s, &lanes, 1, sample, paint, &plan, i, out);
        else
            paint_interpolate(s, &lanes, 0, sample, paint, &plan, i, out);
        if (!paint->texture)
            paint_finish(batch, s, &lanes, paint, &plan, i, out, rgba);
    }
    for (int i = 0; i < batch->count && paint->texture; i += V_LANES) {
        element_lanes lanes = lanes_of(batch->surface + i);
        paint_finish(batch, surfaces_from(surfaces, &lanes), &lanes, paint, &plan, i, &waiting[i / V_LANES], rgba);
    }
}
