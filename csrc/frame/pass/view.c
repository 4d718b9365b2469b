/* prepare: what depends on the eye: viewport, grid of tiles, lights, and the clip matrix of each instance. */
#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "data/mesh/mesh.h"
#include "base/pool.h"
#include "data/sample_patterns.h"
#include "data/shadow_maps/shadows.h"
#include "frame/pass/boxes.h"
#include "frame/pass/facing.h"
#include "frame/pass/matrices.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"

static float guard_factor(double half)
{
    double factor = 1;
    while (factor * 2 <= E3D_GUARD / half)
        factor *= 2;
    return (float)factor;
}

static void find_viewport(e3d_view *view, const e3d_frame *frame)
{
    e3d_viewport *v = &view->viewport;
    v->width = frame->width * frame->samples_axis;
    v->height = frame->height * frame->samples_axis;
    v->scale_x = 128.0f * (float)v->width;
    v->scale_y = 128.0f * (float)v->height;
    v->guard_x = guard_factor(v->width / 2.0);
    v->guard_y = guard_factor(v->height / 2.0);
    v->pattern = frame->msaa_samples ? e3d_sample_pattern_of(frame->msaa_samples) : NULL;
    v->reach = v->pattern ? v->pattern->reach : 0;
    view->tiles_x = (v->width + E3D_TILE - 1) / E3D_TILE;
    view->tiles_y = (v->height + E3D_TILE - 1) / E3D_TILE;
}

static void find_apertures(e3d_view *view, const e3d_frame *frame)
{
    const int32_t axis = frame->samples_axis;
    view->aperture_count = frame->cull == E3D_CULL_BACK ? frame->aperture_count : 0;
    for (int32_t i = 0; i < view->aperture_count; i++) {
        const e3d_aperture *w = &frame->apertures[i];
        view->apertures[i] = (e3d_box){axis * w->x0, axis * w->y0, axis * w->x1 + axis - 1, axis * w->y1 + axis - 1};
    }
}

/* The shadow maps of a frame without any. */
static const e3d_shadow_map NO_MAPS;

/* R154: finds what a white matt surface shows of each light. */
static void find_shown(const e3d_frame *frame, float (*shown)[3])
{
    for (int32_t n = 0; n < frame->light_count; n++)
        for (int k = 0; k < 3; k++)
            shown[n][k] = frame->lights[n].color[k] * E3D_OVER_PI;
}

/* Copies the lights' positions and ranges into the arrays of the light kernel, which works on a vector of lights at a time. */
static int find_lights(e3d_view *view, const e3d_frame *frame)
{
    e3d_lighting *lighting = &view->lighting;
    size_t room = (size_t)frame->light_count + E3D_PAD;
    if (!e3d_array_reserve(&view->reach_memory, 8 * room, sizeof(float)))
        return 0;
    float *rows = view->reach_memory.data;
    for (int k = 0; k < 5; k++)
        lighting->reach[k] = rows + (size_t)k * room;
    for (size_t n = 0; n < room; n++) {
        const e3d_light *light = n < (size_t)frame->light_count ? &frame->lights[n] : NULL;
        int point = light && e3d_light_traits_of(light->kind).has_position;
        for (int k = 0; k < 3; k++)
            rows[(size_t)k * room + n] = point ? light->position[k] : 0.0f;
        rows[3 * room + n] = point ? light->range * light->range : NAN;
        rows[4 * room + n] = 1.0f / rows[3 * room + n];
    }
    float (*shown)[3] = (float (*)[3])(rows + 5 * room);
    find_shown(frame, shown);
    lighting->shown = (const float (*)[3])shown;
    lighting->lights = frame->lights;
    lighting->light_count = frame->light_count;
    memcpy(lighting->ambient, frame->ambient, sizeof frame->ambient);
    memcpy(lighting->clamp, frame->light_clamp, sizeof frame->light_clamp);
    memcpy(lighting->eye, frame->eye, sizeof frame->eye);
    lighting->exposure = frame->exposure;
    lighting->environment = frame->environment.environment ? &frame->environment : NULL;
    lighting->ambient_terms = frame->ambient_light.is_given ? frame->ambient_light.terms : NULL;
    lighting->has_visibility = frame->ambient_visibility != NULL;
    lighting->has_area_lights = e3d_has_area_lights(frame);
    lighting->shadows = NULL;
    view->unshadowed = *lighting;
    if (e3d_has_shadows(frame))
        lighting->shadows = frame->shadow_maps ? frame->shadow_maps : &NO_MAPS;
    return 1;
}

static void find_fog(e3d_view *view, const e3d_fog *fog)
{
    for (int lit = 0; lit < 2; lit++) {
        e3d_fog_view *out = &view->fog[lit];
        out->kind = fog->kind;
        out->near = fog->near;
        out->scale = 1.0f / (fog->far - fog->near);
        out->density = fog->density;
        memcpy(out->row, view->rows + 8, sizeof out->row);
        memcpy(out->color, lit ? fog->lit_color : fog->color, sizeof out->color);
    }
}

void e3d_view_free(e3d_view *view)
{
    e3d_array_free(&view->instance_memory);
    e3d_array_free(&view->reach_memory);
}

/* ---- instances ---- */

/* Finds what follows from the world matrix, in float64; the clip matrix is known already. */
static void finish(const e3d_view *view, const double world[16], e3d_instance *instance, e3d_view_instance *out)
{
    for (int k = 0; k < 12; k++)
        instance->world[k] = (float)world[k];
    out->mirrored = e3d_normal_matrix(world, instance->normal) != view->mirrors;
    e3d_facing_prepare(&view->viewport, out->clip, &out->facing);
    out->ready = 1;
}

void e3d_view_finish_instance(e3d_view *view, e3d_draws *draws, uint32_t number)
{
    double world[16];
    e3d_instance *instance = &draws->instances[number];
    const e3d_draw_state *state = &draws->states[instance->draw];
    e3d_world_matrix(state->draw, (int32_t)(number - state->instance_base), world);
    finish(view, world, instance, &view->instances[number]);
}

/* What all threads do with the instances. */
typedef struct instances_job {
    e3d_view *view;
    const e3d_view *frustum;
    const double *clip_from_world;
    e3d_draws *draws;
    const e3d_frame *frame;
    atomic_llong next;
} instances_job;

static void find_instance(const instances_job *job, const e3d_draw_state *state, int64_t number)
{
    const e3d_frame *frame = job->frame;
    const e3d_draw *draw = state->draw;
    const e3d_mesh *mesh = draw->mesh;
    e3d_view_instance *out = &job->view->instances[number];
    double world[16];
    e3d_world_matrix(draw, (int32_t)(number - state->instance_base), world);
    e3d_clip_matrix(job->clip_from_world, world, out->clip);
    int one = mesh->group_count == 1; /* the mesh has one box, which one thread tests soon */
    int later = one && e3d_culls_parts(frame); /* the instance is finished later, if its box isn't hidden */
    out->shows = mesh->desc.components == 4 || !e3d_culls_parts(frame) ||
                 (mesh->any_finite && (one || e3d_box_state(out->clip, mesh->lo, mesh->hi) != E3D_BOX_OUTSIDE));
    out->ready = 0;
    if (state->units || (job->frustum->instances[number].shows && !later)) /* lines and points are wider than the box */
        finish(job->view, world, &job->draws->instances[number], out);
}

enum { INSTANCES_A_TASK = 256 };

static void instances_work(void *argument, int worker)
{
    instances_job *job = argument;
    e3d_draws *draws = job->draws;
    (void)worker;
    for (;;) {
        int64_t first = atomic_fetch_add(&job->next, INSTANCES_A_TASK);
        if (first >= draws->instance_count)
            return;
        const e3d_draw_state *state = e3d_draw_of_instance(draws, first);
        for (int64_t i = first; i < first + INSTANCES_A_TASK && i < draws->instance_count; i++) {
            while (i >= state->instance_base + state->draw->instances)
                state++;
            draws->instances[i].draw = (int32_t)(state - draws->states);
            if (state->draw->pose_kind != E3D_POSE_NODES)
                draws->instances[i].order = state->order + (uint32_t)(i - state->instance_base) * (uint32_t)state->primitives;
            find_instance(job, state, i);
        }
    }
}

int e3d_view_prepare(e3d_view *view, const e3d_view *frustum, const double clip_from_world[16], e3d_draws *draws, const e3d_frame *frame,
                     int threads)
{
    instances_job job = {.view = view, .frustum = frustum, .clip_from_world = clip_from_world, .draws = draws, .frame = frame};
    find_viewport(view, frame);
    find_apertures(view, frame);
    for (int k = 0; k < 12; k++)
        view->rows[k] = (float)frame->view_from_world[k];
    view->mirrors = e3d_mirrors(frame->view_from_world);
    find_fog(view, &frame->fog);
    if (!find_lights(view, frame) ||
        !e3d_array_reserve(&view->instance_memory, (size_t)draws->instance_count + 1, sizeof(e3d_view_instance)))
        return 0;
    view->instances = view->instance_memory.data;
    e3d_pool_run(draws->instance_count > 2 * INSTANCES_A_TASK ? threads : 1, instances_work, &job);
    return 1;
}
