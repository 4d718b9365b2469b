/* Fuzzes numbers written as text: floats alone and in rows, and the lines of faces.
 *
 * In:  a byte: 0 or what a corner of a face names; four bytes a float, or five bytes a corner.
 * Claims: strtof reads the same bits; no text of fewer digits is read so, and none as short is nearer; rows and lines
 *      are what printf makes of them.
 */
#include "check/fuzz/input.h"
#include "e3d_writers.h"

#include <math.h>

enum { MOST_NUMBERS = 64,
       MOST_CORNERS = 48 };

static size_t digits_of(const char *text)
{
    size_t count = 0, zeros = 0;
    for (; *text && *text != 'e'; text++) {
        if (*text < '0' || *text > '9' || (*text == '0' && count == 0))
            continue;
        count++;
        zeros = *text == '0' ? zeros + 1 : 0;
    }
    return count - zeros;
}

static void claim_float(float number, const char *text)
{
    if (isnan(number)) {
        CLAIM(strcmp(text, "nan") == 0);
        return;
    }
    char *end, other[64];
    const float read = strtof(text, &end);
    CLAIM(*end == '\0' && memcmp(&read, &number, sizeof read) == 0);
    const size_t digits = digits_of(text);
    if (isinf(number) || digits == 0)
        return;
    CLAIM(digits <= 9);
    if (digits > 1) {
        snprintf(other, sizeof other, "%.*e", (int)digits - 2, (double)number);
        CLAIM(strtof(other, NULL) != number);
    }
    snprintf(other, sizeof other, "%.*e", (int)digits - 1, (double)number);
    if (strtof(other, NULL) == number)
        CLAIM(strtod(text, NULL) == strtod(other, NULL));
}

static void claim_rows(const float *numbers, size_t rows, size_t width)
{
    static const uint8_t *const between[] = {(const uint8_t *)"vt ", (const uint8_t *)" ", (const uint8_t *)"",
                                             (const uint8_t *)" ; ", (const uint8_t *)"\n"};
    size_t lengths[5] = {3, 1, 0, 3, 1}, room = 0;
    const uint8_t *around[5];
    for (size_t k = 0; k <= width; k++) {
        around[k] = between[k == width ? 4 : k];
        lengths[k] = strlen((const char *)around[k]);
        room += lengths[k] + (k < width ? E3D_FLOAT_LETTERS : 0);
    }
    uint8_t *text = room_for(rows, room);
    const size_t size = e3d_write_float_rows(numbers, rows, width, around, lengths, text);
    size_t at = 0;
    for (size_t row = 0; row < rows; row++)
        for (size_t k = 0; k <= width; k++) {
            uint8_t alone[E3D_FLOAT_LETTERS];
            CLAIM(memcmp(text + at, around[k], lengths[k]) == 0);
            at += lengths[k];
            const size_t count = k < width ? e3d_write_float(numbers[row * width + k], alone) : 0;
            CLAIM(memcmp(text + at, alone, count) == 0);
            at += count;
        }
    CLAIM(at == size);
    free(text);
}

static void fuzz_floats(input in)
{
    float numbers[MOST_NUMBERS];
    const size_t width = 1 + (size_t)take_below(&in, 4);
    const size_t count = in.left / sizeof(float) < MOST_NUMBERS ? in.left / sizeof(float) : MOST_NUMBERS;
    for (size_t k = 0; k < count; k++) {
        uint8_t text[E3D_FLOAT_LETTERS];
        char ended[E3D_FLOAT_LETTERS + 1] = {0};
        memcpy(&numbers[k], in.at + k * sizeof(float), sizeof(float));
        memcpy(ended, text, e3d_write_float(numbers[k], text));
        claim_float(numbers[k], ended);
    }
    claim_rows(numbers, count / width, width);
}

static void fuzz_faces(input in, e3d_corner_form form)
{
    static const char *const forms[] = {" %d", " %d/%d", " %d//%d", " %d/%d/%d"};
    int32_t sizes[MOST_CORNERS], positions[MOST_CORNERS], others[MOST_CORNERS];
    size_t faces = 0, count = in.left / 5 < MOST_CORNERS ? in.left / 5 : MOST_CORNERS, corner = 0, at = 0;
    for (size_t k = 0; k < count; k++) {
        const uint32_t begins = take_byte(&in) & 1, low = take_word(&in), high = take_word(&in);
        positions[k] = (int32_t)(low << 16 | high);
        others[k] = (int32_t)(high << 16 | low);
        if (begins || k == 0)
            sizes[faces++] = 0;
        sizes[faces - 1]++;
    }
    uint8_t *text = room_for(3 * (E3D_INTEGER_LETTERS + 1) * count + 2 * faces, 1);
    int64_t *ends = room_for(faces, sizeof *ends);
    const size_t size = e3d_write_faces(sizes, faces, positions, others, form, text, ends);
    for (size_t face = 0; face < faces; face++) {
        CLAIM(text[at++] == 'f');
        for (int32_t k = 0; k < sizes[face]; k++, corner++) {
            char expected[64];
            const int length = snprintf(expected, sizeof expected, forms[form], positions[corner], others[corner],
                                        others[corner]);
            CLAIM(memcmp(text + at, expected, (size_t)length) == 0);
            at += (size_t)length;
        }
        CLAIM(text[at++] == '\n' && ends[face] == (int64_t)at);
    }
    CLAIM(at == size);
    free(text);
    free(ends);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const uint32_t kind = (uint32_t)take_below(&in, 5);
    if (kind == 0)
        fuzz_floats(in);
    else
        fuzz_faces(in, (e3d_corner_form)(kind - 1));
    return 0;
}
