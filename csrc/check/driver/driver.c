/* The core without Python: draws random and hostile scenes, moves random graphs, prints one hash each.
 *
 * Usage: driver [--scenes N] [--first N] [--kind NAME] [--backend NAME] [--threads N] [--again]
 * Out:   "scene 0007 0123456789abcdef ok" a line; what depends on the machine goes to standard
 *        error, so that the outputs of two machines can be compared with `cmp`. Exit status 1 where
 *        backends or thread counts disagree, or an output holds NaN; with --again also where a scene
 *        is other when it is drawn once more, after others and in memory that is filled with a pattern.
 * It carries the sanitizers and the builds for other processors.
 */
#include <stdio.h>
#include <stdlib.h>

#include "check/driver/scenes/behind_scene.h"
#include "check/driver/scenes/bloom_scene.h"
#include "check/driver/scenes/canvas_scene.h"
#include "check/driver/compare.h"
#include "check/driver/scenes/flow_scene.h"
#include "check/driver/scenes/graph_scene.h"
#include "check/driver/scenes/lens_scene.h"
#include "check/driver/scenes/mujoco_scene.h"
#include "check/driver/scenes/occlusion_scene.h"
#include "check/driver/outputs.h"
#include "check/driver/passes.h"
#include "check/driver/poison.h"
#include "check/driver/scenes/pybullet_scene.h"
#include "check/driver/scenes/pyrender_scene.h"
#include "check/driver/renderers.h"
#include "check/driver/scenes/ui_scene.h"

typedef struct options {
    long scenes, first;
    int only; /* of KINDS; -1: all of them */
    int again;
    run_plan plan;
} options;

static outcome compare_drawing(random_stream r, const run_plan *plan, const char *title)
{
    (void)plan; /* it has no backends and no threads */
    return compare_canvas(r, CANVAS_SIDE, CANVAS_CALLS, title);
}

/* What is tried with each number. */
static const struct {
    const char *name;
    outcome (*compare)(random_stream r, const run_plan *plan, const char *title);
} KINDS[] = {
    {"scene", compare_scene},
    {"passes", compare_passes},
    {"alpha", compare_alpha},
    {"shadows", compare_shadows},
    {"rasterize", compare_rasterize},
    {"canvas", compare_drawing},
    {"graph", compare_graph},
    {"ui", compare_ui},
    {"occlusion", compare_occlusion},
    {"pyrender", compare_pyrender},
    {"mujoco", compare_mujoco},
    {"pybullet", compare_pybullet},
    {"outputs", compare_outputs},
    {"bloom", compare_bloom},
    {"behind", compare_behind},
    {"lens", compare_lens_colors},
    {"lens-rays", compare_lens_rays},
    {"flow", compare_flow},
};
enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS };

static int usage(void)
{
    fputs("usage: driver [--scenes N] [--first N] [--kind NAME] [--backend NAME] [--threads N] [--again]\n", stderr);
    return 2;
}

static int choose_backend(run_plan *plan, const char *name)
{
    int found = 0;
    for (int k = 0; k < E3D_BACKEND_COUNT; k++) {
        int chosen = strcmp(name, e3d_backend_name((e3d_backend)k)) == 0;
        found |= chosen && plan->backends[k];
        plan->backends[k] &= chosen;
    }
    if (!found)
        fprintf(stderr, "driver: no backend %s here\n", name);
    return found;
}

static int choose_kind(options *o, const char *name)
{
    for (int k = 0; k < KIND_COUNT; k++)
        if (strcmp(name, KINDS[k].name) == 0)
            o->only = k;
    return o->only >= 0;
}

static int parse(options *o, int count, char **arguments)
{
    for (int i = 1; i < count; i++) {
        const char *name = arguments[i];
        if (strcmp(name, "--again") == 0) {
            o->again = 1;
            continue;
        }
        const char *value = i + 1 < count ? arguments[++i] : NULL;
        if (!value)
            return 0;
        if (strcmp(name, "--scenes") == 0)
            o->scenes = atol(value);
        else if (strcmp(name, "--first") == 0)
            o->first = atol(value);
        else if (strcmp(name, "--threads") == 0)
            o->plan.threads[0] = atoi(value), o->plan.thread_counts = 1;
        else if (strcmp(name, "--kind") == 0 ? !choose_kind(o, value) : strcmp(name, "--backend") != 0 || !choose_backend(&o->plan, value))
            return 0;
    }
    return 1;
}

static int is_asked_for(const options *o, int kind) { return o->only < 0 || o->only == kind; }

static outcome try(const options *o, int kind, long index)
{
    char title[32];
    snprintf(title, sizeof title, "%s %04ld", KINDS[kind].name, index);
    return KINDS[kind].compare((random_stream){.state = (uint64_t)index}, &o->plan, title);
}

/* All scenes, and their hashes to standard output; how many failed. */
static int draw_all(const options *o, uint64_t *hashes)
{
    int failures = 0;
    for (long n = 0; n < o->scenes; n++)
        for (int k = 0; k < KIND_COUNT; k++) {
            if (!is_asked_for(o, k))
                continue;
            outcome result = try(o, k, o->first + n);
            printf("%s %04ld %016llx %s\n", KINDS[k].name, o->first + n, (unsigned long long)result.hash,
                   result.status == E3D_OK ? "ok" : e3d_status_text(result.status));
            failures += !result.agrees;
            hashes[n * KIND_COUNT + k] = result.hash;
        }
    return failures;
}

/* The reference takes most of the time, and keeps nothing from frame to frame: it is left out where there is another backend. One
 * renderer is new, and one has drawn the scenes before. */
static void choose_again(run_plan *plan)
{
    int others = 0;
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        others += k != E3D_BACKEND_SCALAR && plan->backends[k];
    plan->backends[E3D_BACKEND_SCALAR] &= !others;
    plan->thread_counts = 2;
    plan->threads[0] = 1;
    plan->threads[1] = 2;
}

/* The same scenes, the last one first and in poisoned memory: how many are other than they were. */
static int draw_again(options *o, const uint64_t *hashes)
{
    int failures = 0;
    choose_again(&o->plan);
    if (!poison_begin())
        fputs("driver: memory cannot be poisoned here\n", stderr);
    renderers_keep();
    for (long n = o->scenes - 1; n >= 0; n--)
        for (int k = KIND_COUNT - 1; k >= 0; k--) {
            if (!is_asked_for(o, k))
                continue;
            outcome result = try(o, k, o->first + n);
            int same = result.hash == hashes[n * KIND_COUNT + k];
            if (!same)
                fprintf(stderr, "%s %04ld: another hash after other scenes: %016llx\n", KINDS[k].name, o->first + n,
                        (unsigned long long)result.hash);
            failures += !same || !result.agrees;
        }
    renderers_free();
    return failures;
}

int main(int count, char **arguments)
{
    options o = {.scenes = 60, .only = -1, .plan = {.threads = {1, 2, 3, 8}, .thread_counts = 4}};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        o.plan.backends[k] = e3d_backend_available((e3d_backend)k);
    if (!parse(&o, count, arguments) || o.scenes < 0)
        return usage();
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        if (o.plan.backends[k])
            fprintf(stderr, "backend %s\n", e3d_backend_name((e3d_backend)k));
    setvbuf(stdout, NULL, _IOLBF, 0); /* after a crash the last line tells where */
    uint64_t *hashes = calloc((size_t)o.scenes * KIND_COUNT + 1, sizeof *hashes);
    if (!hashes)
        return 1;
    int failures = draw_all(&o, hashes);
    if (o.again)
        failures += draw_again(&o, hashes);
    free(hashes);
    if (failures > 0)
        fprintf(stderr, "driver: %d scenes differ between runs\n", failures);
    return failures > 0;
}
