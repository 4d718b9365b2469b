/* Functions that must be inlined: constants of the caller specialise them. GCC would even drop the call of a function that
 * only prefetches. */
#pragma once

#define ALWAYS_INLINE inline __attribute__((always_inline))
