/* A float as the shortest text that reads back as the same float.
 *
 * Source: R. Giulietti, "The Schubfach way to render doubles", 2020, for single precision: the decimal of
 * fewest digits within the float's rounding interval, found with three products of 64 by 32 bits.
 * Always: the nearest of the shortest ones, whatever the locale.
 */
#include "e3d_writers.h"

#include <string.h>

#define FRACTION_BITS 23
#define BIAS 150 /* the bias of the last bit's exponent */
#define LEAST_POWER (-31)
/* Smaller numbers are written with an exponent. */
#define LEAST_POSITIONAL 1e-4
#define MOST_POSITIONAL 1e6

/* 10^k / 2^floor(log2(10^k)) * 2^63, rounded up, for k from -31 on. */
// clang-format off
static const uint64_t powers[] = {
    UINT64_C(0x81CEB32C4B43FCF5), UINT64_C(0xA2425FF75E14FC32), UINT64_C(0xCAD2F7F5359A3B3F), UINT64_C(0xFD87B5F28300CA0E),
    UINT64_C(0x9E74D1B791E07E49), UINT64_C(0xC612062576589DDB), UINT64_C(0xF79687AED3EEC552), UINT64_C(0x9ABE14CD44753B53),
    UINT64_C(0xC16D9A0095928A28), UINT64_C(0xF1C90080BAF72CB2), UINT64_C(0x971DA05074DA7BEF), UINT64_C(0xBCE5086492111AEB),
    UINT64_C(0xEC1E4A7DB69561A6), UINT64_C(0x9392EE8E921D5D08), UINT64_C(0xB877AA3236A4B44A), UINT64_C(0xE69594BEC44DE15C),
    UINT64_C(0x901D7CF73AB0ACDA), UINT64_C(0xB424DC35095CD810), UINT64_C(0xE12E13424BB40E14), UINT64_C(0x8CBCCC096F5088CC),
    UINT64_C(0xAFEBFF0BCB24AAFF), UINT64_C(0xDBE6FECEBDEDD5BF), UINT64_C(0x89705F4136B4A598), UINT64_C(0xABCC77118461CEFD),
    UINT64_C(0xD6BF94D5E57A42BD), UINT64_C(0x8637BD05AF6C69B6), UINT64_C(0xA7C5AC471B478424), UINT64_C(0xD1B71758E219652C),
    UINT64_C(0x83126E978D4FDF3C), UINT64_C(0xA3D70A3D70A3D70B), UINT64_C(0xCCCCCCCCCCCCCCCD), UINT64_C(0x8000000000000000),
    UINT64_C(0xA000000000000000), UINT64_C(0xC800000000000000), UINT64_C(0xFA00000000000000), UINT64_C(0x9C40000000000000),
    UINT64_C(0xC350000000000000), UINT64_C(0xF424000000000000), UINT64_C(0x9896800000000000), UINT64_C(0xBEBC200000000000),
    UINT64_C(0xEE6B280000000000), UINT64_C(0x9502F90000000000), UINT64_C(0xBA43B74000000000), UINT64_C(0xE8D4A51000000000),
    UINT64_C(0x9184E72A00000000), UINT64_C(0xB5E620F480000000), UINT64_C(0xE35FA931A0000000), UINT64_C(0x8E1BC9BF04000000),
    UINT64_C(0xB1A2BC2EC5000000), UINT64_C(0xDE0B6B3A76400000), UINT64_C(0x8AC7230489E80000), UINT64_C(0xAD78EBC5AC620000),
    UINT64_C(0xD8D726B7177A8000), UINT64_C(0x878678326EAC9000), UINT64_C(0xA968163F0A57B400), UINT64_C(0xD3C21BCECCEDA100),
    UINT64_C(0x84595161401484A0), UINT64_C(0xA56FA5B99019A5C8), UINT64_C(0xCECB8F27F4200F3A), UINT64_C(0x813F3978F8940985),
    UINT64_C(0xA18F07D736B90BE6), UINT64_C(0xC9F2C9CD04674EDF), UINT64_C(0xFC6F7C4045812297), UINT64_C(0x9DC5ADA82B70B59E),
    UINT64_C(0xC5371912364CE306), UINT64_C(0xF684DF56C3E01BC7), UINT64_C(0x9A130B963A6C115D), UINT64_C(0xC097CE7BC90715B4),
    UINT64_C(0xF0BDC21ABB48DB21), UINT64_C(0x96769950B50D88F5), UINT64_C(0xBC143FA4E250EB32), UINT64_C(0xEB194F8E1AE525FE),
    UINT64_C(0x92EFD1B8D0CF37BF), UINT64_C(0xB7ABC627050305AE), UINT64_C(0xE596B7B0C643C71A), UINT64_C(0x8F7E32CE7BEA5C70),
    UINT64_C(0xB35DBF821AE4F38C),
};
// clang-format on

/* A decimal: digits * 10^exponent. */
typedef struct decimal {
    uint32_t digits;
    int32_t exponent;
} decimal;

/* Shifts the product down; the result is odd if any bit that was cut off is set. */
static inline uint32_t round_to_odd(uint64_t power, uint32_t factor)
{
    const unsigned __int128 product = (unsigned __int128)power * factor;
    return (uint32_t)(product >> 64) | ((uint32_t)(product >> 32) > 1);
}

static decimal shortest(uint32_t fraction, uint32_t biased)
{
    const uint32_t bits = biased ? fraction | UINT32_C(1) << FRACTION_BITS : fraction;
    const int32_t q = (biased ? (int32_t)biased : 1) - BIAS;
    if (q <= 0 && q > -24 && (bits & ((UINT32_C(1) << -q) - 1)) == 0)
        return (decimal){bits >> -q, 0};
    const uint32_t is_odd = bits & 1, is_power_of_two = fraction == 0 && biased > 1;
    /* floor(log10(2^q)); below a power of two, floor(log10(3/4 * 2^q)), since the gap is half as wide there. */
    const int32_t k = (q * 1262611 - (is_power_of_two ? 524031 : 0)) >> 22;
    const int32_t shift = q + ((-k * 1741647) >> 19) + 1;
    const uint64_t power = powers[-k - LEAST_POWER];
    const uint32_t lower = round_to_odd(power, (4 * bits - 2 + is_power_of_two) << shift) + is_odd;
    const uint32_t value = round_to_odd(power, (4 * bits) << shift);
    const uint32_t upper = round_to_odd(power, (4 * bits + 2) << shift) - is_odd;
    const uint32_t digits = value / 4;
    if (digits >= 10) {
        const uint32_t fewer = digits / 10;
        const bool is_low_inside = lower <= 40 * fewer, is_high_inside = 40 * fewer + 40 <= upper;
        if (is_low_inside != is_high_inside)
            return (decimal){fewer + is_high_inside, k + 1};
    }
    const bool is_low_inside = lower <= 4 * digits, is_high_inside = 4 * digits + 4 <= upper;
    if (is_low_inside != is_high_inside)
        return (decimal){digits + is_high_inside, k};
    const uint32_t middle = 4 * digits + 2;
    return (decimal){digits + (value > middle || (value == middle && (digits & 1))), k};
}

static size_t write_word(const char *word, uint8_t *text)
{
    memcpy(text, word, strlen(word));
    return strlen(word);
}

/* Writes "d.ddde+XX" with `count` digits, the first of which stands for 10^power. */
static size_t write_scientific(const uint8_t *digits, size_t count, int32_t power, uint8_t *text)
{
    uint8_t *at = text;
    *at++ = digits[0];
    if (count > 1) {
        *at++ = '.';
        memcpy(at, digits + 1, count - 1);
        at += count - 1;
    }
    *at++ = 'e';
    *at++ = power < 0 ? '-' : '+';
    const uint32_t size = (uint32_t)(power < 0 ? -power : power);
    *at++ = (uint8_t)('0' + size / 10);
    *at++ = (uint8_t)('0' + size % 10);
    return (size_t)(at - text);
}

/* Writes `places` digits before the point. If there are none, up to three zeros follow the point. */
static size_t write_positional(const uint8_t *digits, size_t count, int32_t places, uint8_t *text)
{
    if (places <= 0) {
        memcpy(text, "0.000", 5);
        memcpy(text + 2 - places, digits, count);
        return 2 + (size_t)-places + count;
    }
    const size_t whole = (size_t)places;
    if (count <= whole) {
        memcpy(text, digits, count);
        memset(text + count, '0', whole - count);
        return whole;
    }
    memcpy(text, digits, whole);
    text[whole] = '.';
    memcpy(text + whole + 1, digits + whole, count - whole);
    return count + 1;
}

size_t e3d_write_float(float number, uint8_t *text)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    const uint32_t fraction = bits & ((UINT32_C(1) << FRACTION_BITS) - 1);
    const uint32_t biased = bits >> FRACTION_BITS & 0xFF;
    if (biased == 0xFF && fraction)
        return write_word("nan", text);
    const size_t sign = bits >> 31;
    if (sign)
        *text++ = '-';
    if (biased == 0xFF)
        return sign + write_word("inf", text);
    if (!(bits << 1))
        return sign + write_word("0", text);
    decimal found = shortest(fraction, biased);
    uint8_t letters[10];
    size_t first = sizeof letters, last = sizeof letters;
    for (; found.digits; found.digits /= 10)
        letters[--first] = (uint8_t)('0' + found.digits % 10);
    const int32_t places = (int32_t)(last - first) + found.exponent;
    while (letters[last - 1] == '0')
        last--;
    const double size = sign ? -(double)number : number;
    const bool is_positional = size >= LEAST_POSITIONAL && size < MOST_POSITIONAL;
    return sign + (is_positional ? write_positional(letters + first, last - first, places, text)
                                 : write_scientific(letters + first, last - first, places - 1, text));
}
