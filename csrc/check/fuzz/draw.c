/* Fuzzes the drawing of scenes: a byte for how, and a scene, which a backend draws as the reference does.
 *
 * Most pictures are small, and each is drawn by one backend beside the reference: a hundred times as many are drawn
 * as of all backends in the driver's sizes. Some are large enough for several tiles.
 */
#include "check/driver/compare.h"
#include "check/fuzz/input.h"

enum { SMALL = 12,
       LARGE = 66 };

/* The one that a number chooses of those that this machine can run, but for the reference. */
static e3d_backend chosen_backend(uint32_t number)
{
    e3d_backend known[E3D_BACKEND_COUNT];
    uint32_t count = 0;
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        if (k != E3D_BACKEND_SCALAR && e3d_backend_available((e3d_backend)k))
            known[count++] = (e3d_backend)k;
    return known[number % count];
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const uint32_t how = take_byte(&in);
    run_plan plan = {.thread_counts = 1, .threads = {1 + (int32_t)(how & 1)}};
    plan.most_side = (how >> 1 & 15) == 5 ? LARGE : SMALL;
    plan.backends[E3D_BACKEND_SCALAR] = plan.backends[chosen_backend(take_byte(&in))] = 1;
    const random_stream r = {.bytes = in.at, .byte_count = in.left};
    if (how >> 5 & 1)
        CLAIM(compare_alpha(r, &plan, "alpha").agrees);
    else if (how >> 6 & 1)
        CLAIM(compare_shadows(r, &plan, "shadows").agrees);
    else if (how >> 5)
        CLAIM(compare_scene(r, &plan, "scene").agrees);
    else
        CLAIM(compare_rasterize(r, &plan, "rasterize").agrees);
    return 0;
}
