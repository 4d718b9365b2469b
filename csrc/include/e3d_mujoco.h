/* Pictures as MuJoCo's classic renderer draws them (docs/exactness, section 29).
 * In: the geoms, lights and camera of a scene, and the shapes and textures of its model.
 * Out: colours, or which geom shows and its depth.
 * Always: the same bytes for any backend and number of threads, since no pixel depends on what is written for another. */
#pragma once

#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { E3D_MUJ_LEVELS = 16,
       E3D_MUJ_SAMPLES = 4, /* a pixel has this many samples, or one */
       E3D_MUJ_LIGHTS = 8 /* lights after these do nothing */ };

/* The types of geoms, with MuJoCo's numbers. */
typedef enum e3d_muj_type { E3D_MUJ_PLANE = 0,
                            E3D_MUJ_HFIELD,
                            E3D_MUJ_SPHERE,
                            E3D_MUJ_CAPSULE,
                            E3D_MUJ_ELLIPSOID,
                            E3D_MUJ_CYLINDER,
                            E3D_MUJ_BOX,
                            E3D_MUJ_MESH,
                            E3D_MUJ_SDF,
                            E3D_MUJ_ARROW = 100,
                            E3D_MUJ_ARROW1,
                            E3D_MUJ_ARROW2,
                            E3D_MUJ_LINE,
                            E3D_MUJ_LINEBOX,
                            E3D_MUJ_FLEX,
                            E3D_MUJ_SKIN,
                            E3D_MUJ_LABEL,
                            E3D_MUJ_TRIANGLE } e3d_muj_type;

/* The shapes that every model has, by their numbers in e3d_muj_frame.shapes. */
typedef enum e3d_muj_builtin { E3D_MUJ_UNIT_SPHERE = 0,
                               E3D_MUJ_CAP_TOP,
                               E3D_MUJ_CAP_BOTTOM,
                               E3D_MUJ_UNIT_CYLINDER,
                               E3D_MUJ_OPEN_CYLINDER,
                               E3D_MUJ_CONE,
                               E3D_MUJ_UNIT_BOX,
                               E3D_MUJ_UNIT_TRIANGLE,
                               E3D_MUJ_HAZE,
                               /* The same without inner lines, which matter to light only */
                               E3D_MUJ_PLAIN_CYLINDER,
                               E3D_MUJ_PLAIN_OPEN_CYLINDER,
                               E3D_MUJ_PLAIN_CONE,
                               E3D_MUJ_PLAIN_BOX,
                               E3D_MUJ_BUILTINS } e3d_muj_builtin;

/* Texels of four 8-bit channels; level k is max(1, size >> k) texels a side, (faces, height, width, 4). */
typedef struct e3d_muj_texture {
    const uint8_t *level[E3D_MUJ_LEVELS];
    const float *meaning;                  /* (256,): the value of a code in the first three channels; NULL: code/255 */
    int32_t width, height, levels;
    int32_t faces;                         /* 1: a picture that repeats; 6: a cube, +x -x +y -y +z -z */
} e3d_muj_texture;

/* Triangles. Corners are in range. */
typedef struct e3d_muj_shape {
    int32_t vertices, triangles;
    const float *positions;                /* (vertices, 3) */
    const int32_t *corners;                /* (triangles, 3) */
    const float *normals;                  /* (triangles, 3, 3) */
    const float *uvs;                      /* (triangles, 3, 2), or NULL; of the haze: its alpha, and 0 */
    const uint8_t *edges;                  /* (triangles,): bit k is set if wireframes show the edge from corner k to the next */
    float low[3], high[3];                 /* the box of the positions */
} e3d_muj_shape;

/* A plane's grid of cells; its texture's coordinates are position*scale + offset. */
typedef struct e3d_muj_plane {
    int32_t cells[2];
    const double *lines[2];                /* (cells + 1,), ascending */
    double scale[2], offset[2];
} e3d_muj_plane;

/* A geom of the scene, with the meaning that mjvGeom gives to the names; a flex's objid is the number of its pair of shapes:
 * vertices and edges, and faces. */
typedef struct e3d_muj_geom {
    int32_t type, dataid, objid, category, matid, texid, texuniform, texcoord, segid, castshadow;
    float size[3], pos[3], mat[9], rgba[4], emission, specular, shininess, reflectance, texrepeat[2];
    float rbound;                          /* the radius of a sphere around it; negative: by its size */
} e3d_muj_geom;

/* A light that is directional or a spot. */
typedef struct e3d_muj_light {
    int32_t is_directional, casts_shadow;
    float pos[3], dir[3], attenuation[3], ambient[3], diffuse[3], specular[3], exponent;
    float cutoff_cosine;
    double shadow_reach;                   /* half the side of the map: in metres, or, of a spot, at the distance 1 */
} e3d_muj_light;

typedef struct e3d_muj_frame {
    e3d_backend backend;                   /* one that is available */
    int32_t width, height, samples;
    int32_t is_segmented;                  /* draws all geoms with a segid, the sky and the haze, each alike, at the centres of the pixels */
    int32_t is_wireframe, culls_backs, reflects, shadows, is_additive, has_fog;
    /* Rows of eye_from_world: to the right, up, ahead; the eye in the world; and the camera's frustum at the near plane */
    double view[3][4];
    double eye[3], left, right, bottom, top, near_plane, far_plane;
    double depth_scale, depth_offset;      /* of perspectives: the depth is offset/distance - scale */
    int32_t is_orthographic;
    float ambient, fog_start, fog_end, fog[3], haze[3], line_width;
    int32_t has_haze, sky;                 /* sky: the number of its texture, or -1 */
    int32_t shadow_size;
    int32_t builtin_uvs;                   /* as of MuJoCo 3.12: builtin shapes have coordinates of textures, and textures repeat by them */
    const e3d_muj_shape *shapes;
    int32_t shape_count, first_mesh, first_hfield, first_skin, first_flex;
    const e3d_muj_plane *planes;           /* the first is that of planes which belong to no model */
    int32_t plane_count;
    const e3d_muj_texture *textures;
    int32_t texture_count;
    const e3d_muj_geom *geoms;
    int32_t geom_count;
    const e3d_muj_light *lights;
    int32_t light_count;
    uint8_t *color;                        /* (height, width, 3), or NULL if is_segmented */
    int32_t *geom;                         /* if is_segmented: (height, width), the geom's number, or -1 */
    float *depth;                          /* if is_segmented: (height, width), 1 at the near plane, 0 at the far plane or where
                                              nothing is; or NULL */
} e3d_muj_frame;

/* Finds the next level of a texture, (faces, max(1, height / 2), max(1, width / 2), 4). meaning: the values of the codes of the
 * first three channels; limits: the values halfway between them. */
void e3d_muj_halve(const uint8_t *texels, int32_t faces, int32_t height, int32_t width, const double meaning[256], const double limits[255],
                   uint8_t *to);

/* Memory that pictures use again. e3d_muj_memory_new returns NULL when memory is out. */
typedef struct e3d_muj_memory e3d_muj_memory;
e3d_muj_memory *e3d_muj_memory_new(void);
void e3d_muj_memory_free(e3d_muj_memory *memory);

/* Draws on up to `threads` threads (0: all). A memory serves one picture at a time. */
e3d_status e3d_muj_render(const e3d_muj_frame *frame, int32_t threads, e3d_muj_memory *memory);

#ifdef __cplusplus
}
#endif
