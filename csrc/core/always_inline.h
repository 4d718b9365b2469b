/* Functions that a compiler may not leave as calls: what is known to the caller then shapes them, and GCC drops calls of
 * functions that only fetch memory ahead.
 */
#ifndef E3D_ALWAYS_INLINE_H
#define E3D_ALWAYS_INLINE_H

#define ALWAYS_INLINE inline __attribute__((always_inline))

#endif
