/* paint: a batch of samples to pixels (R19-R34), in stages: what one leaves for the next waits in the nearest cache.
 *
 * A stage is short. Processors look ahead some hundred operations: so they find several vectors to work on at a time.
 */

/* One vector on its way. */
typedef struct paint_lanes {
    vf32 b[3], r, uv[2], position[3], normal[3], color[3];
    vi32 lod;
} paint_lanes;

typedef struct paint_work {
    const e3d_batch *batch;
    const e3d_surfaces *surfaces;
    const e3d_paint *paint;
    texture_plan plan;
    paint_lanes lanes[(E3D_BATCH + V_LANES - 1) / V_LANES];
} paint_work;

/* Of one vector: its first sample, the surfaces from that one's on, and whether all samples are of the same one. */
typedef struct paint_vector {
    int i, same;
    element_lanes elements;
    const e3d_surfaces *s;
    paint_lanes *lanes;
} paint_vector;

/* A stage over all vectors. */
static ALWAYS_INLINE void paint_each(paint_work *work, void (*stage)(paint_work *, const paint_vector *))
{
    for (int i = 0; i < work->batch->count; i += V_LANES) {
        paint_vector v = {.i = i, .elements = lanes_of(work->batch->surface + i), .lanes = &work->lanes[i / V_LANES]};
        v.s = surfaces_from(work->surfaces, &v.elements);
        v.same = v.elements.same;
        if (v.same) {
            v.same = 1; /* known when compiled */
            stage(work, &v);
        } else {
            stage(work, &v);
        }
    }
}

static ALWAYS_INLINE void paint_barycentric(paint_work *work, const paint_vector *v)
{
    vi32 sample = v_loadi(work->batch->sample + v->i);
    v->lanes->r = interpolate_barycentric(v->s, &v->elements, v->same, sample, v->lanes->b);
}

static ALWAYS_INLINE void paint_coordinates(paint_work *work, const paint_vector *v)
{
    (void)work;
    for (int k = 0; k < 2; k++)
        v->lanes->uv[k] = interpolate_one(v->s->uv[k], &v->elements, v->same, v->lanes->b);
}

static ALWAYS_INLINE void paint_level(paint_work *work, const paint_vector *v)
{
    v->lanes->lod = level_of(v->s, &v->elements, v->lanes->uv, v->lanes->r, work->paint->texture);
}

static ALWAYS_INLINE void paint_find(paint_work *work, int filter)
{
    for (int i = 0; i < work->batch->count; i += V_LANES) {
        const paint_lanes *lanes = &work->lanes[i / V_LANES];
        texture_find(&work->plan, filter, i, lanes->uv[0], lanes->uv[1], lanes->lod);
    }
}

static ALWAYS_INLINE void paint_read(paint_work *work, int filter, int texel_bytes)
{
    for (int i = 0; i < work->batch->count; i += V_LANES) {
        texel_lanes texel = texture_read(&work->plan, filter, texel_bytes, i);
        texture_color(&texel, work->paint->base, work->lanes[i / V_LANES].color);
    }
}

static ALWAYS_INLINE void paint_position(paint_work *work, const paint_vector *v)
{
    (void)work;
    for (int c = 0; c < 3; c++)
        v->lanes->position[c] = interpolate_one(v->s->position[c], &v->elements, v->same, v->lanes->b);
}

static ALWAYS_INLINE void paint_normal(paint_work *work, const paint_vector *v)
{
    int flat = work->paint->wanted & E3D_WANT_FLAT;
    interpolate_normal(v->s, &v->elements, v->same, flat, v->lanes->b, v->lanes->normal);
}

/* R31 of all lights: there are few. */
static ALWAYS_INLINE void paint_light(const e3d_paint *paint, float shininess, const paint_lanes *lanes, vf32 color[3])
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
    if (shininess > 0.0f)
        light_view(lighting, &lit);
    for (int n = 0; n < lighting->light_count; n++)
        light_one(lighting, n, shininess, &lit);
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

static ALWAYS_INLINE void paint_color(paint_work *work)
{
    const float *base = work->paint->base;
    for (int i = 0; i < work->batch->count; i += V_LANES)
        for (int k = 0; k < 3; k++)
            work->lanes[i / V_LANES].color[k] = v_setf(base[k]);
}

static ALWAYS_INLINE void paint_tint(paint_work *work, const paint_vector *v)
{
    const e3d_paint *paint = work->paint;
    tint_vector(v->s, &v->elements, v->lanes->b, paint->by_vertex, paint->by_instance, v->lanes->color);
}

/* The last stage: light, where there is some, and the pixels. */
static ALWAYS_INLINE void paint_pixels(paint_work *work, int lit, float shininess, uint32_t *rgba)
{
    const e3d_paint *paint = work->paint;
    for (int i = 0; i < work->batch->count; i += V_LANES) {
        paint_lanes *lanes = &work->lanes[i / V_LANES];
        if (lit)
            paint_light(paint, shininess, lanes, lanes->color);
        paint_store(work->batch->sample + i, encode_vector(lanes->color, paint->srgb), rgba);
    }
}

static ALWAYS_INLINE void paint_texture(paint_work *work)
{
    const e3d_texture_view *view = work->paint->texture;
    texture_begin(&work->plan, view);
    paint_each(work, paint_coordinates);
    if (view->filter == E3D_TRILINEAR)
        paint_each(work, paint_level);
    if (view->filter == E3D_BILINEAR)
        paint_find(work, E3D_BILINEAR);
    else
        paint_find(work, view->filter);
    texture_fetch(&work->plan, work->batch->count);
}

static void kernel_paint(const e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba)
{
    const e3d_texture_view *texture = paint->texture;
    paint_work work;
    work.batch = batch;
    work.surfaces = surfaces;
    work.paint = paint;
    if (paint->wanted & E3D_WANT_SURFACE)
        paint_each(&work, paint_barycentric);
    if (texture)
        paint_texture(&work);
    if (paint->wanted & E3D_WANT_POSITION)
        paint_each(&work, paint_position);
    if (paint->wanted & E3D_WANT_NORMAL)
        paint_each(&work, paint_normal);
    if (texture && texture->filter == E3D_BILINEAR && texture->texel_bytes == 4)
        paint_read(&work, E3D_BILINEAR, 4);
    else if (texture)
        paint_read(&work, texture->filter, texture->texel_bytes);
    else
        paint_color(&work);
    if (paint->by_vertex || paint->by_instance)
        paint_each(&work, paint_tint);
    if (paint->lighting && paint->shininess > 0.0f)
        paint_pixels(&work, 1, paint->shininess, rgba);
    else if (paint->lighting)
        paint_pixels(&work, 1, 0.0f, rgba);
    else
        paint_pixels(&work, 0, 0.0f, rgba);
}
