/* Calm triangles: triangles that differ so little from corner to corner that neighbours may be lit together within a pixel
 * (R152).
 * In: a draw's corners, normals, colours. Out: 1 or 0 for each triangle.
 * Always: a triangle with texture coordinates is never calm, since colours change within a texel's width. */
#include "base/pool.h"
#include "e3d_renderer.h"
#include "extras/pyrender/picture.h"

enum { TRIANGLES_AT_A_TIME = 4096 };

#define TURN_SQUARED (1.0f / 64)  /* between normals: 1/8 of their length, squared */
#define COLOR_CHANGE (1.0f / 64)

static float square_of(const float v[3]) { return (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]; }

static int are_alike(const float a[3], const float b[3])
{
    float between[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    float square = square_of(between), first = square_of(a), second = square_of(b);
    return square <= (first < second ? first : second) * TURN_SQUARED;
}

static int have_one_color(const float a[4], const float b[4])
{
    int same = 1;
    for (int c = 0; c < 4; c++)
        same &= a[c] - b[c] <= COLOR_CHANGE && b[c] - a[c] <= COLOR_CHANGE;
    return same;
}

static int is_calm(const e3d_pyr_draw *draw, int32_t triangle)
{
    int32_t corner[3];
    int calm = !draw->uvs;
    pyr_corners(draw, triangle, corner);
    for (int k = 0; k < 3 && calm; k++) {
        size_t a = (size_t)corner[k], b = (size_t)corner[(k + 1) % 3];
        calm &= !draw->normals || are_alike(draw->normals + 3 * a, draw->normals + 3 * b);
        calm &= !draw->colors || have_one_color(draw->colors + 4 * a, draw->colors + 4 * b);
    }
    return calm;
}

typedef struct calm_job {
    const e3d_pyr_draw *draw;
    uint8_t *out;
} calm_job;

static void find_some(void *argument, int chunk)
{
    const calm_job *job = argument;
    int32_t first = chunk * TRIANGLES_AT_A_TIME, count = job->draw->count;
    int32_t end = count - first < TRIANGLES_AT_A_TIME ? count : first + TRIANGLES_AT_A_TIME;
    for (int32_t t = first; t < end; t++)
        job->out[t] = (uint8_t)is_calm(job->draw, t);
}

void e3d_pyr_find_calm(const e3d_pyr_draw *draw, uint8_t *out)
{
    calm_job job = {draw, out};
    e3d_pool_share(e3d_thread_count(), draw->count / TRIANGLES_AT_A_TIME + 1, find_some, &job);
}
