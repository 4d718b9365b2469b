/* Draws a scene for one output after another, and checks that each is what it is beside all others.
 *
 * What is not asked for is not computed, and so each set of outputs takes another way through a tile. Every output is asked for
 * alone, and with another one or left out of all; over the scenes each meets each, in every mode and with whatever there is of
 * alpha, shadows and environments.
 */
#include "check/driver/outputs.h"

#include <stdio.h>

#include "check/driver/picture.h"
#include "check/driver/renderers.h"
#include "check/driver/scenes.h"
#include "check/driver/scenes/shadow_scene.h"

enum { ALL = (1 << E3D_OUTPUTS) - 1,
       MOST_SIDE = 66, /* more than a tile */
       OTHER_MODES = E3D_MODE_OVERDRAW - E3D_MODE_UNLIT,
       THREADS = 1 };

static picture draw(e3d_renderer *renderer, const e3d_frame *frame, uint32_t mask, int poison)
{
    picture p = picture_create((size_t)frame->width * (size_t)frame->height, mask, poison);
    e3d_targets targets = picture_targets(&p);
    e3d_stats stats;
    p.status = e3d_render(renderer, frame, &targets, &stats);
    return p;
}

static int is_same(e3d_renderer *renderer, const e3d_frame *frame, uint32_t mask, const picture *all, const char *title, const char *run)
{
    char label[64];
    snprintf(label, sizeof label, "%s, outputs %05x", run, (unsigned)mask);
    picture p = draw(renderer, frame, mask, 0xC3);
    int same = picture_is_same(all, &p, title, label);
    picture_destroy(&p);
    return same;
}

static int try_backend(e3d_backend backend, const e3d_frame *frame, random_stream r, const picture *all, const char *title)
{
    e3d_renderer *renderer = NULL;
    int same = renderer_take(backend, THREADS, &renderer) == E3D_OK;
    for (int k = 0; k < E3D_OUTPUTS && renderer; k++) {
        uint32_t one = 1u << k, other = 1u << random_below(&r, E3D_OUTPUTS), most = random_once_in(&r, 3) ? ALL & ~one : one | other;
        same &= is_same(renderer, frame, one, all, title, e3d_backend_name(backend));
        same &= is_same(renderer, frame, most, all, title, e3d_backend_name(backend));
    }
    renderer_return(renderer);
    return same;
}

static outcome compare_all(const e3d_frame *frame, random_stream r, const run_plan *plan, const char *title)
{
    e3d_renderer *renderer = NULL;
    e3d_backend pattern = E3D_BACKEND_SCALAR;
    while (!plan->backends[pattern])
        pattern++;
    outcome result = {.status = renderer_take(pattern, THREADS, &renderer), .agrees = 1};
    if (result.status != E3D_OK)
        return result;
    picture all = draw(renderer, frame, ALL, 0x5A);
    renderer_return(renderer);
    result.agrees = picture_has_no_nan(&all, title, e3d_backend_name(pattern));
    for (e3d_backend k = E3D_BACKEND_SCALAR; k < E3D_BACKEND_COUNT; k++)
        if (plan->backends[k] && (k != E3D_BACKEND_SCALAR || pattern != k))
            result.agrees &= try_backend(k, frame, r, &all, title);
    result.status = all.status;
    result.hash = picture_hash(&all);
    picture_destroy(&all);
    return result;
}

/* Whole tiles show something then: what is filled beforehand is not needed there. */
static void come_close(e3d_frame *frame, random_stream *r)
{
    double times = random_float(r, 2.0f, 20.0f);
    for (int k = 0; k < 8; k++)
        frame->clip_from_world[k] *= times;
}

outcome compare_outputs(random_stream r, const run_plan *plan, const char *title)
{
    scene s;
    r.state ^= 0x0075; /* other scenes than those of the other kinds */
    outcome result = {.status = scene_create(&s, &r, MOST_SIDE), .agrees = 1};
    if (random_once_in(&r, 2))
        scene_add_alpha(&s, &r);
    if (random_once_in(&r, 2))
        scene_add_shadows(&s, &r);
    if (result.status == E3D_OK && random_once_in(&r, 4))
        result.status = scene_add_environment(&s, &r);
    if (random_once_in(&r, 2))
        come_close(&s.frame, &r);
    if (random_once_in(&r, 4))
        s.frame.normals = E3D_NORMALS_FACET;
    const e3d_mode modes[] = {(e3d_mode)random_below(&r, E3D_MODE_UNLIT + 1), (e3d_mode)(E3D_MODE_RANDOM + random_below(&r, OTHER_MODES))};
    outcome found = {.hash = HASH_START, .status = result.status, .agrees = 1};
    for (int m = 0; m < 2 && found.status == E3D_OK; m++) {
        s.frame.mode = modes[m];
        result = compare_all(&s.frame, r, plan, title);
        found.hash = hash_bytes(found.hash, (const uint8_t *)&result.hash, sizeof result.hash);
        found.status = result.status;
        found.agrees &= result.agrees;
    }
    scene_destroy(&s);
    return found;
}
