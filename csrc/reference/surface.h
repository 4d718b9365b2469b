/* The surface at one sample, and the stages that find it: surface, texture, texture slots, environment, light, shade. */
#pragma once

#include "reference/arithmetic.h"
#include "reference/stages.h"

/* The place at which a texture is read: a set of coordinates, moved (R45). */
typedef struct ref_coordinates {
    float uv[2], corner[2][3]; /* [coordinate][vertex] */
} ref_coordinates;

/* The directions of a lobe that is rougher along t than along b (R136). */
typedef struct ref_stretch {
    float t[3], b[3], strength;
} ref_stretch;

/* A physically based material at one sample (R46). */
typedef struct ref_physical {
    float metallic, roughness, occlusion;
    float wide, coat_wide; /* R193: how much wider the lobes become */
    float specular, reflectance[3]; /* F90 and F0 of the part that isn't metal */
    float coat, coat_roughness, coat_normal[3];
    float sheen[3], sheen_roughness;
    float transmission, depth; /* depth: the distance in world units over which light is absorbed (R134) */
    float scale;               /* the world units of a thickness of 1, 0 on back faces (R134) */
    float diffuse_transmission, passing[3], body; /* D and P of R168, and its depth */
    ref_stretch stretch;       /* used if the material has anisotropy */
    float iridescence, film_thickness;
} ref_physical;

/* The surface at one sample. */
typedef struct ref_surface {
    const ref_casters *casters; /* of the scene */
    const ref_piece *piece;
    const ref_instance *instance;
    float dx, dy, weight[3], r; /* of R19 */
    float barycentric[3];
    float world_position[3], view_position[3];
    float lit_position[3]; /* R153: the position in world space at which light is found */
    float metric_depth, range; /* range: R181 */
    float corner_position[3][3];                 /* [vertex], in world space */
    float corner_normal[3][3];                   /* likewise, turned to the viewer's side; used if is_smooth */
    int is_smooth;                               /* the normal is that of the corners (R22) */
    float shading_normal[3];                     /* the normal before it is mapped */
    float curvature;                             /* R191 */
    float world_normal[3], view_normal[3];
    float tangent[4], view_tangent[4]; /* R47; all 0 if there is none */
    float uv[2];                                 /* of set 0 */
    float albedo[3], alpha; /* alpha: R80 */
    int32_t alpha_lod;      /* R190: lod of the texture that has alpha */
    int is_finest;          /* R190: textures are read at level 0 */
    float emissive[3];
    ref_physical physical; /* used if the face's material is physical */
    float visibility;      /* R129: the share of ambient light that arrives */
    float mirror, mirrored_light[3]; /* R210: the share of a mirror, 0: none; what its picture shows there */
} ref_surface;

/* R20 for three values. */
static inline float ref_interpolate(const ref_surface *surface, const float corners[3])
{
    return ref_dot3(surface->weight, corners) * surface->r;
}

/* R134, R168: whether a body absorbs light. */
static inline int ref_absorbs(const e3d_physical *p)
{
    return p->thickness != 0.0f && (p->absorption[0] != 0.0f || p->absorption[1] != 0.0f || p->absorption[2] != 0.0f);
}

/* surface.c */
/* With multisampling, R105 applies: the surface is found at the pixel's centre, or at the sample if the piece's corners don't
 * allow that. */
void ref_surface_at(const ref_scene *scene, const ref_piece *piece, const ref_place *at, ref_surface *out);
/* The same so many pixels to the right and below, where the piece may have ended, or with textures read at level 0 (R190). */
typedef struct ref_other_way {
    float beside[2];
    int is_finest;
} ref_other_way;
void ref_surface_other(const ref_scene *scene, const ref_piece *piece, const ref_place *at, const ref_other_way *way, ref_surface *out);
void ref_decode_color(const e3d_frame *frame, const uint8_t color[4], float out[4]);

/* texture.c */
/* Returns the unit. */
float ref_texture_sample(const e3d_texture_view *texture, const ref_surface *surface, const ref_coordinates *at, float out[4]);

/* texture_slots.c */
int ref_slot_counts(const e3d_texture_use *use, const ref_surface *surface);
void ref_slot_coordinates(const e3d_texture_use *use, const ref_surface *surface, ref_coordinates *out);
float ref_slot_sample(const e3d_texture_use *use, const ref_surface *surface, float out[4]);
int32_t ref_slot_alpha_lod(const e3d_texture_use *use, const ref_surface *surface);
void ref_find_textures(const ref_scene *scene, ref_surface *surface);

/* environment.c */
void ref_environment(const e3d_environment_light *light, const float direction[3], float level, float out[3]);
void ref_environment_specular(const e3d_environment_light *light, const float direction[3], float roughness, float out[3]);
void ref_environment_irradiance(const e3d_environment_light *light, const float normal[3], float out[3]); /* over pi */
void ref_backdrop(const e3d_backdrop *backdrop, int32_t x, int32_t y, float out[3]);
float ref_albedo(e3d_dfg kind, float roughness, float cosine);

/* light.c */
/* R130: the ambient light that white surfaces of that normal show. */
void ref_ambient(const e3d_frame *frame, const float normal[3], float out[3]);
/* R54: that and the irradiance of an environment. */
void ref_irradiance(const e3d_frame *frame, const float normal[3], float out[3]);
/* Finds the unit vector from p to the light, and its attenuation, by the formula of R51 if by_product; returns 0 if the light
 * is out of range. */
int ref_light_reach(const e3d_light *light, const float p[3], int by_product, float l[3], float *attenuation);
void ref_light(const e3d_frame *frame, const ref_surface *surface, float out[3]);
/* R169: the light that a white surface would show on the other side. */
void ref_backlight(const e3d_frame *frame, const ref_surface *surface, float out[3]);
void ref_direction_to_eye(const e3d_frame *frame, const ref_surface *surface, float out[3]);

/* shadow.c */
/* R90: the share of light n that reaches a surface from direction l. */
float ref_light_reached(const e3d_frame *frame, int32_t n, const ref_surface *surface, const float l[3]);

/* exact_shadow.c */
/* R98-R102, R194, R196-R198: the share of a light that no caster hides. */
float ref_exact_share(const e3d_light *light, const ref_surface *surface, const float l[3]);

/* texture.c, R190: lod of R26 before it is limited, or 0 for a texture without levels or alpha */
int32_t ref_texture_alpha_lod(const e3d_texture_view *texture, const ref_surface *surface, const ref_coordinates *at);

/* texture.c, R29 and R30 for the fourth channel at level 0; returns the unit. */
float ref_texture_alpha(const e3d_texture_view *texture, const float uv[2], float *out);

/* physical.c */
void ref_light_physical(const e3d_frame *frame, const ref_surface *surface, float out[3]);
/* R134: the share of light from behind that the surface leaves, before absorption. */
void ref_light_behind(const ref_surface *surface, const float view[3], float out[3]);

/* R211: the share of a mirror's light that the surface reflects. */
void ref_mirror_share(const e3d_frame *frame, const ref_surface *surface, float out[3]);

/* mirror.c */
void ref_find_mirror(const e3d_frame *frame, const ref_place *at, ref_surface *surface);

/* iridescence.c */
/* R140, from F0 of the surface below; R141: the F0 that gives the same by Schlick's term. */
void ref_iridescence(float cosine, float ior, float thickness, const float f0[3], float out[3]);
void ref_iridescence_f0(float cosine, const float film[3], float out[3]);

/* anisotropy.c */
/* Finds any direction along the surface, if nothing defines one. */
void ref_any_direction(const float n[3], float out[3]);
/* R136; texel: NULL if there is no texture. */
void ref_find_stretch(const e3d_physical *material, const float texel[4], float unit, const ref_surface *s, ref_stretch *out);
/* R137 */
float ref_reflect_stretched(const ref_stretch *stretch, float alpha, const float view[3], float nv, const float l[3], float nl,
                            const float h[3], float square, float nh);
/* R138 */
void ref_bend_normal(const ref_stretch *stretch, const float normal[3], const float view[3], float roughness, float out[3]);

/* transmission.c */
/* R133: whether a piece lets light pass. */
int ref_transmits(const e3d_frame *frame, const ref_piece *piece);
float ref_transmitting_alpha(const e3d_material *material, float alpha);
/* R134 */
void ref_transmittance(const e3d_frame *frame, const ref_surface *surface, float out[3]);
/* R135: blends a fragment that transmits over a sample. */
void ref_lay_transmitting(const float color[3], float alpha, const float transmittance[3], float under[3], float *under_alpha);

/* How far fragments shift what is behind, in 1/256 pixel: [channel], across and down; and how much they blur it (R166). */
typedef struct ref_bend {
    uint32_t shift[3][2], blur;
    float depth; /* the least metric depth of one that does either */
} ref_bend;

/* refraction.c */
int ref_frame_bends(const e3d_frame *frame);
void ref_no_bend(ref_bend *out);
/* Adds what a fragment bends and blurs. */
void ref_add_bend(const e3d_frame *frame, const ref_surface *surface, const ref_place *at, ref_bend *sum);
/* Replaces what blending begins with, if anything is bent or blurred. */
void ref_begin_behind(const e3d_frame *frame, const ref_bend *sum, const ref_place *at, float color[3], float *alpha);
void ref_begin_radiance(const e3d_frame *frame, const ref_bend *sum, const ref_place *at, float radiance[3]);

/* tone.c */
void ref_map_tone(e3d_tone_mapping mapping, float color[3]);
void ref_add_fog(const e3d_fog *fog, float metric_depth, int is_lit, float color[3]);
/* R122: of a pixel. */
void ref_gradient(const e3d_frame *frame, int32_t x, int32_t y, float out[3]);

/* shade.c */
/* The colour before tone mapping, and the colour that shows. */
void ref_shade(const e3d_frame *frame, const ref_surface *surface, float out[3]);
void ref_show(const e3d_frame *frame, const ref_surface *surface, float out[3]);
