/* What a surface is made of. */
#ifndef E3D_API_MATERIAL_H
#define E3D_API_MATERIAL_H

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_texture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The textures of a material: X(ENUMERATOR, name). */
#define E3D_EACH_TEXTURE_SLOT(X) X(E3D_SLOT_TEXTURE, texture) /* multiplies the colour */
typedef enum e3d_texture_slot { E3D_EACH_TEXTURE_SLOT(E3D_ENUMERATOR) E3D_TEXTURE_SLOTS } e3d_texture_slot;

/* What alpha means: nothing; that the surface is cut out where it is less than alpha_cutoff; how much of what is behind shows. */
#define E3D_EACH_ALPHA_MODE(X) X(E3D_ALPHA_OPAQUE, opaque) X(E3D_ALPHA_MASK, mask) X(E3D_ALPHA_BLEND, blend)
typedef enum e3d_alpha_mode { E3D_EACH_ALPHA_MODE(E3D_ENUMERATOR) } e3d_alpha_mode;

typedef struct e3d_material {
    float color[3];              /* in the frame's working space (linear, or raw 8-bit / 255) */
    float specular[3];           /* Blinn-Phong Ks; all zero: no highlight is computed */
    float shininess;             /* Blinn-Phong Ns, > 0 */
    float emissive[3];
#define E3D_MATERIAL_TEXTURE(enumerator, name) const e3d_texture *name;
    E3D_EACH_TEXTURE_SLOT(E3D_MATERIAL_TEXTURE) /* or NULL */
    int32_t id;                  /* what material_id outputs */
    int32_t two_sided;           /* not culled */
    int32_t flat;                /* face normals instead of vertex normals */
    float alpha;                 /* multiplies that of the texture, the vertices and the instance */
    e3d_alpha_mode alpha_mode;
    float alpha_cutoff;          /* of E3D_ALPHA_MASK */
} e3d_material;

void e3d_material_set_texture(e3d_material *material, e3d_texture_slot slot, const e3d_texture *texture);

#ifdef __cplusplus
}
#endif

#endif
