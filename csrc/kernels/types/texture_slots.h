/* What shading works on where a material has more than a base colour: its textures, what they say of a batch, light on it. */
#ifndef E3D_KERNELS_TEXTURE_SLOTS_H
#define E3D_KERNELS_TEXTURE_SLOTS_H

#include <stdint.h>

#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"

/* As many places as textures, and one that only tangents are found by. */
enum { E3D_MOST_PLACES = E3D_TEXTURE_SLOTS + 1 };

/* Where textures are read (R45). Those at the same coordinates, of the same size, share a place. */
typedef struct e3d_texture_place {
    int32_t uv_set, is_moved;
    float matrix[6];
    float texels[2]; /* the counted size of the textures, for their levels */
    int32_t has_level;
} e3d_texture_place;

/* A texture that is read; slots with the same one at the same place share it. */
typedef struct e3d_read_texture {
    const e3d_texture_view *view;
    int32_t place, has_alpha; /* the number of its place; whether its fourth channel is read */
} e3d_read_texture;

/* The textures of a material that count on some mesh. */
typedef struct e3d_read_textures {
    e3d_texture_place places[E3D_MOST_PLACES];
    e3d_read_texture read[E3D_TEXTURE_SLOTS];
    int32_t place_count, count;
    int32_t of_slot[E3D_TEXTURE_SLOTS]; /* the number of its texture, or -1 */
    int32_t tangent_place;              /* the place that tangents are found by (R47), or -1: none are */
    int32_t vertex_tangents;            /* not 0: the mesh's own */
} e3d_read_textures;

/* What surfaces bring to textures, beside e3d_surfaces and in the same order. */
typedef struct e3d_texture_surfaces {
    e3d_surface_floats uv[E3D_MOST_PLACES][2][3];    /* by place: [coordinate][vertex] */
    e3d_surface_floats slope[E3D_MOST_PLACES][2][3]; /* [coordinate]: along, down and turn of R25 */
    e3d_surface_floats tangent[3][3];                /* [component][vertex], in object space, then in world space */
    e3d_surface_floats sign;                         /* of the bitangent */
    e3d_surface_words turned_round;                  /* not 0: the determinant of the instance is negative */
} e3d_texture_surfaces;

/* What textures say of a batch, in its order. */
typedef struct e3d_texture_batch {
    e3d_lane_array uv[E3D_MOST_PLACES][2];
    int32_t lod[E3D_MOST_PLACES][E3D_BATCH + E3D_PAD];
    e3d_lane_array texel[E3D_TEXTURE_SLOTS][4]; /* by texture: channels, before they are multiplied by the unit */
    e3d_lane_array tangent[4];                  /* and the sign of the bitangent */
    e3d_lane_array shading_normal[3];           /* before it is mapped: then it is the batch's normal */
    e3d_lane_array coat_normal[3];
    e3d_lane_array metallic_roughness[2], emissive[3]; /* for outputs */
    e3d_lane_array direct[3], coat[3], fuzz[3];      /* sums over lights so far, where they are many */
    e3d_lane_array depth;                            /* world units that a thickness of 1 is */
    e3d_lane_array through[3];                       /* which share of the light behind is seen (R134) */
} e3d_texture_batch;

/* A number of a material: a constant, or a texture's channel times a factor. */
typedef struct e3d_varying {
    const float *lanes; /* or NULL */
    float factor;
} e3d_varying;

/* A texture of normals: the texture's unit, and how much of it counts along the surface. */
typedef struct e3d_normal_texture {
    const e3d_lane_array *texels; /* or NULL */
    float unit, scale;
} e3d_normal_texture;

/* Anisotropy: where its texture says nothing, the direction is the tangent turned. */
typedef struct e3d_anisotropy_texture {
    const e3d_lane_array *texels; /* or NULL */
    float unit, strength, turn[2]; /* turn: cosine and sine */
} e3d_anisotropy_texture;

/* What of a physically based material a texture varies: X(slot, channel, name, factor), with the factors of an e3d_material m. */
#define E3D_EACH_VARYING(X) \
    X(E3D_SLOT_METALLIC_ROUGHNESS, 2, metallic, m->physical.metallic) \
    X(E3D_SLOT_METALLIC_ROUGHNESS, 1, roughness, m->physical.roughness) \
    X(E3D_SLOT_OCCLUSION, 0, occlusion, 1.0f) /* before the strength */ \
    X(E3D_SLOT_SPECULAR, 3, specular, m->physical.specular_intensity) \
    X(E3D_SLOT_CLEARCOAT, 0, coat, m->physical.clearcoat) \
    X(E3D_SLOT_CLEARCOAT_ROUGHNESS, 1, coat_roughness, m->physical.clearcoat_roughness) \
    X(E3D_SLOT_SHEEN_ROUGHNESS, 3, sheen_roughness, m->physical.sheen_roughness) \
    X(E3D_SLOT_TRANSMISSION, 0, transmission, m->physical.transmission) \
    X(E3D_SLOT_THICKNESS, 1, thickness, m->physical.thickness) \
    X(E3D_SLOT_IRIDESCENCE, 0, iridescence, m->physical.iridescence)
/* The same of colours, each of three channels: X(slot, name, factors). */
#define E3D_EACH_VARYING_COLOR(X) \
    X(E3D_SLOT_SPECULAR_COLOR, reflectance, m->physical.reflectance) \
    X(E3D_SLOT_EMISSIVE, emissive, m->emissive) \
    X(E3D_SLOT_SHEEN_COLOR, sheen, m->physical.sheen_color)

/* The numbers of a physically based material's BRDF on a batch (R46, R49). */
typedef struct e3d_brdf {
#define E3D_VARYING(slot, channel, name, factor) e3d_varying name;
    E3D_EACH_VARYING(E3D_VARYING)
#define E3D_VARYING_COLOR(slot, name, factors) e3d_varying name[3];
    E3D_EACH_VARYING_COLOR(E3D_VARYING_COLOR)
    float occlusion_strength;
    int has_coat, has_sheen;
    int is_grey;         /* the reflectance is the same of all channels */
    int coat_is_mapped;  /* coat_normal is read; else the coat's normal is shading_normal */
    float absorption[3]; /* base-2 logarithm of what a world unit leaves of light */
    int transmits;       /* `through` is found */
    int absorbs;         /* by `depth` */
    int anisotropic, iridescent;
    e3d_anisotropy_texture stretch;
    e3d_varying iridescence_thickness; /* of the film, in nanometres, above the least */
    float iridescence_thickness_least, iridescence_ior;
    int is_rare;      /* it transmits, or is anisotropic or iridescent */
} e3d_brdf;

#endif
