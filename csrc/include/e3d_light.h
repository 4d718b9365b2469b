/* Lights. */
#ifndef E3D_API_LIGHT_H
#define E3D_API_LIGHT_H

#include <stdint.h>

#include "e3d_options.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_light_kind { E3D_LIGHT_DIRECTIONAL = 0, E3D_LIGHT_POINT, E3D_LIGHT_SPOT } e3d_light_kind;

#define E3D_EACH_FALLOFF(X) \
    X(E3D_FALLOFF_INVERSE_SQUARE, inverse_square) X(E3D_FALLOFF_WINDOW, window) X(E3D_FALLOFF_GLTF, gltf)
typedef enum e3d_falloff { E3D_EACH_FALLOFF(E3D_ENUMERATOR) } e3d_falloff;

typedef struct e3d_light {
    e3d_light_kind kind;
    e3d_falloff falloff;
    float color[3];      /* colour times intensity, in the frame's working space */
    float to_light[3];   /* directional, spot: unit vector against the way that the light shines, world space */
    float position[3];   /* point, spot: world space */
    float range;         /* point, spot: contributes exactly 0 at distance >= range; may be +inf
                          * (not with E3D_FALLOFF_WINDOW) */
    float lux[3];        /* what physically based materials take for color: lux, of the others candela */
    float cone[2];       /* spot: the cosine of the outer angle, and 1 over what the inner one's is more */
} e3d_light;

enum { E3D_AMBIENT_TERMS = 9 };

/* Light from all around that differs from direction to direction (R130): what white surfaces show by their normal (x, y, z) is a sum of
 * 1, x, y, z, xx - zz, yy - zz, xy, yz and zx, each times its term, and then no less than 0. */
typedef struct e3d_ambient_light {
    int32_t is_given;
    float terms[E3D_AMBIENT_TERMS][3];
} e3d_ambient_light;

#ifdef __cplusplus
}
#endif

#endif
