/* The sRGB curve in straight pieces: how kernels find the code of a float without its thresholds (data/srgb_tables.h).
 *
 * v, in [0, 1], plus ENCODE_SHIFT is a float whose three upper bits of the mantissa and lower bits of the exponent tell the piece,
 * and whose next sixteen bits t how far along it v is. ENCODE_CURVE has a base in its upper half and a rise in its lower one: the
 * code is (base + (rise * t >> 16)) >> 8. Each piece is the line that errs least: a 22nd of a code at most. The shift leaves the
 * dark, where the curve is nearly straight, few pieces. After a table of Giesen's ("float->sRGB8 using SSE2", 2012).
 */
#pragma once

#include <stdint.h>

#define ENCODE_SHIFT 0x1p-7f
enum { ENCODE_PIECES = 64 };

extern const int32_t ENCODE_CURVE[ENCODE_PIECES];
