/* Fuzzes the reading of decimal numbers: the bits that strtod gives, of exactly what the grammar allows. */
#include "io/loaders/decimal.h"

#include "check/fuzz/input.h"

static const char *skip_digits(const char *at)
{
    while (e3d_is_digit((uint8_t)*at))
        at++;
    return at;
}

/* The end of "[+-]digits[.digits][e[+-]digits]", or NULL. */
static const char *number_end(const char *at)
{
    at += *at == '-' || *at == '+';
    const char *whole = skip_digits(at), *end = whole;
    if (*whole == '.')
        end = skip_digits(whole + 1);
    if (end - at - (*whole == '.') == 0)
        return NULL;
    if (*end != 'e' && *end != 'E')
        return end;
    end++;
    end += *end == '-' || *end == '+';
    const char *last = skip_digits(end);
    return last == end ? NULL : last;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *text = room_for(size + 1, 1);
    memcpy(text, bytes, size);
    text[size] = '\n';
    double value = 0.0, expected = 0.0;
    const uint8_t *end = e3d_decimal_read((const uint8_t *)text, &value);
    CLAIM((const char *)end == number_end(text));
    if (end) {
        char *stopped;
        text[end - (const uint8_t *)text] = '\0';
        expected = strtod(text, &stopped);
        CLAIM(stopped == (const char *)end);
        CLAIM(memcmp(&value, &expected, sizeof value) == 0);
    }
    /* A word is read to its end and no farther. */
    uint8_t *word = room_for(size, 1);
    memcpy(word, bytes, size);
    if (e3d_decimal_word(word, size, &value))
        CLAIM(value - value != 0.0); /* infinity or NaN */
    free(word);
    free(text);
    return 0;
}
