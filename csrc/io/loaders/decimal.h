/* Decimal text to the nearest double, ties to even: the value that Python's float() gives.
 * In: text that is ended by a byte that is part of no number (such as a line feed). Out: the value, and where the number
 * ends. The locale plays no part.
 * Always: nothing behind that byte is read.
 * Up to 19 digits with a small exponent are read here; everything else is read by e3d_decimal_value(). Source of the fast
 * path: W. D. Clinger, "How to read floating point numbers accurately", 1990. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define E3D_DECIMAL_DIGITS 19 /* 64 bits hold any number of so many digits */
#define E3D_EXACT_POWER 22    /* the greatest power of ten that is a double */
#define E3D_EXACT_INTEGER (UINT64_C(1) << 53)

extern const double e3d_powers_of_ten[E3D_EXACT_POWER + 1];

/* The double next to digits * 10^exponent. */
double e3d_decimal_value(uint64_t digits, int64_t exponent);
/* The same of more digits than 64 bits hold: those of `count` characters from `text`, of which one
 * may be a point; `exponent` is that of the last. */
double e3d_decimal_long_value(const uint8_t *text, size_t count, int64_t exponent);
/* inf, infinity and nan, and what C libraries of Microsoft write, such as 1.#QNAN and nan(ind). */
bool e3d_decimal_word(const uint8_t *text, size_t length, double *value);

static inline bool e3d_is_digit(uint8_t byte) { return (uint8_t)(byte - '0') <= 9; }

/* Reads "[+-]digits[.digits][e[+-]digits]"; NULL if there is no such number. */
static inline const uint8_t *e3d_decimal_read(const uint8_t *at, double *value)
{
    const bool negative = *at == '-';
    at += negative || *at == '+';
    const uint8_t *const start = at;
    uint64_t digits = 0;
    for (; e3d_is_digit(*at); at++)
        digits = digits * 10 + (uint8_t)(*at - '0');
    ptrdiff_t count = at - start;
    int64_t exponent = 0;
    if (*at == '.') {
        const uint8_t *const fraction = ++at;
        for (; e3d_is_digit(*at); at++)
            digits = digits * 10 + (uint8_t)(*at - '0');
        exponent = fraction - at;
        count += at - fraction;
    }
    if (count == 0)
        return NULL;
    const ptrdiff_t characters = at - start;
    if ((*at | 0x20) == 'e') {
        const bool below_one = at[1] == '-';
        at += 1 + (below_one || at[1] == '+');
        if (!e3d_is_digit(*at))
            return NULL;
        int64_t written = 0;
        for (; e3d_is_digit(*at); at++)
            if (written < INT64_MAX / 100) /* far beyond what any number of digits makes up for */
                written = written * 10 + (*at - '0');
        exponent += below_one ? -written : written;
    }
    double size;
    if (count > E3D_DECIMAL_DIGITS)
        size = e3d_decimal_long_value(start, (size_t)characters, exponent);
    else if (digits > E3D_EXACT_INTEGER || exponent < -E3D_EXACT_POWER || exponent > E3D_EXACT_POWER)
        size = e3d_decimal_value(digits, exponent);
    else if (exponent < 0)
        size = (double)digits / e3d_powers_of_ten[-exponent];
    else
        size = (double)digits * e3d_powers_of_ten[exponent];
    *value = negative ? -size : size;
    return at;
}
