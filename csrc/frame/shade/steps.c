/* shade: chooses the steps of a batch, by its bucket and its sink (R20-R32, R80-R84).
 * In: a batch of samples whose surfaces are known.
 * Out: pixels and outputs, or samples, or layers, or alphas. */
#include <string.h>

#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/fog.h"
#include "kernels/types/shading.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"
#include "frame/shade/alpha_batch.h"
#include "frame/shade/ambient.h"
#include "frame/shade/backlight.h"
#include "frame/shade/bend.h"
#include "frame/shade/texture_slots.h"
#include "frame/shade/mirrors.h"
#include "frame/shade/modes.h"
#include "frame/shade/receivers.h"
#include "frame/shade/steps.h"
#include "frame/shade/surface.h"
#include "frame/shade/values.h"
#include "frame/store/blank.h"
#include "frame/store/resolve.h"

static e3d_batch *batch_of(const e3d_steps *s) { return &s->out->memory->batch; }

/* Clears some rows of empty tiles between batches. */
static void clear_tiles(const e3d_steps *s) { e3d_blank_some(s->in->store, s->in->bins, s->out->blank); }

static void count_samples(const e3d_steps *s) { s->out->memory->shaded += batch_of(s)->count; }

/* ---- surfaces ---- */

static void interpolate(const e3d_steps *s) { s->pass->kernels->interpolate(batch_of(s), &s->out->memory->surfaces, s->wanted); }

static void find_textures(const e3d_steps *s) { e3d_find_texture_batch(s->pass, s->bucket, s->wanted, s->out->memory); }

static void find_albedo(const e3d_steps *s)
{
    const e3d_bucket *bucket = s->bucket;
    const e3d_surfaces *surfaces = &s->out->memory->surfaces;
    e3d_batch *batch = batch_of(s);
    const float *base = bucket->material->color;
    for (int k = 0; k < 3 && !bucket->textured; k++)
        for (int i = 0; i < batch->count; i++)
            batch->color[k][i] = base[k];
    if (bucket->textured)
        s->pass->kernels->texture(batch, surfaces, e3d_texture_get_view(bucket->material->texture.texture), base);
    if (bucket->by_vertex || bucket->by_instance)
        s->pass->kernels->tint(batch, surfaces, bucket->by_vertex, bucket->by_instance);
}

static void put_outputs(const e3d_steps *s) { e3d_outputs_batch(s->in->store, s->bucket, s->out->memory, s->out->pixels); }

/* ---- radiance ---- */

static void find_visibility(const e3d_steps *s) { e3d_find_visibility(s->pass, s->out); }

static float shininess_of(const e3d_material *m) { return e3d_adds(m->specular) ? m->shininess : 0.0f; }

static void add_area_lights(const e3d_steps *s)
{
    s->pass->kernels->area_light(batch_of(s), e3d_lighting_of(s->pass->view, s->bucket->unshadowed), shininess_of(s->bucket->material));
}

static void light(const e3d_steps *s)
{
    const e3d_prepared *pass = s->pass;
    const e3d_material *m = s->bucket->material;
    pass->kernels->light(batch_of(s), e3d_lighting_of(pass->view, s->bucket->unshadowed), shininess_of(m));
    pass->kernels->combine(batch_of(s), e3d_adds(m->specular) ? m->specular : NULL, m->emissive, pass->view->lighting.exposure);
}

static void light_physical(const e3d_steps *s) { e3d_light_physical(s->pass, s->bucket, s->out->memory); }

static void show_mode(const e3d_steps *s) { e3d_show_mode(s->pass, s->out->memory); }

static const e3d_fog_view *fog_of(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return e3d_plans(pass, E3D_PLAN_ADDS_FOG) ? &pass->view->fog[bucket->lit] : NULL;
}

/* R121 */
static void add_fog(const e3d_steps *s)
{
    e3d_batch *batch = batch_of(s);
    float *const color[3] = {batch->color[0], batch->color[1], batch->color[2]};
    const e3d_lane_array *places = e3d_batch_places(batch);
    const float *const position[3] = {places[0], places[1], places[2]};
    s->pass->kernels->fog(fog_of(s->pass, s->bucket), position, batch->count, color);
}

/* Whether light passes that brings the fog of its whole way. */
static int clears_haze(const e3d_steps *s) { return s->bucket->transmits && fog_of(s->pass, s->bucket); }

static int needs_haze(const e3d_steps *s) { return clears_haze(s) || (s->bucket->mirrors && s->bucket->material->is_physical); }

/* Finds what fog makes of black. */
static void find_haze(const e3d_steps *s)
{
    e3d_mirror_batch *mirrors = &s->out->memory->mirrors;
    const e3d_lane_array *places = e3d_batch_places(batch_of(s));
    const float *const position[3] = {places[0], places[1], places[2]};
    float *const haze[3] = {mirrors->haze[0], mirrors->haze[1], mirrors->haze[2]};
    memset(mirrors->haze, 0, sizeof mirrors->haze);
    if (e3d_plans(s->pass, E3D_PLAN_ADDS_FOG))
        s->pass->kernels->fog(&s->pass->view->fog[1], position, batch_of(s)->count, haze);
}

/* R121, of what transmits. */
static void clear_haze(const e3d_steps *s, e3d_lane_array colors[3])
{
    const e3d_shade_memory *memory = s->out->memory;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < memory->batch.count; i++) {
            float rest = colors[k][i] - memory->textures.batch.through[k][i] * memory->mirrors.haze[k][i];
            colors[k][i] = rest > 0.0f ? rest : 0.0f;
        }
}

static void clear_radiance(const e3d_steps *s) { clear_haze(s, s->out->memory->light); }

static void put_radiance(const e3d_steps *s) { e3d_outputs_radiance(s->in->store, batch_of(s), s->out->pixels); }

static void keep_radiance(const e3d_steps *s) { memcpy(s->out->memory->light, batch_of(s)->color, sizeof s->out->memory->light); }

static e3d_tone_mapping tone_of(const e3d_steps *s) { return s->bucket->lit ? s->pass->frame->tone_mapping : E3D_TONE_NONE; }

/* R117, and clamps */
static void map_planes(const e3d_steps *s, e3d_lane_array colors[3])
{
    float *const color[3] = {colors[0], colors[1], colors[2]};
    s->pass->kernels->tone(tone_of(s), color, batch_of(s)->count);
}

static void map_tone(const e3d_steps *s) { map_planes(s, batch_of(s)->color); }

static void clear_color(const e3d_steps *s)
{
    map_planes(s, s->out->memory->mirrors.haze);
    clear_haze(s, batch_of(s)->color);
}

/* ---- pixels ---- */

static void put_pixels(const e3d_steps *s) { e3d_resolve_batch(s->in->store, batch_of(s), s->out->pixels); }

static void put_background(const e3d_steps *s) { e3d_resolve_hidden(s->in->store, batch_of(s), s->out->pixels); }

/* Runs the fused kernel. It writes pixels or, for a list, leaves colours in the batch. */
static void paint(const e3d_steps *s)
{
    const e3d_prepared *pass = s->pass;
    const e3d_bucket *bucket = s->bucket;
    const e3d_material *m = bucket->material;
    const e3d_shade_out *out = s->out;
    int to_pixels = out->sink == E3D_SINK_PIXELS, shiny = e3d_adds(m->specular);
    const e3d_paint paint = {
        .wanted = s->wanted,
        .texture = bucket->textured ? e3d_texture_get_view(m->texture.texture) : NULL,
        .base = m->color,
        .by_vertex = bucket->by_vertex,
        .by_instance = bucket->by_instance,
        .lighting = bucket->lit ? e3d_lighting_of(pass->view, bucket->unshadowed) : NULL,
        .shininess = shininess_of(m),
        .specular = shiny ? m->specular : NULL,
        .emissive = e3d_adds(m->emissive) ? m->emissive : NULL,
        .srgb = e3d_plans(pass, E3D_PLAN_ENCODES_SRGB),
        .samples = out->pixels->sampled && to_pixels ? &out->pixels->samples : NULL,
        .fog = fog_of(pass, bucket),
        .tone = tone_of(s),
    };
    pass->kernels->paint(&out->memory->batch, &out->memory->surfaces, &paint, to_pixels ? out->pixels->rgba : NULL);
}

/* ---- which of them ---- */

static void add(e3d_steps *s, int is_taken, e3d_shade_step step)
{
    if (is_taken)
        s->step[s->count++] = step;
}

static int finds_alphas(e3d_sink sink) { return sink == E3D_SINK_ALPHA_TEST || sink == E3D_SINK_A_BUFFER || sink == E3D_SINK_SAMPLES; }

/* Whether the samples themselves show, and nothing behind them. */
static int is_solid(e3d_sink sink) { return sink == E3D_SINK_PIXELS || sink == E3D_SINK_SOLID; }

/* Whether the fused kernel is used: samples are painted straight to where colours are kept. */
static int is_painted(const e3d_steps *s)
{
    return is_solid(s->out->sink) && e3d_plans(s->pass, E3D_PLAN_PAINTS) && !s->bucket->mapped && !s->bucket->mirrors &&
           !s->bucket->hidden;
}

static void add_surface_steps(e3d_steps *s)
{
    int tests = s->out->sink == E3D_SINK_ALPHA_TEST;
    add(s, s->wanted & E3D_WANT_SURFACE, interpolate);
    add(s, s->bucket->mapped, find_textures);
    add(s, !s->bucket->mapped && !tests && e3d_plans(s->pass, E3D_PLAN_BASE_COLOR), find_albedo);
}

static void add_radiance_steps(e3d_steps *s)
{
    const e3d_bucket *bucket = s->bucket;
    add(s, bucket->lit, find_visibility);
    add(s, bucket->translucent, e3d_find_backlight);
    add(s, e3d_receives_exact_shadows(s->pass, bucket), e3d_hide_lights);
    add(s, bucket->mirrors, e3d_find_mirrors);
    add(s, bucket->lit && !bucket->material->is_physical && e3d_plans(s->pass, E3D_PLAN_ADDS_AREA_LIGHTS), add_area_lights);
    add(s, bucket->lit, bucket->material->is_physical ? light_physical : light);
    add(s, !e3d_has_light_or_color(s->pass->frame), show_mode);
    add(s, fog_of(s->pass, bucket) != NULL, add_fog);
    add(s, needs_haze(s), find_haze);
    add(s, bucket->mirrors, e3d_lay_mirrors);
}

static void add_pixel_steps(e3d_steps *s)
{
    int colors = e3d_plans(s->pass, E3D_PLAN_COLORS), radiance = e3d_plans(s->pass, E3D_PLAN_KEEPS_RADIANCE), hidden = s->bucket->hidden;
    add(s, e3d_plans(s->pass, E3D_PLAN_OUTPUTS), put_outputs);
    if (radiance || (colors && !hidden))
        add_radiance_steps(s);
    add(s, radiance, put_radiance);
    add(s, colors && !hidden && tone_of(s) != E3D_TONE_NONE, map_tone);
    add(s, colors, hidden ? put_background : put_pixels);
}

static void add_alpha_steps(e3d_steps *s)
{
    e3d_sink sink = s->out->sink;
    if (sink != E3D_SINK_ALPHA_TEST) {
        add_radiance_steps(s);
        add(s, s->bucket->bends, e3d_find_bends);
        add(s, s->out->list->light != NULL, keep_radiance);
        add(s, s->out->list->light != NULL && clears_haze(s), clear_radiance);
        add(s, tone_of(s) != E3D_TONE_NONE || clears_haze(s), map_tone);
        add(s, clears_haze(s), clear_color);
    }
    add(s, finds_alphas(sink), e3d_find_alphas);
    add(s, sink == E3D_SINK_ALPHA_TEST, e3d_keep_alphas);
    add(s, sink == E3D_SINK_A_BUFFER, e3d_keep_layers);
    add(s, sink == E3D_SINK_SAMPLES && !s->bucket->hidden, e3d_lay_batch);
    add(s, sink == E3D_SINK_SOLID, e3d_keep_solid);
}

/* The inputs that the batches of a bucket need of their surfaces. IDs need none. */
static int wanted_to_show(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    int wanted = e3d_plan_inputs(pass->plan), colored = e3d_plans(pass, E3D_PLAN_BASE_COLOR);
    if (bucket->mapped)
        wanted |= E3D_WANT_WEIGHTS | E3D_WANT_TEXTURES;
    else if (bucket->textured && colored)
        wanted |= e3d_texture_wanted(e3d_texture_get_view(bucket->material->texture.texture));
    if (colored && bucket->by_vertex)
        wanted |= E3D_WANT_WEIGHTS;
    if (wanted || (colored && bucket->by_instance))
        wanted |= E3D_WANT_SURFACE;
    if (pass->frame->normals == E3D_NORMALS_FACET && bucket->lit && wanted & E3D_WANT_POSITION)
        wanted |= E3D_WANT_FACET;
    if (wanted & E3D_WANT_NORMAL && e3d_wants_curvature(pass, bucket))
        wanted |= E3D_WANT_CURVATURE;
    if (e3d_receives_exact_shadows(pass, bucket) && e3d_has_smooth_normals(bucket))
        wanted |= E3D_WANT_WEIGHTS;
    return bucket->flat ? wanted | E3D_WANT_FLAT : wanted;
}

static int wanted_of(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_sink sink)
{
    int alpha = finds_alphas(sink) ? e3d_alpha_wanted(bucket) : 0;
    return sink == E3D_SINK_ALPHA_TEST ? alpha : alpha | wanted_to_show(pass, bucket);
}

e3d_steps e3d_choose_steps(const e3d_shade_in *in, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    e3d_sink sink = out->sink;
    e3d_steps s = {.in = in, .pass = in->pass, .bucket = bucket, .out = out, .wanted = wanted_of(in->pass, bucket, sink)};
    add(&s, sink == E3D_SINK_PIXELS, clear_tiles);
    add(&s, sink != E3D_SINK_ALPHA_TEST && sink != E3D_SINK_OUTPUTS, count_samples);
    if (is_painted(&s)) {
        add(&s, bucket->lit, find_visibility);
        add(&s, 1, paint);
        add(&s, sink == E3D_SINK_SOLID, e3d_keep_solid);
        return s;
    }
    add_surface_steps(&s);
    if (sink == E3D_SINK_OUTPUTS)
        add(&s, 1, put_outputs);
    else if (sink == E3D_SINK_PIXELS)
        add_pixel_steps(&s);
    else
        add_alpha_steps(&s);
    return s;
}
