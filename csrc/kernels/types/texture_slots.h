/* The data of shading a material with more than a base colour: its textures, their values for a batch, and light on it. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"

/* As many places as textures, and one that only tangents use. */
enum { E3D_MOST_PLACES = E3D_TEXTURE_SLOTS + 1 };

/* The place at which textures are read (R45). Textures of one size at the same coordinates share a place. */
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

/* The textures of a material that count on a mesh. */
typedef struct e3d_read_textures {
    e3d_texture_place places[E3D_MOST_PLACES];
    e3d_read_texture read[E3D_TEXTURE_SLOTS];
    int32_t place_count, count;
    int32_t of_slot[E3D_TEXTURE_SLOTS]; /* the number of its texture, or -1 */
    int32_t tangent_place;              /* the place whose coordinates define tangents (R47); -1: there are no tangents */
    int32_t vertex_tangents;            /* not 0: tangents are those of the mesh's vertices */
} e3d_read_textures;

/* The attributes of surfaces that textures need, in the order of e3d_surfaces. */
typedef struct e3d_texture_surfaces {
    e3d_surface_floats uv[E3D_MOST_PLACES][2][3];    /* by place: [coordinate][vertex] */
    e3d_surface_floats slope[E3D_MOST_PLACES][2][3]; /* [coordinate]: along, down and turn of R25 */
    e3d_surface_floats tangent[3][3];                /* [component][vertex], in object space, then in world space */
    e3d_surface_floats sign;                         /* of the bitangent */
    e3d_surface_words turned_round;                  /* not 0: the determinant of the instance is negative */
} e3d_texture_surfaces;

/* The values of textures for a batch, in its order. */
typedef struct e3d_texture_batch {
    e3d_lane_array uv[E3D_MOST_PLACES][2];
    int32_t lod[E3D_MOST_PLACES][E3D_BATCH + E3D_PAD];
    e3d_lane_array texel[E3D_TEXTURE_SLOTS][4]; /* by texture: its channels, not yet multiplied by the unit */
    e3d_lane_array tangent[4];                  /* and the sign of the bitangent */
    e3d_lane_array shading_normal[3];           /* the normal before mapping; the mapped one is the batch's normal */
    e3d_lane_array coat_normal[3];
    e3d_lane_array metallic_roughness[2], emissive[3]; /* for outputs */
    e3d_lane_array direct[3], coat[3], fuzz[3];      /* the sums over lights so far, if there are many lights */
    e3d_lane_array depth;                            /* the world units of a thickness of 1, 0 on back faces */
    e3d_lane_array body;                             /* the same on both sides, times the thickness (R168) */
    e3d_lane_array through[3];                       /* the share of the light behind that is seen (R134) */
} e3d_texture_batch;

/* A number of a material: a constant, or a texture's channel times a factor. */
typedef struct e3d_varying {
    const float *lanes; /* or NULL */
    float factor;
} e3d_varying;

/* A normal texture: its texels and their unit, and the scale of its slopes. */
typedef struct e3d_normal_texture {
    const e3d_lane_array *texels; /* or NULL */
    float unit, scale;
} e3d_normal_texture;

/* Anisotropy: without a texture, the direction is the tangent, turned by an angle. */
typedef struct e3d_anisotropy_texture {
    const e3d_lane_array *texels; /* or NULL */
    float unit, strength, turn[2]; /* turn: the cosine and the sine of the angle */
} e3d_anisotropy_texture;

/* The numbers of a physically based material that textures vary: X(slot, channel, name, factor); factors are those of an
 * e3d_material m. */
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
    X(E3D_SLOT_IRIDESCENCE, 0, iridescence, m->physical.iridescence) \
    X(E3D_SLOT_DIFFUSE_TRANSMISSION, 3, diffuse_transmission, m->physical.diffuse_transmission)
/* The same for colours of three channels: X(slot, name, factors). */
#define E3D_EACH_VARYING_COLOR(X) \
    X(E3D_SLOT_SPECULAR_COLOR, reflectance, m->physical.reflectance) \
    X(E3D_SLOT_EMISSIVE, emissive, m->emissive) \
    X(E3D_SLOT_SHEEN_COLOR, sheen, m->physical.sheen_color) \
    X(E3D_SLOT_DIFFUSE_TRANSMISSION_COLOR, passing, m->physical.diffuse_transmission_color)

/* The numbers of a physically based material's BRDF on a batch (R46, R49). */
typedef struct e3d_brdf {
#define E3D_VARYING(slot, channel, name, factor) e3d_varying name;
    E3D_EACH_VARYING(E3D_VARYING)
#define E3D_VARYING_COLOR(slot, name, factors) e3d_varying name[3];
    E3D_EACH_VARYING_COLOR(E3D_VARYING_COLOR)
    int is_widened; /* R193: by these */
    e3d_varying wide, coat_wide;
    float occlusion_strength;
    int has_coat, has_sheen;
    int is_grey;         /* all channels have the same reflectance */
    int coat_is_mapped;  /* the coat's normal is coat_normal; else it is shading_normal */
    float absorption[3]; /* the base-2 logarithm of the share of light that is left after a world unit */
    int transmits;       /* not 0: `through` is found */
    int translucent;     /* not 0: light passes that is scattered; the batch's `energy` is what falls on the other side (R169) */
    int absorbs;         /* by `depth`, and by `body` */
    int anisotropic, iridescent;
    e3d_anisotropy_texture stretch;
    e3d_varying iridescence_thickness; /* of the film, in nanometres, above the least */
    float iridescence_thickness_least, iridescence_ior;
    const float *unmirrored; /* NULL, or lanes: the share of what lies around that is reflected (R211) */
    int is_rare;      /* it transmits, is translucent, anisotropic, iridescent or a mirror */
} e3d_brdf;

/* A batch of surfaces that bend. */
typedef struct e3d_bending {
    const int32_t *sample;                              /* the batch's, */
    const float *normal[3], *position[3], *lit_position[3]; /* its normals, and where its samples are and are lit */
    float eye[4];
    float rows[3][4];             /* the first, second and fourth row of clip_from_world */
    float depth_row[4];           /* the third of view_from_world */
    float width, height;          /* of the picture, in pixels */
    int32_t x, y;                 /* the tile's first sample */
    float pixels_a_sample;
    float index[3];               /* of refraction, by channel */
    int is_dispersive;            /* not 0: channels differ */
    int is_body;                  /* its thickness isn't 0 */
    float blur_share;             /* by the index of refraction */
    float blur_width, blur_area;  /* pixels of the whole picture across, and the frame's pixels in each (R273) */
    e3d_varying thickness, roughness;
} e3d_bending;

/* The bends of a batch, in its order (e3d_bend). */
typedef struct e3d_bend_batch {
    int32_t shift[3][2][E3D_BATCH + E3D_PAD], blur[E3D_BATCH + E3D_PAD];
    e3d_lane_array depth;
} e3d_bend_batch;
