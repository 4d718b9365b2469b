/* The decimal numbers that need more than one exact operation on doubles.
 *
 * In:  digits and a power of ten. Out: the nearest double, ties to even, by integer arithmetic only.
 * Up to 19 digits and powers to 10^27 take one division, or multiplication, of 128 bits. All others take an
 * integer as long as needed (never more than LIMBS), multiplied or divided by powers of five piece by piece:
 * floor(floor(n / a) / b) is floor(n / (a b)), and whether anything was left over decides the rounding.
 */
#include "decimal.h"

#include <math.h>
#include <string.h>

typedef unsigned __int128 wide;

#define POWER_OF_FIVE 27 /* the greatest power that 63 bits hold */
/* Points halfway between two doubles have at most 767 digits. Of further digits it only matters whether any is not zero. */
#define MOST_DIGITS 768
/* A quotient has at least so many value bits. */
#define QUOTIENT_BITS 66
/* Room for 10^769, or for 5^(343 + 769) and a quotient, in 64 bits each, and one more for the carry. */
#define LIMBS 44

const double e3d_powers_of_ten[E3D_EXACT_POWER + 1] = {
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

typedef struct integer {
    uint64_t limb[LIMBS]; /* lowest first; the highest is not zero */
    int count;
} integer;

static const uint64_t powers_of_five[POWER_OF_FIVE + 1] = {
    1u, 5u, 25u, 125u, 625u, 3125u, 15625u, 78125u, 390625u, 1953125u, 9765625u, 48828125u,
    244140625u, 1220703125u, 6103515625u, 30517578125u, 152587890625u, 762939453125u,
    3814697265625u, 19073486328125u, 95367431640625u, 476837158203125u, 2384185791015625u,
    11920928955078125u, 59604644775390625u, 298023223876953125u, 1490116119384765625u,
    7450580596923828125u};

/* Rounds (mantissa + a little more, if `sticky`) * 2^exponent to a double; the mantissa's top bit is set. */
static double rounded(uint64_t mantissa, bool sticky, int64_t exponent)
{
    const int64_t leading = exponent + 63;
    if (leading > 1023)
        return INFINITY;
    const int64_t drop = leading >= -1022 ? 11 : 11 + (-1022 - leading);
    if (drop > 64)
        return 0.0;
    const uint64_t half = UINT64_C(1) << (drop - 1);
    const uint64_t rest = drop == 64 ? mantissa : mantissa & (2 * half - 1);
    uint64_t bits = drop == 64 ? 0 : mantissa >> drop;
    bits += rest > half || (rest == half && (sticky || (bits & 1)));
    /* The leading bit adds one to the exponent, and so does a carry from rounding. */
    if (leading >= -1022)
        bits += (uint64_t)(leading + 1022) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void multiply_add(integer *n, uint64_t factor, uint64_t summand)
{
    uint64_t carry = summand;
    for (int i = 0; i < n->count; i++) {
        const wide product = (wide)n->limb[i] * factor + carry;
        n->limb[i] = (uint64_t)product;
        carry = (uint64_t)(product >> 64);
    }
    if (carry)
        n->limb[n->count++] = carry;
}

/* Divides; returns whether anything is left over. */
static bool divide(integer *n, uint64_t divisor)
{
    uint64_t rest = 0;
    for (int i = n->count - 1; i >= 0; i--) {
        const wide dividend = (wide)rest << 64 | n->limb[i];
        n->limb[i] = (uint64_t)(dividend / divisor);
        rest = (uint64_t)dividend - n->limb[i] * divisor;
    }
    while (n->count && n->limb[n->count - 1] == 0)
        n->count--;
    return rest != 0;
}

static int64_t bit_count(const integer *n)
{
    return 64 * (int64_t)n->count - __builtin_clzll(n->limb[n->count - 1]);
}

static void shift_limbs(integer *n, int limbs)
{
    memmove(n->limb + limbs, n->limb, (size_t)n->count * sizeof n->limb[0]);
    memset(n->limb, 0, (size_t)limbs * sizeof n->limb[0]);
    n->count += limbs;
}

/* Returns n * 2^exponent as a double; `sticky`: plus a little more. */
static double integer_value(const integer *n, bool sticky, int64_t exponent)
{
    const int top = n->count - 1, shift = __builtin_clzll(n->limb[top]);
    uint64_t mantissa = n->limb[top] << shift;
    if (top > 0 && shift > 0) {
        mantissa |= n->limb[top - 1] >> (64 - shift);
        sticky |= (n->limb[top - 1] << shift) != 0;
    } else if (top > 0) {
        sticky |= n->limb[top - 1] != 0;
    }
    for (int i = 0; i + 1 < top; i++)
        sticky |= n->limb[i] != 0;
    return rounded(mantissa, sticky, exponent + 64 * (int64_t)top - shift);
}

static int64_t smaller(int64_t a, int64_t b) { return a < b ? a : b; }

/* Returns n * 10^exponent; n is not zero and has at most MOST_DIGITS + 1 digits. */
static double scaled(integer *n, int64_t exponent)
{
    if (exponent > 308)
        return INFINITY;
    /* 10^k lies between 2^(3.321 k) and 2^(3.322 k). Both limits also bound the limbs below. */
    if (exponent >= 0 && bit_count(n) - 1 + exponent * 3321 / 1000 > 1024)
        return INFINITY;
    if (exponent < -2000 || bit_count(n) + exponent * 3321 / 1000 < -1076)
        return 0.0;
    bool sticky = false;
    int64_t binary = exponent;
    if (exponent >= 0) {
        for (int64_t left = exponent; left > 0; left -= POWER_OF_FIVE)
            multiply_add(n, powers_of_five[smaller(left, POWER_OF_FIVE)], 0);
    } else {
        /* 5^k has at most 2.33 k + 1 bits. */
        const int64_t wanted = QUOTIENT_BITS + 1 - exponent * 233 / 100 - bit_count(n);
        const int limbs = wanted > 0 ? (int)((wanted + 63) / 64) : 0;
        shift_limbs(n, limbs);
        binary -= 64 * limbs;
        for (int64_t left = -exponent; left > 0; left -= POWER_OF_FIVE)
            sticky |= divide(n, powers_of_five[smaller(left, POWER_OF_FIVE)]);
    }
    return integer_value(n, sticky, binary);
}

double e3d_decimal_value(uint64_t digits, int64_t exponent)
{
    if (digits == 0)
        return 0.0;
    if (exponent < -POWER_OF_FIVE || exponent > POWER_OF_FIVE) {
        integer n = {{digits}, 1};
        return scaled(&n, exponent);
    }
    if (exponent >= 0) {
        const wide product = (wide)digits * powers_of_five[exponent];
        integer n = {{(uint64_t)product, (uint64_t)(product >> 64)}, (product >> 64) ? 2 : 1};
        return integer_value(&n, false, exponent);
    }
    const uint64_t divisor = powers_of_five[-exponent];
    /* With both top bits set, the quotient has 63 or 64 bits. */
    const int shift = __builtin_clzll(digits), divisor_shift = __builtin_clzll(divisor);
    const wide dividend = (wide)(digits << shift) << 63;
    const uint64_t quotient = (uint64_t)(dividend / (divisor << divisor_shift));
    const bool sticky = (wide)quotient * (divisor << divisor_shift) != dividend;
    const int last = __builtin_clzll(quotient);
    return rounded(quotient << last, sticky, exponent - 63 - shift + divisor_shift - last);
}

/* Reads all digits that matter as one integer. */
static double exact_value(const uint8_t *text, const uint8_t *end, int64_t exponent)
{
    integer n = {{0}, 0};
    int taken = 0;
    bool more = false;
    for (; text < end; text++) {
        if (*text == '.')
            continue;
        if (taken < MOST_DIGITS) {
            multiply_add(&n, 10, (uint8_t)(*text - '0'));
            taken++;
        } else {
            more |= *text != '0';
            exponent++;
        }
    }
    if (more) {
        multiply_add(&n, 10, 1);
        exponent--;
    }
    return scaled(&n, exponent);
}

double e3d_decimal_long_value(const uint8_t *text, size_t count, int64_t exponent)
{
    const uint8_t *const end = text + count;
    while (text < end && (*text == '0' || *text == '.'))
        text++;
    uint64_t digits = 0;
    int taken = 0;
    bool more = false;
    int64_t dropped = 0;
    for (const uint8_t *at = text; at < end; at++) {
        if (*at == '.')
            continue;
        if (taken < E3D_DECIMAL_DIGITS) {
            digits = digits * 10 + (uint8_t)(*at - '0');
            taken++;
        } else {
            more |= *at != '0';
            dropped++;
        }
    }
    const double low = e3d_decimal_value(digits, exponent + dropped);
    if (!more || low == e3d_decimal_value(digits + 1, exponent + dropped))
        return low;
    return exact_value(text, end, exponent);
}

/* Whether a text is a word of lower-case letters, in any case. */
static bool is_word(const uint8_t *text, size_t length, const char *word)
{
    if (length != strlen(word))
        return false;
    for (size_t i = 0; i < length; i++)
        if ((text[i] | 0x20) != (uint8_t)word[i])
            return false;
    return true;
}

/* The length without the parentheses that newer Microsoft libraries write behind nan, as in nan(ind). */
static size_t plain_length(const uint8_t *text, size_t length)
{
    const uint8_t *const parenthesis = length ? memchr(text, '(', length) : NULL;
    if (!parenthesis || text[length - 1] != ')')
        return length;
    for (const uint8_t *at = parenthesis + 1; at < text + length - 1; at++)
        if ((*at | 0x20) < 'a' || (*at | 0x20) > 'z')
            return length;
    return (size_t)(parenthesis - text);
}

bool e3d_decimal_word(const uint8_t *text, size_t length, double *value)
{
    const size_t plain = plain_length(text, length);
    const uint8_t *const end = text + plain;
    const bool negative = length && *text == '-';
    text += length && (negative || *text == '+');
    bool infinite = is_word(text, (size_t)(end - text), "inf") ||
                    is_word(text, (size_t)(end - text), "infinity");
    bool known = infinite || is_word(text, (size_t)(end - text), "nan");
    if (end - text > 3 && e3d_is_digit(text[0]) && text[1] == '.' && text[2] == '#') {
        const uint8_t *letters = text + 3, *last = end;
        while (last > letters && e3d_is_digit(last[-1]))
            last--;
        const size_t count = (size_t)(last - letters);
        infinite = is_word(letters, count, "inf");
        known = infinite || is_word(letters, count, "ind") || is_word(letters, count, "qnan") ||
                is_word(letters, count, "snan") || is_word(letters, count, "qnb");
    }
    if (!known || (infinite && plain < length))
        return false;
    const double size = infinite ? INFINITY : NAN;
    *value = negative ? -size : size;
    return true;
}
