/* Arrays of random numbers that a scene owns. */
#include "check/driver/scene_arrays.h"

#include <stdlib.h>

void *scene_array(scene *s, size_t count, size_t size)
{
    void *array = calloc(count, size);
    if (array == NULL || s->array_count == SCENE_MAX_ARRAYS)
        abort();
    s->arrays[s->array_count++] = array;
    return array;
}

float *random_floats(scene *s, random_stream *r, int32_t count, float low, float high)
{
    float *values = scene_array(s, (size_t)count, sizeof *values);
    for (int32_t i = 0; i < count; i++)
        values[i] = random_float(r, low, high);
    return values;
}

/* One number begins them all: thousands of texels would use up a fuzzer's bytes before anything is drawn. */
uint8_t *random_bytes(scene *s, random_stream *r, int32_t count)
{
    uint8_t *values = scene_array(s, (size_t)count, 1);
    random_stream own = {.state = random_bits(r)};
    for (int32_t i = 0; i < count; i++)
        values[i] = (uint8_t)random_bits(&own);
    return values;
}

/* One number begins all texels, too. */
float *random_texels(scene *s, random_stream *r, size_t count, float low, float high)
{
    float *values = scene_array(s, count + 1, sizeof *values);
    random_stream own = {.state = random_bits(r)};
    for (size_t i = 0; i < count; i++)
        values[i] = random_float(&own, low, high);
    return values;
}

int32_t *random_indices(scene *s, random_stream *r, int32_t count, int32_t bound)
{
    int32_t *values = scene_array(s, (size_t)count, sizeof *values);
    for (int32_t i = 0; i < count; i++)
        values[i] = random_below(r, bound);
    return values;
}
