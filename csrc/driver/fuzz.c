/* libFuzzer's entry: its bytes decide the scene; a crash or a disagreement is a finding. */
#include <stdlib.h>

#include "driver/canvas_scene.h"
#include "driver/compare.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    run_plan plan = {.threads = {2}, .thread_counts = 1};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        plan.backends[k] = e3d_backend_available((e3d_backend)k);
    random_stream r = {.bytes = bytes, .byte_count = count};
    int fine = compare_scene(r, &plan, "scene").agrees;
    fine &= compare_rasterize(r, &plan, "rasterize").agrees;
    fine &= compare_canvas(r, "canvas").agrees;
    if (!fine)
        abort();
    return 0;
}
