/* Fuzzes the triangles of user interfaces: every backend gives the same pixels, and touches nothing beside them. */
#include "check/driver/scenes/ui_scene.h"
#include "check/fuzz/input.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const random_stream r = {.bytes = bytes, .byte_count = size};
    run_plan plan = {.thread_counts = 0};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        plan.backends[k] = e3d_backend_available((e3d_backend)k);
    CLAIM(compare_ui(r, &plan, "ui").agrees);
    return 0;
}
