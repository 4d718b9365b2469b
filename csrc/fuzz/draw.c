/* Fuzzes the drawing of scenes: the bytes decide the scene, which every backend draws alike. */
#include "driver/compare.h"
#include "fuzz/input.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    run_plan plan = {.threads = {2}, .thread_counts = 1};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        plan.backends[k] = e3d_backend_available((e3d_backend)k);
    const random_stream r = {.bytes = bytes, .byte_count = size};
    CLAIM(compare_scene(r, &plan, "scene").agrees);
    CLAIM(compare_rasterize(r, &plan, "rasterize").agrees);
    return 0;
}
