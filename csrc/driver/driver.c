/* The core without Python: draws random and hostile scenes, moves random graphs, prints one hash each.
 *
 * Usage: driver [--scenes N] [--first N] [--backend NAME] [--threads N]
 * Out:   "scene 0007 0123456789abcdef ok" a line; what depends on the machine goes to standard
 *        error, so that the outputs of two machines can be compared with `cmp`. Exit status 1 where
 *        backends or thread counts disagree, or an output holds NaN.
 * It carries the sanitizers and the builds for other processors.
 */
#include <stdio.h>
#include <stdlib.h>

#include "driver/canvas_scene.h"
#include "driver/compare.h"
#include "driver/graph_scene.h"
#include "driver/occlusion_scene.h"
#include "driver/passes.h"
#include "driver/pyrender_scene.h"
#include "driver/ui_scene.h"

typedef struct options {
    long scenes, first;
    run_plan plan;
} options;

static int usage(void)
{
    fputs("usage: driver [--scenes N] [--first N] [--backend NAME] [--threads N]\n", stderr);
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

static int parse(options *o, int count, char **arguments)
{
    for (int i = 1; i + 1 < count; i += 2) {
        const char *name = arguments[i], *value = arguments[i + 1];
        if (strcmp(name, "--scenes") == 0)
            o->scenes = atol(value);
        else if (strcmp(name, "--first") == 0)
            o->first = atol(value);
        else if (strcmp(name, "--threads") == 0)
            o->plan.threads[0] = atoi(value), o->plan.thread_counts = 1;
        else if (strcmp(name, "--backend") != 0 || !choose_backend(&o->plan, value))
            return 0;
    }
    return count % 2 == 1;
}

static int report(const char *kind, long index, outcome result)
{
    printf("%s %04ld %016llx %s\n", kind, index, (unsigned long long)result.hash,
           result.status == E3D_OK ? "ok" : e3d_status_text(result.status));
    return !result.agrees;
}

int main(int count, char **arguments)
{
    options o = {.scenes = 60, .plan = {.threads = {1, 2, 3, 8}, .thread_counts = 4}};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        o.plan.backends[k] = e3d_backend_available((e3d_backend)k);
    if (!parse(&o, count, arguments))
        return usage();
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        if (o.plan.backends[k])
            fprintf(stderr, "backend %s\n", e3d_backend_name((e3d_backend)k));
    setvbuf(stdout, NULL, _IOLBF, 0); /* after a crash the last line tells where */
    int failures = 0;
    for (long i = o.first; i < o.first + o.scenes; i++) {
        char title[32];
        snprintf(title, sizeof title, "scene %04ld", i);
        random_stream r = {.state = (uint64_t)i};
        failures += report("scene", i, compare_scene(r, &o.plan, title));
        snprintf(title, sizeof title, "passes %04ld", i);
        failures += report("passes", i, compare_passes(r, &o.plan, title));
        snprintf(title, sizeof title, "alpha %04ld", i);
        failures += report("alpha", i, compare_alpha(r, &o.plan, title));
        snprintf(title, sizeof title, "shadows %04ld", i);
        failures += report("shadows", i, compare_shadows(r, &o.plan, title));
        snprintf(title, sizeof title, "rasterize %04ld", i);
        failures += report("rasterize", i, compare_rasterize(r, &o.plan, title));
        snprintf(title, sizeof title, "canvas %04ld", i);
        failures += report("canvas", i, compare_canvas(r, CANVAS_SIDE, CANVAS_CALLS, title));
        snprintf(title, sizeof title, "graph %04ld", i);
        failures += report("graph", i, compare_graph(r, &o.plan, title));
        snprintf(title, sizeof title, "ui %04ld", i);
        failures += report("ui", i, compare_ui(r, &o.plan, title));
        snprintf(title, sizeof title, "occlusion %04ld", i);
        failures += report("occlusion", i, compare_occlusion(r, &o.plan, title));
        snprintf(title, sizeof title, "pyrender %04ld", i);
        failures += report("pyrender", i, compare_pyrender(r, &o.plan, title));
    }
    if (failures > 0)
        fprintf(stderr, "driver: %d scenes differ between runs\n", failures);
    return failures > 0;
}
