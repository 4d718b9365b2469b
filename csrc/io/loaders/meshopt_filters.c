/* Filters of meshopt: decodes unit vectors, quaternions, floats and colours that were packed for better compression.
 * In: packed elements. Out: their values, in place. The order of float32 operations is written out, so that every machine
 * gives the same bytes. */
#include "e3d_meshopt.h"

#include <math.h>
#include <string.h>

enum { MAX_EXPONENT = 100 };

static int32_t rounded(float v) { return (int32_t)(v + (v >= 0.0f ? 0.5f : -0.5f)); }

/* Clamps damaged elements to the range of their type. */
static int32_t limited(float v, int32_t low, int32_t high)
{
    if (!(v > (float)low))
        return low;
    return v < (float)high ? rounded(v) : high;
}

/* Component k of an element of four, of 1 or 2 bytes. */
static int32_t get(const uint8_t *element, size_t width, int k)
{
    if (width == 1)
        return (int8_t)element[k];
    return (int16_t)(element[2 * k] | element[2 * k + 1] << 8);
}

static void put(uint8_t *element, size_t width, int k, int32_t value)
{
    element[(size_t)k * width] = (uint8_t)value;
    if (width == 2)
        element[2 * k + 1] = (uint8_t)((uint32_t)value >> 8);
}

static void undo_octahedral(uint8_t *element, size_t width)
{
    const int32_t most = width == 1 ? INT8_MAX : INT16_MAX, given = get(element, width, 2);
    const float one = given == 0 ? 1.0f : (float)given;
    float v[3] = {(float)get(element, width, 0) / one, (float)get(element, width, 1) / one, 0.0f};
    v[2] = 1.0f - fabsf(v[0]) - fabsf(v[1]);
    const float over = v[2] < 0.0f ? v[2] : 0.0f; /* the lower half is folded outwards */
    for (int k = 0; k < 2; k++)
        v[k] += v[k] < 0.0f ? -over : over;
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        put(element, width, k, limited(v[k] / length * (float)most, -most, most));
}

static void undo_quaternion(uint8_t *element)
{
    const float range = 0.70710678f; /* 1 / sqrt(2) */
    const int32_t given = get(element, 2, 3), largest = given & 3;
    const float one = (float)(given | 3);
    float v[3], square = 1.0f;
    for (int k = 0; k < 3; k++) {
        v[k] = (float)get(element, 2, k) / one * range;
        square -= v[k] * v[k];
    }
    for (int k = 0; k < 3; k++)
        put(element, 2, (largest + 1 + k) % 4, limited(v[k] * 32767.0f, -INT16_MAX, INT16_MAX));
    put(element, 2, largest, limited(sqrtf(square > 0.0f ? square : 0.0f) * 32767.0f, 0, INT16_MAX));
}

static void undo_exponential(uint8_t *word)
{
    uint32_t bits = (uint32_t)word[0] | (uint32_t)word[1] << 8 | (uint32_t)word[2] << 16;
    const int32_t mantissa = (int32_t)(bits ^ 0x800000) - 0x800000;
    int32_t exponent = (int8_t)word[3];
    if (exponent < -MAX_EXPONENT || exponent > MAX_EXPONENT)
        exponent = exponent < 0 ? -MAX_EXPONENT : MAX_EXPONENT;
    const uint32_t power_bits = (uint32_t)(exponent + 127) << 23;
    float power;
    memcpy(&power, &power_bits, sizeof power);
    const float value = power * (float)mantissa;
    memcpy(&bits, &value, sizeof bits);
    for (int k = 0; k < 4; k++)
        word[k] = (uint8_t)(bits >> 8 * k);
}

static void undo_color(uint8_t *element, size_t width)
{
    const int32_t most = width == 1 ? UINT8_MAX : UINT16_MAX;
    const int32_t y = get(element, width, 0) & most, co = get(element, width, 1), cg = get(element, width, 2);
    const int32_t alpha = get(element, width, 3) & most;
    int32_t scale = 1; /* all bits up to the highest one of alpha */
    while (scale < alpha)
        scale = 2 * scale + 1;
    const int32_t kept = alpha & scale >> 1;
    const float factor = (float)most / (float)scale;
    const int32_t values[4] = {y + co - cg, y + cg, y - co - cg, kept << 1 | (kept & 1)};
    for (int k = 0; k < 4; k++)
        put(element, width, k, limited((float)values[k] * factor, 0, most));
}

void e3d_meshopt_undo_filter(uint8_t *elements, size_t count, size_t stride, e3d_meshopt_filter filter)
{
    for (size_t i = 0; i < count; i++) {
        uint8_t *const element = elements + i * stride;
        if (filter == E3D_MESHOPT_OCTAHEDRAL)
            undo_octahedral(element, stride / 4);
        else if (filter == E3D_MESHOPT_QUATERNION)
            undo_quaternion(element);
        else if (filter == E3D_MESHOPT_COLOR)
            undo_color(element, stride / 4);
        else
            for (size_t word = 0; word < stride; word += 4)
                undo_exponential(element + word);
    }
}
