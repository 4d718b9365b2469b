/* Lists among numbers that were read from text: a length, and then so many items.
 * In: numbers as from e3d_read_numbers(). Out: where the rows of lists begin, their items, indices.
 * Always: a number is a length or an index only if it is whole and in range; NaN is neither. */
#include "e3d_numbers.h"

#include <math.h>

e3d_ply_problem e3d_walk_numbers(const e3d_number_body *body, const size_t *skips, size_t list_count, size_t tail,
                                 size_t rows, e3d_ply_rows *found)
{
    size_t place = body->start;
    const size_t end = body->end;
    for (size_t row = 0, list = 0; row < rows; row++) {
        found->places[row] = (int64_t)place;
        for (size_t k = 0; k < list_count; k++, list++) {
            if (skips[k] >= end - place)
                return E3D_PLY_SHORT;
            place += skips[k];
            const double length = body->values[place];
            if (!(length >= 0 && length < INFINITY && floor(length) == length)) {
                found->row = row;
                found->end = place;
                return E3D_PLY_BAD_LIST;
            }
            place++;
            if (length > (double)(end - place))
                return E3D_PLY_SHORT;
            found->starts[list] = (int64_t)place;
            found->sizes[list] = (int64_t)length;
            place += (size_t)length;
        }
        if (tail > end - place)
            return E3D_PLY_SHORT;
        place += tail;
    }
    found->end = place;
    return E3D_PLY_DONE;
}

void e3d_copy_numbers(const double *values, const int64_t *starts, const int64_t *sizes, size_t step, size_t rows,
                      double *items)
{
    for (size_t row = 0; row < rows; row++) {
        const double *const from = values + starts[row * step];
        const size_t size = (size_t)sizes[row * step];
        for (size_t i = 0; i < size; i++)
            items[i] = from[i];
        items += size;
    }
}

size_t e3d_numbers_to_indices(const double *values, size_t width, size_t stride, size_t rows, size_t limit,
                              int32_t *indices)
{
    const double most = limit < INT32_MAX ? (double)limit : (double)INT32_MAX;
    for (size_t row = 0; row < rows; row++)
        for (size_t i = 0; i < width; i++) {
            const double value = values[row * stride + i];
            if (!(value >= 0 && value < most && value == (double)(int32_t)value))
                return row * width + i;
            indices[row * width + i] = (int32_t)value;
        }
    return rows * width;
}
