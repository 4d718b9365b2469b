/* Draws a scene with every backend and thread count, and checks that the bytes agree.
 *
 * The first run is the pattern; each later one is compared with it output by output, so that a
 * difference is named with its backend, output and pixel.
 */
#include "check/driver/compare.h"

#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "check/driver/picture.h"
#include "check/driver/renderers.h"
#include "check/driver/scenes.h"
#include "check/driver/scenes/clip_triangles.h"
#include "check/driver/scenes/shadow_scene.h"

/* What other libraries in a process may have done: the core must neither notice nor undo it. */
static void disturb_floating_point(int disturb)
{
#if defined(FE_UPWARD) /* WebAssembly rounds to nearest, always */
    fesetround(disturb ? FE_UPWARD : FE_TONEAREST);
#else
    (void)disturb;
#endif
#if defined(__x86_64__)
    const unsigned flush = 0x8040; /* flush to zero, denormals are zero */
    _mm_setcsr(disturb ? _mm_getcsr() | flush : _mm_getcsr() & ~flush);
#elif defined(__aarch64__)
    uint64_t flush = (uint64_t)1 << 24, control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    control = disturb ? control | flush : control & ~flush;
    __asm__ volatile("msr fpcr, %0" : : "r"(control));
#endif
}

typedef e3d_status draw_function(const void *data, e3d_backend backend, int32_t threads,
                                 const e3d_targets *targets);

static void spoil(void *pixels, const e3d_frame *frame)
{
    if (pixels)
        memset(pixels, 0x5A, 4 * (size_t)frame->width * (size_t)frame->height);
}

/* Draws the IDs once more, without anything else: they take the shortest way of all. */
static e3d_status draw_ids(e3d_renderer *renderer, const e3d_frame *frame, const e3d_targets *targets)
{
    const e3d_targets ids = {.face_id = targets->face_id,
                             .object_id = targets->object_id,
                             .instance_id = targets->instance_id,
                             .material_id = targets->material_id};
    e3d_stats stats;
    spoil(ids.face_id, frame);
    spoil(ids.object_id, frame);
    spoil(ids.instance_id, frame);
    spoil(ids.material_id, frame);
    return e3d_render(renderer, frame, &ids, &stats);
}

static e3d_status draw_scene(const void *data, e3d_backend backend, int32_t threads,
                             const e3d_targets *targets)
{
    /* Each number of threads leaves out something else; the most draw a second time, with what they remember. */
    static const e3d_culling CULLING[] = {E3D_CULLING_ALWAYS, E3D_CULLING_ALL, E3D_CULLING_NONE};
    e3d_frame frame = ((const scene *)data)->frame;
    frame.culling = CULLING[threads <= 3 ? threads - 1 : 0];
    e3d_renderer *renderer = NULL;
    e3d_status status = renderer_take(backend, threads, &renderer);
    if (status != E3D_OK)
        return status;
    e3d_stats stats;
    for (int times = threads > 3 ? 2 : 1; status == E3D_OK && times > 0; times--)
        status = e3d_render(renderer, &frame, targets, &stats);
    /* Colour alone takes a shorter way, and so does whatever needs no depths. */
    if (status == E3D_OK && threads > 1 && targets->color) {
        e3d_targets fewer = {.color = targets->color};
        if (threads % 2 == 1)
            fewer = *targets;
        fewer.ndc_depth = NULL;
        spoil(fewer.color, &frame);
        status = e3d_render(renderer, &frame, &fewer, &stats);
    }
    if (status == E3D_OK && threads > 1)
        status = draw_ids(renderer, &frame, targets);
    renderer_return(renderer);
    return status;
}

static e3d_status draw_clip_triangles(const void *data, e3d_backend backend, int32_t threads,
                                      const e3d_targets *targets)
{
    const clip_triangles *t = data;
    const e3d_clip_triangles colored = {.clip = t->clip,
                                        .colors = t->colors,
                                        .vertices = t->vertices,
                                        .faces = t->faces,
                                        .faces_count = t->faces_count,
                                        .looks = t->looks};
    e3d_status status = e3d_draw_clip(&colored, t->width, t->height, t->samples, backend, threads, targets->color);
    if (status != E3D_OK)
        return status;
    return e3d_rasterize(t->clip, t->vertices, t->faces, t->faces_count, t->width, t->height,
                         t->cull, backend, threads, targets->face_id, targets->ndc_depth,
                         targets->barycentric);
}

/* What is drawn: a scene or clip-space triangles, and the outputs asked for. */
typedef struct drawing {
    draw_function *draw;
    const void *data;
    size_t pixels;
    uint32_t mask;
} drawing;

static picture draw_once(const drawing *what, e3d_backend backend, int32_t threads, int run)
{
    picture p = picture_create(what->pixels, what->mask, 0xA5 + 7 * run);
    e3d_targets targets = picture_targets(&p);
    disturb_floating_point(run % 2);
    p.status = what->draw(what->data, backend, threads, &targets);
    disturb_floating_point(0);
    return p;
}

static outcome compare(const drawing *what, const run_plan *plan, const char *title)
{
    outcome result = {.agrees = 1};
    picture pattern = {0};
    int run = 0;
    for (e3d_backend backend = 0; backend < E3D_BACKEND_COUNT; backend++) {
        /* The reference has one thread, whatever it is told. */
        int32_t count = backend == E3D_BACKEND_SCALAR ? 1 : plan->thread_counts;
        for (int32_t i = 0; i < count && plan->backends[backend]; i++) {
            char label[64];
            snprintf(label, sizeof label, "%s, %d threads", e3d_backend_name(backend),
                     (int)plan->threads[i]);
            picture p = draw_once(what, backend, plan->threads[i], run);
            result.agrees &= picture_has_no_nan(&p, title, label);
            if (run++ == 0) {
                pattern = p;
                continue;
            }
            result.agrees &= picture_is_same(&pattern, &p, title, label);
            picture_destroy(&p);
        }
    }
    result.status = pattern.status;
    result.hash = picture_hash(&pattern);
    picture_destroy(&pattern);
    return result;
}

/* What is added to a scene; NULL: nothing. */
typedef void (*scene_change)(scene *s, random_stream *r);

static outcome compare_made(random_stream r, scene_change change, const run_plan *plan, const char *title)
{
    scene s;
    /* Most scenes ask for everything; the others show that no output depends on another. */
    uint32_t mask = random_once_in(&r, 3) ? (uint32_t)random_bits(&r) : 0xFFFFFFFFu;
    outcome result = {.status = scene_create(&s, &r, plan->most_side), .agrees = 1};
    if (change)
        change(&s, &r);
    if (result.status == E3D_OK) {
        drawing all = {draw_scene, &s, 0, mask};
        all.pixels = (size_t)s.frame.width * (size_t)s.frame.height;
        result = compare(&all, plan, title);
    }
    scene_destroy(&s);
    return result;
}

outcome compare_scene(random_stream r, const run_plan *plan, const char *title) { return compare_made(r, NULL, plan, title); }

outcome compare_alpha(random_stream r, const run_plan *plan, const char *title) { return compare_made(r, scene_add_alpha, plan, title); }

outcome compare_shadows(random_stream r, const run_plan *plan, const char *title) { return compare_made(r, scene_add_shadows, plan, title); }

outcome compare_rasterize(random_stream r, const run_plan *plan, const char *title)
{
    clip_triangles t = clip_triangles_create(&r, plan->most_side);
    uint32_t mask = 1u << E3D_OUTPUT_COLOR | 1u << E3D_OUTPUT_NDC_DEPTH | 1u << E3D_OUTPUT_FACE_ID | 1u << E3D_OUTPUT_BARYCENTRIC;
    drawing all = {draw_clip_triangles, &t, (size_t)t.width * (size_t)t.height, mask};
    outcome result = compare(&all, plan, title);
    clip_triangles_destroy(&t);
    return result;
}

outcome compare_hashes(hash_of find, const void *input, const run_plan *plan, const char *title)
{
    outcome result = {.agrees = 1};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        for (int32_t t = 0; t < plan->thread_counts && plan->backends[k]; t++) {
            uint64_t hash = find(input, (e3d_backend)k, plan->threads[t]);
            result.hash = result.hash == 0 ? hash : result.hash;
            if (hash != 0 && hash == result.hash)
                continue;
            result.agrees = 0;
            if (title != NULL)
                fprintf(stderr, "%s: %s with %d threads differs, or fails\n", title, e3d_backend_name((e3d_backend)k), (int)plan->threads[t]);
        }
    return result;
}

outcome compare_thread_counts(hash_of find, const void *input, const run_plan *plan, const char *title)
{
    run_plan one = *plan;
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        one.backends[k] = k == E3D_BACKEND_SCALAR;
    return compare_hashes(find, input, &one, title);
}
