/* Lists of triangles as a user interface makes them, and as it never would: the same ones on every backend.
 *
 * Most are rectangles, of texels a pixel or stretched; positions, uvs, indices and scissors are now and then anything. Rows are wider
 * than the picture, and what lies beside it must stay as it was. Textures are memory of their own size, whose ends sanitizers know.
 */
#include "check/driver/scenes/ui_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "e3d_ui.h"

enum {
    SIDE = 128,
    BESIDE = 3,
    STRIDE = 4 * (SIDE + BESIDE),
    PICTURE_BYTES = SIDE * STRIDE,
    VERTICES = 48,
    INDICES = 3 * 24,
    COMMANDS = 4,
    TEXTURES = 3,
    UNTOUCHED = 0x5A
};

typedef struct ui_scene {
    e3d_ui_vertex vertices[VERTICES];
    uint32_t indices[INDICES];
    uint16_t narrow[INDICES];
    e3d_ui_command commands[COMMANDS];
    e3d_ui_texture textures[TEXTURES];
    uint8_t *texels[TEXTURES];
    e3d_ui_list list;
    int32_t width, height;
} ui_scene;

static float hostile(random_stream *r)
{
    static const float NUMBERS[] = {0.0f, -0.0f, 1e-38f, 1048576.0f, -3e6f, 1e30f, -1e30f, INFINITY, -INFINITY, NAN};
    return NUMBERS[random_below(r, sizeof NUMBERS / sizeof *NUMBERS)];
}

static float coordinate(random_stream *r, int whole)
{
    float value = random_float(r, -20.0f, SIDE + 20.0f);
    if (random_once_in(r, 60))
        return hostile(r);
    return whole ? (float)(int32_t)value : value;
}

static float texture_coordinate(random_stream *r)
{
    if (random_once_in(r, 60))
        return hostile(r);
    return random_once_in(r, 2) ? (float)random_below(r, 17) / 16.0f : random_float(r, -0.5f, 1.5f);
}

static void random_vertex(random_stream *r, e3d_ui_vertex *vertex, int whole)
{
    vertex->x = coordinate(r, whole);
    vertex->y = coordinate(r, whole);
    vertex->u = texture_coordinate(r);
    vertex->v = texture_coordinate(r);
    uint32_t color = (uint32_t)random_bits(r);
    /* Pictures are shown under white. */
    color = color % 4 == 0 ? UINT32_MAX : color;
    memcpy(vertex->rgba, &color, 4);
    if (random_once_in(r, 2))
        vertex->rgba[3] = random_once_in(r, 2) ? 255 : 0;
}

/* Makes four vertices a rectangle; with `texels`, of one texel a pixel of a texture of that size. */
static void make_rectangle(e3d_ui_vertex corner[4], const e3d_ui_texture *texels)
{
    e3d_ui_vertex *a = &corner[0], *c = &corner[2];
    if (texels) {
        c->u = a->u + (c->x - a->x) / (float)texels->width;
        c->v = a->v + (c->y - a->y) / (float)texels->height;
    }
    memcpy(c->rgba, a->rgba, 4);
    corner[1] = corner[3] = *a;
    corner[1].x = c->x, corner[1].u = c->u;
    corner[3].y = c->y, corner[3].v = c->v;
}

static void random_vertices(random_stream *r, ui_scene *scene)
{
    for (int i = 0; i < VERTICES; i += 4) {
        int whole = random_below(r, 2);
        for (int k = 0; k < 4; k++)
            random_vertex(r, &scene->vertices[i + k], whole);
        if (!random_once_in(r, 3))
            make_rectangle(&scene->vertices[i], random_once_in(r, 2) ? &scene->textures[random_below(r, TEXTURES)] : NULL);
        for (int k = 1; k < 4 && random_once_in(r, 2); k++)
            scene->vertices[i + k].u = scene->vertices[i].u, scene->vertices[i + k].v = scene->vertices[i].v;
    }
}

static void random_indices(random_stream *r, ui_scene *scene)
{
    static const uint32_t QUAD[6] = {0, 1, 2, 0, 2, 3};
    for (int i = 0; i < INDICES; i += 6) {
        uint32_t first = 4 * (uint32_t)random_below(r, VERTICES / 4);
        for (int k = 0; k < 6; k++)
            scene->indices[i + k] = random_once_in(r, 20) ? (uint32_t)random_below(r, VERTICES) : first + QUAD[k];
    }
    if (random_once_in(r, 20))
        scene->indices[random_below(r, INDICES)] = (uint32_t)random_bits(r);
    for (int i = 0; i < INDICES; i++)
        scene->narrow[i] = (uint16_t)scene->indices[i];
}

static void random_commands(random_stream *r, ui_scene *scene)
{
    for (int k = 0; k < COMMANDS; k++) {
        e3d_ui_command *c = &scene->commands[k];
        int all = random_once_in(r, 2);
        c->left = all ? INT32_MIN : random_below(r, SIDE) - 4;
        c->top = all ? INT32_MIN : random_below(r, SIDE) - 4;
        c->right = all ? INT32_MAX : c->left + random_below(r, SIDE);
        c->bottom = all ? INT32_MAX : c->top + random_below(r, SIDE);
        c->first_index = 3 * (uint32_t)(k * (INDICES / 3) / COMMANDS);
        c->index_count = INDICES / COMMANDS;
        c->first_vertex = random_once_in(r, 30) ? (uint32_t)random_below(r, 3) : 0;
        c->texture = (uint32_t)random_below(r, TEXTURES);
    }
}

static void random_texture(random_stream *r, e3d_ui_texture *texture, uint8_t **texels)
{
    e3d_ui_format format = (e3d_ui_format)random_below(r, 3);
    e3d_ui_filter filter = (e3d_ui_filter)random_below(r, 2);
    int32_t width = 1 + random_below(r, 24), height = 1 + random_below(r, 24);
    int32_t stride = (format == E3D_UI_A8 ? 1 : 4) * (width + random_below(r, 2));
    size_t size = (size_t)stride * (size_t)height;
    *texels = malloc(size);
    for (size_t k = 0; *texels && k < size; k++)
        (*texels)[k] = (uint8_t)(random_once_in(r, 3) ? 255 : random_bits(r));
    *texture = (e3d_ui_texture){*texels, width, height, stride, format, filter};
}

static void random_scene(random_stream *r, ui_scene *scene)
{
    scene->width = random_below(r, SIDE + 1);
    scene->height = random_below(r, SIDE + 1);
    for (int k = 0; k < TEXTURES; k++)
        random_texture(r, &scene->textures[k], &scene->texels[k]);
    random_vertices(r, scene);
    random_indices(r, scene);
    random_commands(r, scene);
    int narrow = random_below(r, 2);
    scene->list = (e3d_ui_list){scene->vertices, narrow ? (const void *)scene->narrow : scene->indices, scene->commands,
                                scene->textures, VERTICES, INDICES, COMMANDS, TEXTURES, narrow ? 2 : 4};
}

/* What is beside the picture, and, of a list that is refused, the picture too. */
static int is_untouched(const ui_scene *scene, const uint8_t *pixels, const uint8_t *before, e3d_status status)
{
    int32_t width = status == E3D_OK ? scene->width : 0;
    for (int32_t row = 0; row < SIDE; row++) {
        size_t from = (size_t)row * STRIDE + (row < scene->height ? 4 * (size_t)width : 0);
        if (memcmp(pixels + from, before + from, (size_t)(row + 1) * STRIDE - from) != 0)
            return 0;
    }
    return 1;
}

outcome compare_ui(random_stream r, const run_plan *plan, const char *title)
{
    static uint8_t pixels[PICTURE_BYTES], before[PICTURE_BYTES];
    static ui_scene scene;
    random_scene(&r, &scene);
    memset(before, UNTOUCHED, sizeof before);
    for (int32_t row = 0; row < scene.height; row++)
        for (int32_t k = 0; k < 4 * scene.width; k++)
            before[row * STRIDE + k] = (uint8_t)random_bits(&r);
    outcome result = {.agrees = 1};
    int runs = 0;
    for (int k = 0; k < E3D_BACKEND_COUNT; k++) {
        if (!plan->backends[k])
            continue;
        memcpy(pixels, before, sizeof pixels);
        const e3d_canvas picture = {pixels, scene.width, scene.height, STRIDE};
        e3d_status status = e3d_ui_draw((e3d_backend)k, &picture, &scene.list);
        uint64_t hash = hash_bytes(HASH_START, pixels, sizeof pixels);
        int agrees = (runs == 0 || (hash == result.hash && status == result.status)) && is_untouched(&scene, pixels, before, status);
        if (!agrees && title != NULL)
            fprintf(stderr, "%s: %s differs, or touches what it may not\n", title, e3d_backend_name((e3d_backend)k));
        result.hash = runs++ == 0 ? hash : result.hash;
        result.status = status;
        result.agrees &= agrees;
    }
    for (int k = 0; k < TEXTURES; k++)
        free(scene.texels[k]);
    return result;
}
