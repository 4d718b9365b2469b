/* Two passes of one scene: depths as they are seen from behind, then the colours.
 *
 * One renderer draws both passes in one call, frame after frame; two renderers draw one pass each. The bytes must be the same, and so
 * must be what each pass left out, once its view has a past of its own: it depends on what that view showed, and on nothing else.
 */
#include "check/driver/passes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check/driver/scenes.h"

enum { FRAMES = 7,
       VIEWS = 2 };
enum { SETTLED = 5 }; /* frames, after which a view no longer knows what it took over from another when it was new */

/* What the two views draw in one frame. */
typedef struct pictures {
    float *depth;
    uint8_t *color;
    e3d_stats stats[VIEWS];
} pictures;

static pictures pictures_create(const e3d_frame *frame)
{
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    pictures p = {.depth = malloc(pixels * sizeof(float)), .color = malloc(4 * pixels)};
    if (p.depth == NULL || p.color == NULL)
        abort();
    memset(p.depth, 0xA5, pixels * sizeof(float));
    memset(p.color, 0xA5, 4 * pixels);
    return p;
}

static void pictures_destroy(pictures *p)
{
    free(p->depth);
    free(p->color);
}

static int same_counts(const e3d_stats *a, const e3d_stats *b)
{
    return a->rounds == b->rounds && a->clusters_drawn == b->clusters_drawn && a->clusters_occluded == b->clusters_occluded &&
           a->triangles_setup == b->triangles_setup && a->pixels_shaded == b->pixels_shaded && a->plan == b->plan;
}

static int same_pictures(const e3d_frame *frame, const pictures *a, const pictures *b)
{
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    return memcmp(a->depth, b->depth, pixels * sizeof(float)) == 0 && memcmp(a->color, b->color, 4 * pixels) == 0;
}

/* The same from behind: x and z of the clip space of the camera are turned about its middle, so that near becomes far. */
static e3d_frame from_behind(const e3d_frame *frame)
{
    e3d_frame behind = *frame;
    for (int c = 0; c < 4; c++) {
        behind.clip_from_world[c] = -frame->clip_from_world[c];
        behind.clip_from_world[8 + c] = -frame->clip_from_world[8 + c];
    }
    behind.view = 1;
    behind.wireframe = E3D_WIRE_NONE;
    return behind;
}

static e3d_status draw_frame(e3d_renderer *const renderers[VIEWS], const e3d_frame frames[VIEWS], pictures *out)
{
    const e3d_targets targets[VIEWS] = {{.ndc_depth = out->depth}, {.color = out->color}};
    const e3d_pass passes[VIEWS] = {{&frames[0], &targets[0], &out->stats[0]}, {&frames[1], &targets[1], &out->stats[1]}};
    if (renderers[0] == renderers[1])
        return e3d_render_passes(renderers[0], passes, VIEWS);
    e3d_status status = e3d_render_passes(renderers[0], &passes[0], 1);
    return status == E3D_OK ? e3d_render_passes(renderers[1], &passes[1], 1) : status;
}

/* With one thread, since what several leave out depends on who is first. */
static e3d_status draw_both(const e3d_frame frames[VIEWS], e3d_backend backend, uint64_t *hash, int *agrees)
{
    e3d_renderer *made[3] = {NULL};
    e3d_status status = E3D_OK;
    for (int k = 0; k < 3 && status == E3D_OK; k++)
        status = e3d_renderer_create(backend, 1, &made[k]);
    e3d_renderer *const one[VIEWS] = {made[0], made[0]}, *const two[VIEWS] = {made[1], made[2]};
    const int count = backend == E3D_BACKEND_SCALAR ? 1 : FRAMES; /* the reference remembers nothing, and takes long */
    for (int n = 0; n < count && status == E3D_OK; n++) {
        pictures a = pictures_create(&frames[1]), b = pictures_create(&frames[1]);
        status = draw_frame(one, frames, &a);
        if (status == E3D_OK)
            status = draw_frame(two, frames, &b);
        if (status == E3D_OK) {
            *agrees &= same_pictures(&frames[1], &a, &b);
            for (int v = 0; v < VIEWS && n >= SETTLED; v++)
                *agrees &= same_counts(&a.stats[v], &b.stats[v]);
            *hash = hash_bytes(HASH_START, a.color, 4 * (size_t)frames[1].width * (size_t)frames[1].height);
        }
        pictures_destroy(&a);
        pictures_destroy(&b);
    }
    for (int k = 0; k < 3; k++)
        e3d_renderer_destroy(made[k]);
    return status;
}

outcome compare_passes(random_stream r, const run_plan *plan, const char *title)
{
    scene s;
    outcome result = {.status = scene_create(&s, &r, plan->most_side), .agrees = 1};
    s.frame.culling = E3D_CULLING_ALWAYS;
    s.frame.view = 2;
    const e3d_frame frames[VIEWS] = {from_behind(&s.frame), s.frame};
    for (e3d_backend backend = E3D_BACKEND_SCALAR; backend < E3D_BACKEND_COUNT && result.status == E3D_OK; backend++) {
        uint64_t before = result.hash;
        int agrees = 1;
        if (!plan->backends[backend])
            continue;
        result.status = draw_both(frames, backend, &result.hash, &agrees);
        agrees &= before == 0 || before == result.hash;
        if (!agrees && title != NULL)
            fprintf(stderr, "%s: %s: two passes of one call differ from two calls\n", title, e3d_backend_name(backend));
        result.agrees &= agrees;
    }
    scene_destroy(&s);
    return result;
}
