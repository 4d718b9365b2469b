/* Times whole frames with the kernels of one instruction set; compiler_flags.py builds it once for each set of flags.
 *
 * In:  -DE3D_TABLE=the table of kernels, -DE3D_TIMED=its backend. It stands in for csrc/kernels/dispatch.c, which would want the
 *      tables of all backends.
 * Out: a line "frame 1 seconds hash": the fastest of the repetitions, with one thread, and a hash of the colours. Exit status 3
 *      where the CPU lacks the instructions.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "check/driver/random.h"
#include "kernels/kernels.h"

enum { SIDE = 129, VERTICES = SIDE * SIDE, CELLS = (SIDE - 1) * (SIDE - 1), WIDTH = 640, HEIGHT = 360, TEXELS = 256, REPETITIONS = 15 };

const e3d_kernels *e3d_kernels_for(e3d_backend backend) { return backend == E3D_TIMED ? &E3D_TABLE : NULL; }

static float positions[3 * VERTICES], normals[3 * VERTICES], uvs[2 * VERTICES];
static int32_t faces[6 * CELLS];
static uint8_t texels[4 * TEXELS * TEXELS], color[4 * WIDTH * HEIGHT];

/* Hills under a texture that repeats. */
static e3d_status make_mesh(e3d_mesh **out)
{
    for (int i = 0; i < VERTICES; i++) {
        float x = (float)(i % SIDE) / (SIDE - 1) * 2.0f - 1.0f, y = (float)(i / SIDE) / (SIDE - 1) * 2.0f - 1.0f;
        const float vertex[3] = {x, y, 0.3f * (x * x - y * y) * (1.0f - y)}, up[3] = {-0.6f * x, 0.6f * y, 1.0f};
        for (int k = 0; k < 3; k++) {
            positions[3 * i + k] = vertex[k];
            normals[3 * i + k] = up[k];
        }
        uvs[2 * i] = 3.0f * x;
        uvs[2 * i + 1] = 3.0f * y;
    }
    for (int c = 0; c < CELLS; c++) {
        int at = c / (SIDE - 1) * SIDE + c % (SIDE - 1);
        const int32_t cell[6] = {at, at + 1, at + SIDE + 1, at, at + SIDE + 1, at + SIDE};
        for (int k = 0; k < 6; k++)
            faces[6 * c + k] = cell[k];
    }
    const e3d_mesh_desc desc = {.positions = positions, .components = 3, .vertices = VERTICES, .faces = faces,
                                .faces_count = 2 * CELLS, .normals = normals, .uvs = uvs};
    return e3d_mesh_create(&desc, 1, out);
}

static e3d_status make_texture(e3d_texture **out)
{
    static const e3d_sampling sampling = {.filter = E3D_TRILINEAR, .wrap = {E3D_REPEAT, E3D_REPEAT}};
    random_stream r = {.state = 1};
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)random_bits(&r);
    return e3d_texture_create(texels, TEXELS, TEXELS, 1, &sampling, out);
}

static void aim(e3d_frame *frame)
{
    const double distance = 2.6, near = 0.05, far = 20.0;
    for (int k = 0; k < 4; k++)
        frame->view_from_world[5 * k] = 1.0;
    frame->view_from_world[11] = -distance;
    frame->clip_from_world[0] = 2.0 * HEIGHT / WIDTH;
    frame->clip_from_world[5] = 2.0;
    frame->clip_from_world[10] = -(far + near) / (far - near);
    frame->clip_from_world[11] = -2.0 * far * near / (far - near) - frame->clip_from_world[10] * distance;
    frame->clip_from_world[14] = -1.0;
    frame->clip_from_world[15] = distance;
    frame->eye[2] = (float)distance;
    frame->eye[3] = 1.0f;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static uint64_t hash_of_color(void)
{
    uint64_t hash = 0xCBF29CE484222325u;
    for (size_t i = 0; i < sizeof color; i++)
        hash = (hash ^ color[i]) * 0x100000001B3u;
    return hash;
}

static int report(e3d_renderer *renderer, const e3d_frame *frame)
{
    const e3d_targets targets = {.color = color};
    double best = INFINITY;
    for (int i = 0; i < REPETITIONS; i++) {
        double start = now();
        if (e3d_render(renderer, frame, &targets, NULL) != E3D_OK)
            return 1;
        double seconds = now() - start;
        best = seconds < best ? seconds : best;
    }
    printf("frame 1 %.9g %016llx\n", best, (unsigned long long)hash_of_color());
    return 0;
}

int main(void)
{
    e3d_mesh *mesh = NULL;
    e3d_texture *texture = NULL;
    e3d_renderer *renderer = NULL;
    if (!e3d_backend_available(E3D_TIMED))
        return 3;
    if (make_mesh(&mesh) != E3D_OK || make_texture(&texture) != E3D_OK || e3d_renderer_create(E3D_TIMED, 1, &renderer) != E3D_OK)
        return 1;
    const e3d_material material = {.color = {0.9f, 0.8f, 0.7f}, .specular = {0.3f, 0.3f, 0.3f}, .shininess = 24.0f, .texture = {.texture = texture}};
    const e3d_light lights[2] = {
        {.kind = E3D_LIGHT_DIRECTIONAL, .color = {0.8f, 0.8f, 0.8f}, .to_light = {0.36f, 0.48f, 0.8f}},
        {.kind = E3D_LIGHT_POINT, .color = {0.5f, 0.4f, 0.3f}, .position = {0.5f, 0.5f, 1.0f}, .range = INFINITY},
    };
    e3d_draw draw = {.mesh = mesh, .instances = 1};
    for (int k = 0; k < 4; k++)
        draw.world_from_node[5 * k] = 1.0;
    e3d_frame frame = {.width = WIDTH, .height = HEIGHT, .samples_axis = 1, .cull = E3D_CULL_BACK, .line_width = 1, .point_size = 1,
                       .background = {0, 0, 0, 1}, .encode_srgb = 1, .decode_srgb = 1, .depth_far = 1, .ambient = {0.1f, 0.1f, 0.1f},
                       .light_clamp = {0, INFINITY}, .exposure = 1.0f, .materials = &material, .material_count = 1, .lights = lights,
                       .light_count = 2, .draws = &draw, .draw_count = 1};
    aim(&frame);
    int failed = report(renderer, &frame);
    e3d_renderer_destroy(renderer);
    e3d_texture_destroy(texture);
    e3d_mesh_destroy(mesh);
    return failed;
}
