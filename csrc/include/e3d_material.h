/* A material: the look of a surface. */
#pragma once

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_texture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The texture slots of a material: X(ENUMERATOR, name). A texture multiplies the factor that its slot is named after, by some of
 * its channels. */
#define E3D_EACH_TEXTURE_SLOT(X) \
    X(E3D_SLOT_TEXTURE, texture) /* the colour, and alpha */ \
    X(E3D_SLOT_METALLIC_ROUGHNESS, metallic_roughness_texture) /* G roughness, B metallic */ \
    X(E3D_SLOT_NORMAL, normal_texture) \
    X(E3D_SLOT_OCCLUSION, occlusion_texture) /* R */ \
    X(E3D_SLOT_EMISSIVE, emissive_texture) \
    X(E3D_SLOT_CLEARCOAT, clearcoat_texture) /* R */ \
    X(E3D_SLOT_CLEARCOAT_ROUGHNESS, clearcoat_roughness_texture) /* G */ \
    X(E3D_SLOT_CLEARCOAT_NORMAL, clearcoat_normal_texture) \
    X(E3D_SLOT_SPECULAR, specular_texture) /* A */ \
    X(E3D_SLOT_SPECULAR_COLOR, specular_color_texture) \
    X(E3D_SLOT_SHEEN_COLOR, sheen_color_texture) \
    X(E3D_SLOT_SHEEN_ROUGHNESS, sheen_roughness_texture) /* A */ \
    X(E3D_SLOT_TRANSMISSION, transmission_texture) /* R */ \
    X(E3D_SLOT_THICKNESS, thickness_texture) /* G */ \
    X(E3D_SLOT_ANISOTROPY, anisotropy_texture) /* R and G: the direction, B: the strength */ \
    X(E3D_SLOT_IRIDESCENCE, iridescence_texture) /* R */ \
    X(E3D_SLOT_IRIDESCENCE_THICKNESS, iridescence_thickness_texture) /* G: 0 is the least thickness, 1 the greatest */ \
    X(E3D_SLOT_DIFFUSE_TRANSMISSION, diffuse_transmission_texture) /* A */ \
    X(E3D_SLOT_DIFFUSE_TRANSMISSION_COLOR, diffuse_transmission_color_texture)
typedef enum e3d_texture_slot { E3D_EACH_TEXTURE_SLOT(E3D_ENUMERATOR) E3D_TEXTURE_SLOTS } e3d_texture_slot;

/* A texture in a slot, and the coordinates at which it is read. */
typedef struct e3d_texture_use {
    const e3d_texture *texture; /* or NULL */
    int32_t uv_set;             /* 0: uvs, 1: uvs1 */
    int32_t is_moved;           /* 0: the matrix is the identity, and is not read */
    float matrix[6];            /* two rows of three; coordinates have their origin at the bottom left */
} e3d_texture_use;

#define E3D_EACH_ALPHA_MODE(X) X(E3D_ALPHA_OPAQUE, opaque) X(E3D_ALPHA_MASK, mask) X(E3D_ALPHA_BLEND, blend)
typedef enum e3d_alpha_mode { E3D_EACH_ALPHA_MODE(E3D_ENUMERATOR) } e3d_alpha_mode;

/* The parameters of a physically based material besides its colours (docs/exactness, section 12). */
typedef struct e3d_physical {
    float metallic, roughness; /* 0 .. 1 */
    float occlusion_strength;
    float reflectance[3];      /* F0 of the part that isn't metal, before specular_intensity */
    float specular_intensity;
    float clearcoat, clearcoat_roughness, clearcoat_normal_scale;
    float sheen_color[3], sheen_roughness;
    float transmission, thickness;
    float diffuse_transmission, diffuse_transmission_color[3]; /* the share of scattered light that passes; its colour */
    float ior, dispersion;     /* the index of refraction, 1 or more, and how much that differs between colours (R164) */
    float absorption[3];       /* the base-2 logarithm of the share of light that is left after a world unit of thickness */
    float anisotropy, anisotropy_turn[2]; /* strength, 0 .. 1; cosine and sine of the angle from the tangent */
    float iridescence, iridescence_ior;   /* the share, 0 .. 1; the film's index of refraction, 1 or more */
    float iridescence_thickness[2];       /* of the film: the least and the greatest, in nanometres */
} e3d_physical;

typedef struct e3d_material {
    float color[3];              /* in the frame's working space (linear, or raw 8-bit / 255) */
    float alpha;                 /* 0 .. 1 */
    float specular[3];           /* Blinn-Phong Ks; all zero: no highlight is computed */
    float shininess;             /* Blinn-Phong Ns, > 0 */
    float emissive[3];
    float normal_scale;          /* scales the normal texture's slopes */
#define E3D_MATERIAL_TEXTURE(enumerator, name) e3d_texture_use name;
    E3D_EACH_TEXTURE_SLOT(E3D_MATERIAL_TEXTURE)
    int32_t id;                  /* what material_id outputs */
    int32_t two_sided;           /* not culled */
    int32_t flat;                /* face normals instead of vertex normals */
    int32_t is_unlit;            /* shows its colour in mode lit as well */
    e3d_alpha_mode alpha_mode;
    float alpha_cutoff;          /* of E3D_ALPHA_MASK */
    float mirror;                /* 0 .. 1: how much of a perfect mirror flat faces are */
    int32_t is_physical;         /* 0: `physical` is not read */
    e3d_physical physical;
} e3d_material;

void e3d_material_set_texture(e3d_material *material, e3d_texture_slot slot, const e3d_texture_use *use);

#ifdef __cplusplus
}
#endif
