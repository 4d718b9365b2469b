/* Lens: the values that its pixels take from the pinhole pictures around it (docs/exactness, R208).
 *
 * In: values of the faces' pixels, and which pixel each of the lens takes. Out: values of the lens's pixels. Vectors are
 * turned from the axes of their face to those of the camera, which swaps and negates their components.
 */
#include "e3d_lens.h"

#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"

enum { BAND = 16 }; /* rows of a task */

/* How a face turns a vector: component k is that number `from[k]`, times `sign[k]`. */
typedef struct turn {
    int from[3];
    float sign[3];
} turn;

static turn turn_of(const e3d_lens_face *face)
{
    turn t = {{0}, {0}};
    for (int row = 0; row < 3; row++)
        for (int k = 0; k < 3; k++)
            if (face->axes[row][k] != 0) {
                t.from[k] = row;
                t.sign[k] = (float)face->axes[row][k];
            }
    return t;
}

static inline void take(const e3d_lens_values *all, size_t i, size_t bytes)
{
    uint8_t *to = all->to + bytes * i;
    if (all->source[i] < 0)
        memset(to, all->none, bytes);
    else
        memcpy(to, all->from + bytes * (size_t)all->source[i], bytes);
}

static inline void take_turned(const e3d_lens_values *all, size_t i, size_t bytes, const turn *turns)
{
    take(all, i, bytes);
    if (all->source[i] < 0)
        return;
    const turn *t = turns + all->pixels[i].face;
    const uint8_t *from = all->from + bytes * (size_t)all->source[i];
    for (int k = 0; k < 3; k++) {
        float component;
        memcpy(&component, from + 4 * t->from[k], sizeof component);
        component *= t->sign[k];
        memcpy(all->to + bytes * i + 4 * k, &component, sizeof component);
    }
}

static void take_band(void *argument, int band)
{
    const e3d_lens_values *all = argument;
    size_t first = (size_t)band * BAND * (size_t)all->width, last = first + BAND * (size_t)all->width;
    size_t end = (size_t)all->height * (size_t)all->width;
    turn turns[E3D_LENS_FACES];
    e3d_fpenv saved = e3d_fpenv_enter();
    last = last < end ? last : end;
    for (int k = 0; k < all->face_count; k++)
        turns[k] = turn_of(all->faces + k);
    if (all->is_turned)
        for (size_t i = first; i < last; i++)
            take_turned(all, i, (size_t)all->bytes, turns);
    else if (all->bytes == 12) /* the compiler knows the size of the most usual ones */
        for (size_t i = first; i < last; i++)
            take(all, i, 12);
    else
        for (size_t i = first; i < last; i++)
            take(all, i, (size_t)all->bytes);
    e3d_fpenv_leave(saved);
}

void e3d_lens_take(const e3d_lens_values *values, int threads)
{
    e3d_pool_share(threads, (values->height + BAND - 1) / BAND, take_band, (void *)(uintptr_t)values);
}
