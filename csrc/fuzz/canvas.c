/* Fuzzes 2-D drawing: both algorithms give the same pixels, and touch nothing beside them. */
#include "driver/canvas_scene.h"
#include "fuzz/input.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const random_stream r = {.bytes = bytes, .byte_count = size};
    CLAIM(compare_canvas(r, "canvas").agrees);
    return 0;
}
