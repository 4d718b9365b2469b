/* Fuzzes pictures in MuJoCo's manner: the same bytes for any number of threads, and nothing beside them is touched. */
#include "check/driver/scenes/mujoco_scene.h"
#include "check/fuzz/input.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const random_stream r = {.bytes = bytes, .byte_count = size};
    const run_plan plan = {.thread_counts = 2, .threads = {1, 2}};
    CLAIM(compare_mujoco(r, &plan, "mujoco").agrees);
    return 0;
}
