/* Random and hostile pictures in MuJoCo's manner: geoms of all types, planes, mirrors, transparent ones; lights with and without
 * shadows; textures, fog, haze, sky; positions, sizes and matrices that are no numbers or very large.
 */
#include "check/driver/scenes/mujoco_scene.h"

#include "check/driver/hostile.h"
#include "e3d_mujoco.h"

enum { SIDE = 40,
       PIXELS = SIDE * SIDE,
       GEOMS = 9,
       SHAPES = E3D_MUJ_BUILTINS + 6,
       VERTICES = 24,
       PIECES = 20,
       LINES = 5,
       PLANES = 3,
       TEXTURES = 3,
       TEXELS = 8 };

/* All that a frame points to; what one doesn't name stays as it was. */
typedef struct scene {
    e3d_muj_frame frame;
    e3d_muj_geom geoms[GEOMS];
    e3d_muj_light lights[E3D_MUJ_LIGHTS];
    e3d_muj_shape shapes[SHAPES];
    e3d_muj_plane planes[PLANES];
    e3d_muj_texture textures[TEXTURES];
    int32_t corners[3 * PIECES];
    float positions[3 * VERTICES], normals[9 * PIECES], uvs[6 * PIECES], meaning[256];
    double lines[LINES];
    uint8_t edges[PIECES], texels[6 * 4 * TEXELS * TEXELS], color[3 * PIXELS];
    int32_t geom[PIXELS];
    float depth[PIXELS];
} scene;

static float any_float(random_stream *r, float size, int hostile)
{
    float v = random_float(r, -size, size);
    return hostile && random_once_in(r, 30) ? hostile_extreme(r) : v;
}

static void fill(random_stream *r, float *out, size_t count, float size, int hostile)
{
    for (size_t i = 0; i < count; i++)
        out[i] = any_float(r, size, hostile);
}

static void fill_positive(random_stream *r, float *out, size_t count, float size)
{
    for (size_t i = 0; i < count; i++)
        out[i] = random_float(r, 0, size);
}

/* ---- the model ---- */

static void set_shapes(random_stream *r, scene *s, int hostile)
{
    fill(r, s->positions, 3 * VERTICES, 1.0f, hostile);
    fill(r, s->normals, 9 * PIECES, 1.0f, hostile);
    fill(r, s->uvs, 6 * PIECES, 1.0f, hostile);
    for (int i = 0; i < 3 * PIECES; i++)
        s->corners[i] = random_below(r, VERTICES);
    for (int i = 0; i < PIECES; i++)
        s->edges[i] = (uint8_t)random_below(r, 8);
    for (int i = 0; i < SHAPES; i++) {
        s->shapes[i] = (e3d_muj_shape){.vertices = VERTICES, .triangles = 1 + random_below(r, PIECES), .positions = s->positions};
        s->shapes[i].corners = s->corners;
        s->shapes[i].normals = s->normals;
        s->shapes[i].uvs = i < E3D_MUJ_BUILTINS || random_once_in(r, 2) ? s->uvs : NULL;
        s->shapes[i].edges = s->edges;
        for (int c = 0; c < 3; c++)
            s->shapes[i].low[c] = -1, s->shapes[i].high[c] = 1;
    }
}

static void set_planes(random_stream *r, scene *s)
{
    for (int i = 0; i < LINES; i++)
        s->lines[i] = i - 2 + (double)random_float(r, -0.4f, 0.4f);
    for (int i = 0; i < PLANES; i++)
        s->planes[i] = (e3d_muj_plane){{LINES - 1, LINES - 2}, {s->lines, s->lines}, {0.5, -0.5}, {0.5, 0.5}};
}

static void set_textures(random_stream *r, scene *s)
{
    for (size_t i = 0; i < sizeof s->texels; i++)
        s->texels[i] = (uint8_t)random_below(r, 256);
    fill_positive(r, s->meaning, 256, 1.0f);
    for (int i = 0; i < TEXTURES; i++) {
        e3d_muj_texture *texture = &s->textures[i];
        *texture = (e3d_muj_texture){.width = TEXELS, .height = TEXELS, .levels = random_below(r, 5)};
        texture->faces = random_once_in(r, 2) ? 1 : 6;
        texture->meaning = random_once_in(r, 2) ? s->meaning : NULL;
        for (int k = 0; k < 4; k++)
            texture->level[k] = s->texels;
    }
}

/* ---- the scene ---- */

static void set_geom(random_stream *r, e3d_muj_geom *geom, int hostile)
{
    static const int32_t TYPES[] = {E3D_MUJ_PLANE, E3D_MUJ_PLANE, E3D_MUJ_HFIELD, E3D_MUJ_SPHERE, E3D_MUJ_CAPSULE, E3D_MUJ_ELLIPSOID,
                                    E3D_MUJ_CYLINDER, E3D_MUJ_BOX, E3D_MUJ_MESH, E3D_MUJ_SDF, E3D_MUJ_ARROW, E3D_MUJ_ARROW1,
                                    E3D_MUJ_ARROW2, E3D_MUJ_LINE, E3D_MUJ_LINEBOX, E3D_MUJ_FLEX, E3D_MUJ_SKIN, E3D_MUJ_LABEL,
                                    E3D_MUJ_TRIANGLE};
    *geom = (e3d_muj_geom){.type = TYPES[random_below(r, sizeof TYPES / sizeof *TYPES)]};
    geom->dataid = hostile && random_once_in(r, 9) ? INT32_MAX : random_below(r, 4) - 1;
    geom->objid = hostile && random_once_in(r, 9) ? INT32_MIN : random_below(r, 4) - 1;
    geom->category = 1 << random_below(r, 3);
    geom->matid = random_below(r, 3) - 1;
    geom->texid = random_below(r, TEXTURES + 2) - 1;
    geom->texuniform = random_below(r, 2);
    geom->texcoord = random_below(r, 2);
    geom->segid = random_below(r, 9) - 1;
    geom->castshadow = random_below(r, 4) > 0;
    float most = random_once_in(r, 3) ? 0.06f : 1.0f; /* triangles smaller than a pixel, too */
    for (int c = 0; c < 3; c++)
        geom->size[c] = random_once_in(r, 6) ? 0 : random_float(r, 0.05f * most, most);
    fill(r, geom->pos, 3, 1.5f, hostile);
    fill(r, geom->mat, 9, 1.0f, hostile);
    fill_positive(r, geom->rgba, 4, 1.0f);
    if (random_once_in(r, 2))
        geom->rgba[3] = 1;
    geom->emission = random_float(r, 0, 0.5f);
    geom->specular = random_float(r, 0, 1);
    geom->shininess = any_float(r, 1, hostile);
    geom->reflectance = random_once_in(r, 2) ? random_float(r, 0, 1) : 0;
    fill(r, geom->texrepeat, 2, 4, hostile);
    geom->rbound = random_float(r, -1, 1);
}

static void set_light(random_stream *r, e3d_muj_light *light, int hostile)
{
    *light = (e3d_muj_light){.is_directional = random_below(r, 2), .casts_shadow = random_below(r, 2)};
    fill(r, light->pos, 3, 3.0f, hostile);
    fill(r, light->dir, 3, 1.0f, hostile);
    fill_positive(r, light->attenuation, 3, 1.0f);
    fill_positive(r, light->ambient, 3, 0.3f);
    fill_positive(r, light->diffuse, 3, 1.0f);
    fill_positive(r, light->specular, 3, 1.0f);
    light->exponent = random_float(r, 0, 12);
    light->cutoff_cosine = random_float(r, -2, 1);
    light->shadow_reach = random_float(r, 0, 3);
}

static void set_camera(random_stream *r, e3d_muj_frame *frame, int hostile)
{
    for (int c = 0; c < 3; c++) {
        frame->view[c][c] = c == 1 ? -1 : 1;
        frame->eye[c] = random_float(r, -1, 1);
    }
    frame->eye[2] -= 3;
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++)
            frame->view[k][c] += (double)any_float(r, 0.3f, hostile);
        frame->view[k][3] = -((frame->view[k][0] * frame->eye[0] + frame->view[k][1] * frame->eye[1]) + frame->view[k][2] * frame->eye[2]);
    }
    frame->near_plane = 0.05, frame->far_plane = 20;
    frame->is_orthographic = random_once_in(r, 4);
    frame->depth_scale = frame->near_plane / (frame->far_plane - frame->near_plane);
    frame->depth_offset = frame->depth_scale * frame->far_plane;
    frame->top = frame->right = frame->is_orthographic ? 2 : 0.04;
    frame->bottom = frame->left = -frame->top;
}

/* A size of shadow maps, just below 65 times a power of 2: their last texels lie beyond 64 parts of that size. */
static int32_t any_uneven_size(random_stream *r)
{
    int shift = random_below(r, 7);
    return (64 << shift) + (1 << shift) - 1;
}

static void set_frame(random_stream *r, scene *s, int hostile)
{
    e3d_muj_frame *frame = &s->frame;
    *frame = (e3d_muj_frame){.shapes = s->shapes, .shape_count = SHAPES, .planes = s->planes, .plane_count = PLANES};
    frame->textures = s->textures, frame->texture_count = TEXTURES;
    frame->geoms = s->geoms, frame->geom_count = random_below(r, GEOMS + 1);
    frame->lights = s->lights, frame->light_count = random_below(r, E3D_MUJ_LIGHTS + 1);
    frame->first_mesh = E3D_MUJ_BUILTINS, frame->first_hfield = E3D_MUJ_BUILTINS + 2;
    frame->first_skin = E3D_MUJ_BUILTINS + 3, frame->first_flex = E3D_MUJ_BUILTINS + 4;
    frame->width = 1 + random_below(r, SIDE);
    frame->height = 1 + random_below(r, SIDE);
    frame->is_segmented = random_once_in(r, 3);
    frame->samples = frame->is_segmented || random_once_in(r, 2) ? 1 : E3D_MUJ_SAMPLES;
    frame->is_wireframe = random_once_in(r, 5);
    frame->culls_backs = random_below(r, 2);
    frame->reflects = random_below(r, 3) > 0;
    frame->shadows = random_below(r, 3) > 0;
    frame->is_additive = random_once_in(r, 4);
    frame->has_fog = random_once_in(r, 3);
    frame->has_haze = random_below(r, 2);
    frame->builtin_uvs = random_below(r, 2);
    frame->sky = random_below(r, TEXTURES + 1) - 1;
    frame->shadow_size = random_once_in(r, 2) ? any_uneven_size(r) : random_below(r, 300);
    frame->ambient = random_float(r, 0, 0.3f);
    frame->fog_start = any_float(r, 3, hostile), frame->fog_end = any_float(r, 9, hostile);
    frame->line_width = random_float(r, 0, 4);
    fill_positive(r, frame->fog, 3, 1.0f);
    fill_positive(r, frame->haze, 3, 1.0f);
    set_camera(r, frame, hostile);
    frame->color = frame->is_segmented ? NULL : s->color;
    frame->geom = s->geom, frame->depth = s->depth;
}

static void set_scene(random_stream *r, scene *s)
{
    int hostile = random_once_in(r, 2);
    set_shapes(r, s, hostile);
    set_planes(r, s);
    set_textures(r, s);
    set_frame(r, s, hostile);
    for (int i = 0; i < GEOMS; i++)
        set_geom(r, &s->geoms[i], hostile);
    for (int i = 0; i < E3D_MUJ_LIGHTS; i++)
        set_light(r, &s->lights[i], hostile);
}

/* The hash of the picture, whose bytes are all written; 0 where it fails. */
static uint64_t draw(scene *s, int32_t threads, e3d_muj_memory *memory)
{
    const e3d_muj_frame *frame = &s->frame;
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    memset(s->color, 0x5A + threads, sizeof s->color);
    memset(s->geom, 0x5A + threads, sizeof s->geom);
    memset(s->depth, 0x5A + threads, sizeof s->depth);
    if (e3d_muj_render(frame, threads, memory) != E3D_OK)
        return 0;
    if (frame->color)
        return hash_bytes(HASH_START, s->color, 3 * pixels);
    uint64_t hash = hash_bytes(HASH_START, (const uint8_t *)s->depth, pixels * sizeof *s->depth);
    return hash_bytes(hash, (const uint8_t *)s->geom, pixels * sizeof *s->geom);
}

/* What is drawn, with the memory that its pictures share. */
typedef struct drawing {
    scene *scene;
    e3d_muj_memory *memory;
} drawing;

static uint64_t hash_drawn(const void *input, e3d_backend backend, int32_t threads)
{
    const drawing *drawn = input;
    drawn->scene->frame.backend = backend;
    return drawn->memory ? draw(drawn->scene, threads, drawn->memory) : 0;
}

outcome compare_mujoco(random_stream r, const run_plan *plan, const char *title)
{
    static scene s;
    const drawing drawn = {&s, e3d_muj_memory_new()};
    set_scene(&r, &s);
    outcome result = compare_hashes(hash_drawn, &drawn, plan, title);
    e3d_muj_memory_free(drawn.memory);
    return result;
}
