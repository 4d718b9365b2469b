/* What is seen at one sample, and the stages that find it: surface, texture, maps, environment, light, shade. */
#ifndef E3D_REFERENCE_SURFACE_H
#define E3D_REFERENCE_SURFACE_H

#include "reference/arithmetic.h"
#include "reference/stages.h"

/* Where a texture is read: a set of coordinates, moved (R45). */
typedef struct ref_coordinates {
    float uv[2], corner[2][3]; /* [coordinate][vertex] */
} ref_coordinates;

/* What a physically based material is made of at one sample (R46). */
typedef struct ref_physical {
    float metallic, roughness, occlusion;
    float specular, reflectance[3]; /* F90 and F0 of what is no metal */
    float coat, coat_roughness, coat_normal[3];
    float sheen[3], sheen_roughness;
} ref_physical;

/* What is seen at one sample. */
typedef struct ref_surface {
    const ref_piece *piece;
    const ref_instance *instance;
    float dx, dy, weight[3], r; /* of R19 */
    float barycentric[3];
    float world_position[3], view_position[3];
    float metric_depth;
    float corner_position[3][3];                 /* [vertex], in world space */
    float shading_normal[3];                     /* before it is mapped */
    float world_normal[3], view_normal[3];
    float tangent[4], view_tangent[4]; /* R47; all 0 where there is none */
    float uv[2];                                 /* of set 0 */
    float albedo[3], alpha; /* alpha: R80 */
    float emissive[3];
    ref_physical physical; /* of faces whose material is */
    float visibility;      /* R129: of light from all around */
} ref_surface;

/* R20: of three values. */
static inline float ref_interpolate(const ref_surface *surface, const float corners[3])
{
    return ref_dot3(surface->weight, corners) * surface->r;
}

/* surface.c */
void ref_surface_at(const ref_scene *scene, const ref_piece *piece, int32_t x, int32_t y, ref_surface *out);
void ref_decode_color(const e3d_frame *frame, const uint8_t color[4], float out[4]);

/* texture.c */
/* Returns the unit. */
float ref_texture_sample(const e3d_texture_view *texture, const ref_surface *surface, const ref_coordinates *at, float out[4]);

/* maps.c */
int ref_slot_counts(const e3d_texture_use *use, const ref_surface *surface);
void ref_slot_coordinates(const e3d_texture_use *use, const ref_surface *surface, ref_coordinates *out);
float ref_slot_sample(const e3d_texture_use *use, const ref_surface *surface, float out[4]);
void ref_find_maps(const ref_scene *scene, ref_surface *surface);

/* environment.c */
void ref_environment(const e3d_environment_light *light, const float direction[3], float level, float out[3]);
void ref_environment_specular(const e3d_environment_light *light, const float direction[3], float roughness, float out[3]);
void ref_environment_irradiance(const e3d_environment_light *light, const float normal[3], float out[3]); /* over pi */
void ref_backdrop(const e3d_backdrop *backdrop, int32_t x, int32_t y, float out[3]);
float ref_albedo(e3d_dfg kind, float roughness, float cosine);

/* light.c */
/* R130: what white surfaces of that normal show of light from all around. */
void ref_ambient(const e3d_frame *frame, const float normal[3], float out[3]);
/* The unit vector from p towards the light, and its attenuation, in the way of R51 if by_product; returns 0 where the light is out of
 * range. */
int ref_light_reach(const e3d_light *light, const float p[3], int by_product, float l[3], float *attenuation);
void ref_light(const e3d_frame *frame, const ref_surface *surface, float out[3]);
void ref_direction_to_eye(const e3d_frame *frame, const ref_surface *surface, float out[3]);

/* physical.c */
void ref_light_physical(const e3d_frame *frame, const ref_surface *surface, float out[3]);

/* shade.c */
void ref_shade(const e3d_frame *frame, const ref_surface *surface, float out[3]);

#endif
