/* paint: a batch of samples to pixels at once (R19-R34): the other kernels one after the other, but light goes to pixels
 * through registers, and only where it is to be seen.
 */

/* R31 of all lights: there are few. */
static ALWAYS_INLINE void paint_light(const e3d_batch *batch, int i, const e3d_paint *paint, float shininess, vf32 color[3])
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
        light_one(lighting, n, shininess, &lit);
    for (int k = 0; k < 3; k++)
        lit.energy[k] = light_clamp(lighting, lit.energy[k]);
    combine_vector(lit.energy, lit.shine, paint->specular, paint->emissive, color);
}

/* The first lanes of a vector: all, where those past the batch's end are the last sample again. */
static ALWAYS_INLINE void paint_store(const int32_t *sample, vi32 pixels, int lanes, uint32_t *rgba)
{
    if (samples_are_neighbours(sample)) {
        v_storei(rgba + sample[0], pixels);
        return;
    }
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

static inline void paint_albedo(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint)
{
    const e3d_texture_view *texture = paint->texture;
    if (texture && texture->filter == E3D_TRILINEAR)
        kernel_select_level(batch, surfaces, texture);
    if (texture)
        kernel_texture(batch, texture, paint->base);
    else
        paint_base(batch, paint->base);
    kernel_tint(batch, surfaces, paint->by_vertex, paint->by_instance);
}

static ALWAYS_INLINE void paint_load(const e3d_batch *batch, int i, vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_loadf(batch->color[k] + i);
}

static ALWAYS_INLINE void paint_linear(const e3d_batch *batch, const e3d_paint *paint, float shininess, uint32_t *rgba)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_load(batch, i, color);
        paint_light(batch, i, paint, shininess, color);
        paint_store(batch->sample + i, encode_vector(color, 0), V_LANES, rgba);
    }
}

/* What a batch looks up in the table of R34. */
typedef struct paint_sums {
    _Alignas(64) int32_t of[3][E3D_BATCH + E3D_PAD]; /* the places, then what is there */
    int grey; /* of one channel, for all three */
} paint_sums;

static ALWAYS_INLINE void paint_find(e3d_batch *batch, const e3d_paint *paint, float shininess, paint_sums *sums)
{
    sums->grey = 1;
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_load(batch, i, color);
        paint_light(batch, i, paint, shininess, color);
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

static ALWAYS_INLINE void paint_srgb(e3d_batch *batch, const e3d_paint *paint, float shininess, uint32_t *rgba)
{
    paint_sums sums;
    paint_find(batch, paint, shininess, &sums);
    paint_look_up((batch->count + V_LANES - 1) / V_LANES * V_LANES, &sums);
    for (int i = 0; i < batch->count; i += V_LANES) {
        vi32 code[3];
        for (int k = 0; k < 3; k++)
            code[k] = encode_code(v_loadf(batch->color[k] + i), v_loadi(sums.of[sums.grey ? 0 : k] + i));
        paint_store(batch->sample + i, encode_pack(code), V_LANES, rgba);
    }
}

static ALWAYS_INLINE void paint_samples(const e3d_batch *batch, const e3d_paint *paint, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_load(batch, i, color);
        paint_light(batch, i, paint, shininess, color);
        samples_keep(batch->sample + i, color, V_LANES, paint->samples);
    }
}

static ALWAYS_INLINE void paint_pixels(e3d_batch *batch, const e3d_paint *paint, float shininess, uint32_t *rgba)
{
    if (paint->samples)
        paint_samples(batch, paint, shininess);
    else if (paint->srgb)
        paint_srgb(batch, paint, shininess, rgba);
    else
        paint_linear(batch, paint, shininess, rgba);
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
    if (paint->wanted & E3D_WANT_SURFACE)
        kernel_interpolate(batch, surfaces, paint->wanted);
    paint_albedo(batch, surfaces, paint);
    if (paint->lighting && paint->shininess > 0.0f)
        paint_pixels(batch, paint, paint->shininess, rgba);
    else if (paint->lighting)
        paint_pixels(batch, paint, 0.0f, rgba);
    else if (paint->samples)
        kernel_keep(batch, paint->samples);
    else
        kernel_put(batch, paint->srgb, rgba);
}
