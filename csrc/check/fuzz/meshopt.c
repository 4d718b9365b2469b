/* Fuzzes what unpacks buffer views of meshopt.
 *
 * In:  a byte each: mode and filter, the size of an element, then a word: how many there are; the stream.
 * Claims: each stream gives the same bytes twice; nothing outside of the elements is touched.
 */
#include "e3d_meshopt.h"
#include "check/fuzz/input.h"

enum { ATTRIBUTES,
       TRIANGLES,
       INDICES,
       MODES,
       NO_FILTER = E3D_MESHOPT_COLOR + 1 };

static bool unpack(uint32_t mode, input stream, uint8_t *to, size_t count, size_t stride)
{
    if (mode == ATTRIBUTES)
        return e3d_meshopt_attributes(stream.at, stream.left, to, count, stride);
    if (mode == TRIANGLES)
        return e3d_meshopt_triangles(stream.at, stream.left, to, count, stride);
    return e3d_meshopt_indices(stream.at, stream.left, to, count, stride);
}

static bool fits(uint32_t filter, size_t stride)
{
    if (filter == E3D_MESHOPT_QUATERNION)
        return stride == 8;
    return filter == E3D_MESHOPT_EXPONENTIAL || stride == 4 || stride == 8;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const uint32_t kinds = take_byte(&in), mode = kinds % MODES, filter = kinds / MODES % (NO_FILTER + 1);
    const uint32_t step = take_byte(&in) % (E3D_MESHOPT_MAX_STRIDE / 4) + 1;
    const size_t of_indices = step % 2 ? 2 : 4, stride = mode == ATTRIBUTES ? 4 * step : of_indices;
    const size_t wanted = take_word(&in) % 4096, count = mode == TRIANGLES ? wanted / 3 * 3 : wanted;
    uint8_t *elements = room_for(count, stride), *again = room_for(count, stride);
    const bool done = unpack(mode, in, elements, count, stride);
    CLAIM(done == unpack(mode, in, again, count, stride));
    if (done && mode == ATTRIBUTES && filter != NO_FILTER && fits(filter, stride)) {
        e3d_meshopt_undo_filter(elements, count, stride, (e3d_meshopt_filter)filter);
        e3d_meshopt_undo_filter(again, count, stride, (e3d_meshopt_filter)filter);
    }
    CLAIM(!done || memcmp(elements, again, count * stride) == 0);
    free(elements);
    free(again);
    return 0;
}
