/* Functions that must be inlined: constants of the caller specialise them, and GCC drops a call of a function that does nothing but
 * prefetch.
 */
#ifndef E3D_ALWAYS_INLINE_H
#define E3D_ALWAYS_INLINE_H

#define ALWAYS_INLINE inline __attribute__((always_inline))

#endif
