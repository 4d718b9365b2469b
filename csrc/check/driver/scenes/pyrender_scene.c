/* Random and hostile pictures in pyrender's manner: triangles of which it is said what shows, others, lines and points that are drawn one by
 * one; textures, lights, maps of shadows; positions, coordinates and matrices that are no numbers or very large.
 */
#include "check/driver/scenes/pyrender_scene.h"

#include <math.h>

#include "check/driver/hostile.h"
#include "e3d_pyrender.h"

enum { SIDE = 40,
       PIXELS = SIDE * SIDE,
       DRAWS = 5,
       VERTICES = 24,
       PIECES = 20,
       LIGHTS = 4,
       MAP = 6,
       TEXELS = 8 };

/* All that a frame points to; what one doesn't name stays as it was. */
typedef struct scene {
    e3d_pyr_frame frame;
    e3d_pyr_draw draws[DRAWS];
    e3d_pyr_light lights[LIGHTS];
    e3d_pyr_texture texture;
    e3d_pyr_step steps[2];
    int32_t indices[3 * PIECES], light_numbers[LIGHTS], draw_of_object[DRAWS];
    float positions[3 * VERTICES], normals[3 * VERTICES], uvs[2 * VERTICES], colors[4 * VERTICES], map[MAP * MAP];
    uint8_t texels[4][4 * TEXELS * TEXELS], calm[DRAWS][PIECES];
    int32_t object[E3D_PYR_PLACES][PIXELS], triangle[E3D_PYR_PLACES][PIXELS];
    uint8_t color[4 * PIXELS];
    float depth[PIXELS];
} scene;

static void fill_matrix(random_stream *r, double out[16], float size, int hostile)
{
    for (int k = 0; k < 16; k++) {
        out[k] = (double)random_float(r, -size, size) + (k % 5 == 0);
        if (hostile && random_once_in(r, 100))
            out[k] = (double)hostile_extreme(r);
    }
}

static void set_texture(random_stream *r, scene *s)
{
    e3d_pyr_texture *texture = &s->texture;
    *texture = (e3d_pyr_texture){.width = TEXELS, .height = TEXELS, .levels = 1 + random_below(r, 4)};
    texture->channels = 1 + random_below(r, 4);
    for (int k = 0; k < 4; k++)
        texture->level[k] = s->texels[k];
    for (size_t i = 0; i < sizeof s->texels; i++)
        s->texels[i / sizeof *s->texels][i % sizeof *s->texels] = (uint8_t)random_below(r, 256);
    texture->wrap[0] = random_below(r, 3);
    texture->wrap[1] = random_below(r, 3);
    texture->linear_near = random_below(r, 2);
    texture->linear_far = random_below(r, 2);
    texture->blends_levels = random_below(r, 2);
}

static void set_draw(random_stream *r, scene *s, int number, int is_visible, int hostile)
{
    e3d_pyr_draw *draw = &s->draws[number];
    *draw = (e3d_pyr_draw){.count = PIECES, .vertices = VERTICES, .indices = s->indices, .positions = s->positions};
    draw->mode = is_visible ? E3D_PYR_TRIANGLES : random_below(r, 3);
    draw->normals = random_once_in(r, 3) ? NULL : s->normals;
    draw->uvs = random_once_in(r, 2) ? NULL : s->uvs;
    draw->colors = random_once_in(r, 2) ? NULL : s->colors;
    fill_matrix(r, draw->world, 0.5f, hostile);
    draw->culls_backs = random_below(r, 2);
    draw->is_wireframe = !is_visible && random_once_in(r, 3);
    draw->blends = !is_visible && random_once_in(r, 2);
    hostile_fill(r, draw->color, 4, 1.0f, hostile);
    draw->metallic = random_float(r, 0.0f, 1.0f);
    draw->roughness = random_float(r, 0.0f, 1.0f);
    hostile_fill(r, draw->emissive, 3, 0.5f, hostile);
    for (int k = 0; k < E3D_PYR_SLOTS; k++)
        draw->textures[k] = draw->uvs && random_once_in(r, 2) ? &s->texture : NULL;
    draw->first_light = random_below(r, LIGHTS);
    draw->light_count = random_below(r, LIGHTS + 1 - draw->first_light);
    if (draw->mode == E3D_PYR_TRIANGLES) {
        e3d_pyr_find_calm(draw, s->calm[number]);
        draw->calm = s->calm[number];
    }
}

static void set_light(random_stream *r, scene *s, int number, int hostile)
{
    e3d_pyr_light *light = &s->lights[number];
    *light = (e3d_pyr_light){.kind = random_below(r, 3), .cone_scale = 3.0f, .cone_offset = -1.5f};
    hostile_fill(r, light->color, 3, 3.0f, hostile);
    hostile_fill(r, light->position, 3, 3.0f, hostile);
    hostile_fill(r, light->direction, 3, 1.0f, hostile);
    fill_matrix(r, light->shadow_from_world, 0.5f, hostile);
    light->shadow_map = light->kind != E3D_PYR_POINT && random_once_in(r, 2) ? s->map : NULL;
    light->shadow_size = MAP;
    s->light_numbers[number] = random_below(r, LIGHTS);
}

/* A step of the first draws, of which it is said what shows, then one of the others. */
static void set_steps(random_stream *r, scene *s, int visible)
{
    int32_t size = s->frame.width * s->frame.height;
    s->frame.step_count = 0;
    if (visible > 0) {
        e3d_pyr_step *step = &s->steps[s->frame.step_count++];
        *step = (e3d_pyr_step){.draw_of_object = s->draw_of_object};
        for (int p = 0; p < E3D_PYR_PLACES; p++) {
            step->object_id[p] = s->object[p];
            step->face_id[p] = s->triangle[p];
            for (int32_t i = 0; i < size; i++) {
                int again = i > 0 && !random_once_in(r, 4);
                s->object[p][i] = again ? s->object[p][i - 1] : random_below(r, visible);
                s->triangle[p][i] = again ? s->triangle[p][i - 1] : random_below(r, PIECES + 1) - 1;
            }
        }
    }
    if (visible < DRAWS)
        s->steps[s->frame.step_count++] = (e3d_pyr_step){.first_draw = visible, .draw_count = DRAWS - visible};
}

static void set_frame(random_stream *r, scene *s, int hostile)
{
    e3d_pyr_frame *frame = &s->frame;
    *frame = (e3d_pyr_frame){.draws = s->draws, .draw_count = DRAWS, .lights = s->lights, .light_numbers = s->light_numbers, .steps = s->steps};
    frame->width = 1 + random_below(r, SIDE);
    frame->height = 1 + random_below(r, SIDE);
    frame->samples = random_once_in(r, 2) ? 1 : E3D_PYR_SAMPLES;
    frame->shading = random_below(r, 4);
    fill_matrix(r, frame->clip_from_world, 0.5f, hostile);
    frame->clip_from_world[15] = 3.0;
    hostile_fill(r, frame->eye, 3, 3.0f, hostile);
    hostile_fill(r, frame->ambient, 3, 1.0f, hostile);
    hostile_fill(r, frame->background, 4, 1.0f, hostile);
    frame->point_size = random_float(r, 0.0f, 9.0f);
    frame->depth_near = 0.1;
    frame->depth_far = random_once_in(r, 2) ? (double)INFINITY : 10.0;
    frame->depth_place = random_below(r, E3D_PYR_PLACES);
    frame->depth_is_straight = random_once_in(r, 3);
    frame->color = frame->shading == E3D_PYR_DEPTH ? NULL : s->color;
    frame->channels = 3 + random_below(r, 2);
    frame->depth = s->depth;
}

static void set_scene(random_stream *r, scene *s)
{
    int hostile = random_once_in(r, 2), visible = random_below(r, DRAWS + 1);
    hostile_fill(r, s->positions, 3 * VERTICES, 2.0f, hostile);
    hostile_fill(r, s->normals, 3 * VERTICES, 1.0f, hostile);
    hostile_fill(r, s->uvs, 2 * VERTICES, 3.0f, hostile);
    hostile_fill(r, s->colors, 4 * VERTICES, 1.0f, hostile);
    hostile_fill(r, s->map, MAP * MAP, 1.0f, hostile);
    for (int i = 0; i < 3 * PIECES; i++)
        s->indices[i] = random_below(r, VERTICES);
    set_texture(r, s);
    set_frame(r, s, hostile);
    for (int k = 0; k < LIGHTS; k++)
        set_light(r, s, k, hostile);
    for (int k = 0; k < DRAWS; k++) {
        set_draw(r, s, k, k < visible, hostile);
        s->draw_of_object[k] = k;
    }
    set_steps(r, s, visible);
}

/* The hash of the picture, whose bytes are all written; 0 where it fails. */
static uint64_t draw(scene *s, int32_t threads, e3d_pyr_memory *memory)
{
    const e3d_pyr_frame *frame = &s->frame;
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    memset(s->color, 0x5A + threads, sizeof s->color);
    memset(s->depth, 0x5A + threads, sizeof s->depth);
    if (e3d_pyr_render(frame, threads, memory) != E3D_OK)
        return 0;
    uint64_t hash = hash_bytes(HASH_START, (const uint8_t *)s->depth, pixels * sizeof *s->depth);
    return frame->color ? hash_bytes(hash, s->color, pixels * (size_t)frame->channels) : hash;
}

/* What is drawn, with the memory that its pictures share. */
typedef struct drawing {
    scene *scene;
    e3d_pyr_memory *memory;
} drawing;

static uint64_t hash_drawn(const void *input, e3d_backend backend, int32_t threads)
{
    const drawing *drawn = input;
    (void)backend; /* no instruction set is chosen */
    return drawn->memory ? draw(drawn->scene, threads, drawn->memory) : 0;
}

outcome compare_pyrender(random_stream r, const run_plan *plan, const char *title)
{
    static scene s;
    const drawing drawn = {&s, e3d_pyr_memory_new()};
    set_scene(&r, &s);
    outcome result = compare_thread_counts(hash_drawn, &drawn, plan, title);
    e3d_pyr_memory_free(drawn.memory);
    return result;
}
