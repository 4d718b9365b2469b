/* Where to start counting sRGB thresholds: made from core/srgb_tables.h.
 *
 * The bits of a float in [0, 1], shifted right by ENCODE_SHIFT, minus ENCODE_FIRST (clamped), pick a bucket;
 * ENCODE_GUESS is the code at the bucket's low end, and no bucket holds more than ENCODE_STEPS thresholds.
 */
#ifndef E3D_ENCODE_TABLES_H
#define E3D_ENCODE_TABLES_H

#include <stdint.h>

enum { ENCODE_SHIFT = 16, ENCODE_FIRST = 14592, ENCODE_BUCKETS = 1665, ENCODE_STEPS = 1 };

extern const int32_t ENCODE_GUESS[ENCODE_BUCKETS];

#endif
