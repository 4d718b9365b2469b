/* The sRGB code of a float in one look-up: made from core/srgb_tables.h.
 *
 * The upper 16 bits of a float in [0, 1], minus ENCODE_FIRST (at least 0), pick a bucket, which holds one threshold at most.
 * Its sum is the code at the bucket's low end, 17 bits up; adding the float's lower 16 bits carries from the threshold on.
 */
#ifndef E3D_ENCODE_TABLES_H
#define E3D_ENCODE_TABLES_H

#include <stdint.h>

enum { ENCODE_FIRST = 14592, ENCODE_BUCKETS = 1665 };

extern const int32_t ENCODE_SUMS[ENCODE_BUCKETS];

#endif
