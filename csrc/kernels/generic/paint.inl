/* paint: a batch of samples to pixels at once (R19-R34): the other kernels one after the other, but texels and light go to
 * pixels through registers, and only where they are to be seen.
 */

/* Where a vector's albedo is. */
typedef enum paint_source { PAINT_BASE, PAINT_COLOR, PAINT_TEXELS } paint_source;

typedef struct paint_plan {
    const e3d_paint *paint;
    const texture_plan *texture; /* of PAINT_TEXELS, which are texture_is_bilinear8 */
    paint_source source;
} paint_plan;

/* ---- light ---- */

static inline int is_grey(const float c[3]) { return c[0] == c[1] && c[0] == c[2]; }

/* 1, where all light is grey, or 3; 0: unlit. */
static inline int paint_channels(const e3d_lighting *lighting)
{
    if (!lighting)
        return 0;
    int grey = is_grey(lighting->ambient);
    for (int n = 0; n < lighting->light_count; n++)
        grey &= is_grey(lighting->lights[n].color);
    return grey ? 1 : 3;
}

/* R31 of all lights: there are few. `channels` and whether there are highlights are known when compiled. */
static ALWAYS_INLINE void paint_light(const e3d_batch *batch, int i, const e3d_paint *paint, int channels, float shininess,
                                      vf32 color[3])
{
    const e3d_lighting *lighting = paint->lighting;
    lit_lanes lit;
    for (int k = 0; k < 3; k++) {
        lit.position[k] = v_loadf(batch->position[k] + i);
        lit.normal[k] = v_loadf(batch->normal[k] + i);
        lit.view[k] = v_setf(0.0f);
        lit.energy[k] = v_setf(lighting->ambient[k]);
        lit.shine[k] = v_setf(0.0f);
    }
    if (shininess > 0.0f)
        light_view(lighting, &lit);
    for (int n = 0; n < lighting->light_count; n++)
        light_one(lighting, n, channels, shininess, &lit);
    for (int k = 0; k < channels; k++)
        lit.energy[k] = light_clamp(lighting, lit.energy[k]);
    for (int k = channels; k < 3; k++) {
        lit.energy[k] = lit.energy[0];
        lit.shine[k] = lit.shine[0];
    }
    combine_vector(lit.energy, lit.shine, paint->specular, paint->emissive, color);
}

/* The first lanes of a vector: all, where those past the batch's end are the last sample again. */
static ALWAYS_INLINE void paint_store(const int32_t *sample, vi32 pixels, int lanes, uint32_t *rgba)
{
    if (lanes == V_LANES && v_store_runs(rgba, sample, pixels))
        return;
    uint32_t pixel[V_LANES];
    v_storei(pixel, pixels);
    for (int lane = 0; lane < lanes; lane++)
        rgba[sample[lane]] = pixel[lane];
}

static inline void paint_base(e3d_batch *batch, const float base[3])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i += V_LANES)
            v_storef(batch->color[k] + i, v_setf(base[k]));
}

/* ---- albedo ---- */

static inline paint_source paint_untextured(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint)
{
    if (!paint->by_vertex && !paint->by_instance)
        return PAINT_BASE;
    if (!paint->by_vertex) {
        each_vector(batch, surfaces, stage_instance_base, paint->base);
        return PAINT_COLOR;
    }
    paint_base(batch, paint->base);
    kernel_tint(batch, surfaces, 1, paint->by_instance);
    return PAINT_COLOR;
}

static inline paint_source paint_textured(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, texture_plan *plan)
{
    if (texture_is_bilinear8(paint->texture) && !paint->by_vertex && !paint->by_instance) {
        texture_prepare(plan, paint->texture, paint->base, batch);
        return PAINT_TEXELS;
    }
    if (paint->texture->filter == E3D_TRILINEAR)
        kernel_select_level(batch, surfaces, paint->texture);
    kernel_texture(batch, paint->texture, paint->base);
    kernel_tint(batch, surfaces, paint->by_vertex, paint->by_instance);
    return PAINT_COLOR;
}

static ALWAYS_INLINE void paint_load(const e3d_batch *batch, int i, vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_loadf(batch->color[k] + i);
}

/* ---- pixels ---- */

/* The colours of one vector. */
static ALWAYS_INLINE void paint_color(const e3d_batch *batch, int i, const paint_plan *plan, int channels, float shininess,
                                      vf32 color[3])
{
    if (plan->source == PAINT_TEXELS)
        texture_color(plan->texture, E3D_BILINEAR, 8, i, color);
    else if (plan->source == PAINT_COLOR)
        paint_load(batch, i, color);
    for (int k = 0; k < 3 && plan->source == PAINT_BASE; k++)
        color[k] = v_setf(plan->paint->base[k]);
    if (channels)
        paint_light(batch, i, plan->paint, channels, shininess, color);
}

static ALWAYS_INLINE void paint_linear(const e3d_batch *batch, const paint_plan *plan, int channels, float shininess, uint32_t *rgba)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, channels, shininess, color);
        paint_store(batch->sample + i, encode_vector_linear(color), V_LANES, rgba);
    }
}

/* What a batch looks up in the table of R34. */
typedef struct paint_sums {
    _Alignas(64) int32_t of[3][E3D_BATCH + E3D_PAD]; /* the places, then what is there */
    int grey; /* of one channel, for all three */
} paint_sums;

static ALWAYS_INLINE void paint_find(e3d_batch *batch, const paint_plan *plan, int channels, float shininess, paint_sums *sums)
{
    sums->grey = 1;
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, channels, shininess, color);
        sums->grey &= encode_is_grey(color);
        for (int k = 0; k < 3; k++) {
            color[k] = encode_clamp(color[k]);
            v_storef(batch->color[k] + i, color[k]);
            v_storei(sums->of[k] + i, encode_bucket(color[k]));
        }
    }
}

/* One after the other: loads and stores alone take less than gathering. */
static inline void paint_look_up(int count, paint_sums *sums)
{
    for (int k = 0; k < (sums->grey ? 1 : 3); k++)
        for (int i = 0; i < count; i++)
            sums->of[k][i] = ENCODE_SUMS[sums->of[k][i]];
}

static ALWAYS_INLINE void paint_srgb(e3d_batch *batch, const paint_plan *plan, int channels, float shininess, uint32_t *rgba)
{
    paint_sums sums;
    paint_find(batch, plan, channels, shininess, &sums);
    paint_look_up((batch->count + V_LANES - 1) / V_LANES * V_LANES, &sums);
    for (int i = 0; i < batch->count; i += V_LANES) {
        vi32 code[3];
        for (int k = 0; k < 3; k++)
            code[k] = encode_code(v_loadf(batch->color[k] + i), v_loadi(sums.of[sums.grey ? 0 : k] + i));
        paint_store(batch->sample + i, v_rgba(code), V_LANES, rgba);
    }
}

static ALWAYS_INLINE void paint_samples(const e3d_batch *batch, const paint_plan *plan, int channels, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, channels, shininess, color);
        samples_keep(batch->sample + i, color, V_LANES, plan->paint->samples);
    }
}

static ALWAYS_INLINE void paint_pixels(e3d_batch *batch, const paint_plan *plan, int channels, float shininess, uint32_t *rgba)
{
    if (plan->paint->samples)
        paint_samples(batch, plan, channels, shininess);
    else if (plan->paint->srgb)
        paint_srgb(batch, plan, channels, shininess, rgba);
    else
        paint_linear(batch, plan, channels, shininess, rgba);
}

static void kernel_put(const e3d_batch *batch, int srgb, uint32_t *rgba)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_load(batch, i, color);
        int lanes = batch->count - i < V_LANES ? batch->count - i : V_LANES;
        paint_store(batch->sample + i, encode_vector(color, srgb), lanes, rgba);
    }
}

static void kernel_paint(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba)
{
    texture_plan texture;
    paint_plan plan = {.paint = paint, .texture = &texture};
    int channels = paint_channels(paint->lighting);
    if (paint->wanted & E3D_WANT_SURFACE)
        kernel_interpolate(batch, surfaces, paint->wanted);
    plan.source = paint->texture ? paint_textured(batch, surfaces, paint, &texture) : paint_untextured(batch, surfaces, paint);
    if (!channels)
        paint_pixels(batch, &plan, 0, 0.0f, rgba);
    else if (paint->shininess > 0.0f)
        paint_pixels(batch, &plan, 3, paint->shininess, rgba);
    else if (channels == 1)
        paint_pixels(batch, &plan, 1, 0.0f, rgba);
    else
        paint_pixels(batch, &plan, 3, 0.0f, rgba);
}
