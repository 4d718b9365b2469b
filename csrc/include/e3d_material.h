/* What a surface is made of. */
#ifndef E3D_API_MATERIAL_H
#define E3D_API_MATERIAL_H

#include <stdint.h>

#include "e3d_texture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_material {
    float color[3];              /* in the frame's working space (linear, or raw 8-bit / 255) */
    float specular[3];           /* Blinn-Phong Ks; all zero: no highlight is computed */
    float shininess;             /* Blinn-Phong Ns, > 0 */
    float emissive[3];
    const e3d_texture *texture;  /* or NULL */
    int32_t id;                  /* what material_id outputs */
    int32_t two_sided;           /* not culled */
    int32_t flat;                /* face normals instead of vertex normals */
} e3d_material;

#ifdef __cplusplus
}
#endif

#endif
