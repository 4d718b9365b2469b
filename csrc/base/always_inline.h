/* Functions that must be inlined: constants of the caller specialise them. GCC would even drop the call of a function that
 * only prefetches. */
#ifndef E3D_ALWAYS_INLINE_H
#define E3D_ALWAYS_INLINE_H

#define ALWAYS_INLINE inline __attribute__((always_inline))

#endif
