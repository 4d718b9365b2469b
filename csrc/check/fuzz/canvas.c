/* Fuzzes 2-D drawing: both algorithms give the same pixels, and touch nothing beside them. */
#include "check/driver/scenes/canvas_scene.h"
#include "check/fuzz/input.h"

/* Small pictures of few shapes: more of them. */
enum { SIDE = 20,
       CALLS = 6 };

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const random_stream r = {.bytes = bytes, .byte_count = size};
    CLAIM(compare_canvas(r, SIDE, CALLS, "canvas").agrees);
    return 0;
}
