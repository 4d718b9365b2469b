/* The members of a frame by their names, for options and a scene's surroundings. A choice or a switch is an integer of 32
 * bits. */
#include <stddef.h>
#include <string.h>

#include "e3d.h"

typedef struct number {
    const char *name;
    size_t offset;
    int32_t count, is_float;
} number;

#define INTEGER(member) {#member, offsetof(e3d_frame, member), 1, 0}
#define FLOATS(member) {#member, offsetof(e3d_frame, member), sizeof(((e3d_frame *)0)->member) / sizeof(float), 1}

static const number NUMBERS[] = {
    INTEGER(mode), INTEGER(cull), INTEGER(wireframe), INTEGER(hidden), INTEGER(shading), INTEGER(normals),
    INTEGER(culling), INTEGER(line_shape), INTEGER(point_shape), INTEGER(tone_mapping),
    INTEGER(remove_hidden_lines), INTEGER(transparent_outputs), INTEGER(alpha_to_coverage),
    INTEGER(sample_shading), INTEGER(specular_antialiasing), INTEGER(opaque_only),
    FLOATS(line_width), FLOATS(point_size), FLOATS(line_color), FLOATS(background),
    INTEGER(gradient.shows), FLOATS(gradient.top), FLOATS(gradient.bottom), INTEGER(encode_srgb),
    INTEGER(decode_srgb), FLOATS(ambient), FLOATS(light_clamp), FLOATS(exposure),
    FLOATS(environment.cosine), FLOATS(environment.sine), FLOATS(environment.intensity),
    FLOATS(backdrop.light.cosine), FLOATS(backdrop.light.sine), FLOATS(backdrop.light.intensity),
    FLOATS(backdrop.level)};

static void set(void *to, const number *one, const double *values)
{
    for (int32_t k = 0; k < one->count; k++) {
        if (one->is_float)
            ((float *)to)[k] = (float)values[k];
        else
            ((int32_t *)to)[k] = (int32_t)values[k];
    }
}

int e3d_frame_set(e3d_frame *frame, const char *name, const double *values, int32_t count)
{
    for (size_t k = 0; k < sizeof(NUMBERS) / sizeof(NUMBERS[0]); k++) {
        if (strcmp(name, NUMBERS[k].name) == 0 && count == NUMBERS[k].count) {
            set((char *)frame + NUMBERS[k].offset, &NUMBERS[k], values);
            return 1;
        }
    }
    return 0;
}
