/* Random and hostile scenes: every mode, mesh, texture, light and pose, in odd sizes.
 *
 * Hostile means: NaN, infinite, denormal and huge coordinates, triangles without area, through the
 * eye or far outside the view, all materials and normals out of the usual range.
 */
#include "check/driver/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "check/driver/hostile.h"
#include "check/driver/scene_arrays.h"

enum { MOST_GRID = 9,
       SOUP_TRIANGLES = 80 };

static void normalize(float *v)
{
    float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        v[k] = length > 0.0f ? v[k] / length : (k == 2);
}

static float *random_directions(scene *s, random_stream *r, int32_t count)
{
    float *values = random_floats(s, r, 3 * count, -1.0f, 1.0f);
    for (int32_t i = 0; i < count; i++)
        normalize(values + 3 * i);
    return values;
}

/* A closed-looking wavy sheet: shared vertices, so that a crack would show as background. */
static void grid_positions(float *positions, int32_t *faces, int32_t side, random_stream *r)
{
    for (int32_t i = 0; i < side * side; i++) {
        positions[3 * i] = (float)(i % side) / (float)(side - 1) * 2.0f - 1.0f;
        positions[3 * i + 1] = (float)(i / side) / (float)(side - 1) * 2.0f - 1.0f;
        positions[3 * i + 2] = random_float(r, -0.2f, 0.2f);
    }
    for (int32_t y = 0; y < side - 1; y++)
        for (int32_t x = 0; x < side - 1; x++, faces += 6) {
            int32_t corner = y * side + x;
            int32_t quad[6] = {corner, corner + 1, corner + side + 1,
                               corner, corner + side + 1, corner + side};
            memcpy(faces, quad, sizeof quad);
        }
}

static void describe_shape(scene *s, random_stream *r, e3d_mesh_desc *desc)
{
    desc->components = 3;
    if (s->calm || random_once_in(r, 2)) {
        int32_t side = s->calm ? 3 + random_below(r, MOST_GRID - 2) : MOST_GRID;
        desc->vertices = side * side;
        desc->faces_count = 2 * (side - 1) * (side - 1);
        float *positions = random_floats(s, r, 3 * desc->vertices, 0.0f, 0.0f);
        int32_t *faces = random_indices(s, r, 3 * desc->faces_count, 1);
        grid_positions(positions, faces, side, r);
        desc->positions = positions;
        desc->faces = faces;
        return;
    }
    float extent = random_once_in(r, 3) ? 2000.0f : 2.0f;
    desc->vertices = 3 + random_below(r, SOUP_TRIANGLES);
    desc->faces_count = random_below(r, SOUP_TRIANGLES);
    float *positions = random_floats(s, r, 3 * desc->vertices, -extent, extent);
    if (random_once_in(r, 2))
        hostile_replace(positions, 3 * desc->vertices, r, 12);
    desc->positions = positions;
    desc->faces = random_indices(s, r, 3 * desc->faces_count, desc->vertices);
}

static e3d_status add_mesh(scene *s, random_stream *r, int32_t index)
{
    e3d_mesh_desc desc = {0};
    describe_shape(s, r, &desc);
    int32_t vertices = desc.vertices, faces = desc.faces_count;
    float *normals = random_directions(s, r, vertices);
    if (random_once_in(r, 8))
        hostile_replace(normals, 3 * vertices, r, 10);
    desc.normals = normals;
    desc.face_normals = random_directions(s, r, faces);
    if (!random_once_in(r, 4)) {
        float *uvs = random_floats(s, r, 2 * vertices, -1.5f, 2.5f);
        if (random_once_in(r, 8))
            hostile_replace(uvs, 2 * vertices, r, 10);
        desc.uvs = uvs;
    }
    if (random_once_in(r, 2))
        desc.uvs1 = random_floats(s, r, 2 * vertices, -1.5f, 2.5f);
    if (random_once_in(r, 2)) {
        float *tangents = random_floats(s, r, 4 * vertices, -1.0f, 1.0f);
        if (random_once_in(r, 8))
            hostile_replace(tangents, 4 * vertices, r, 10);
        desc.tangents = tangents;
    }
    int32_t colors = random_below(r, 3);
    if (colors == 1)
        desc.colors_u8 = random_bytes(s, r, 4 * vertices);
    if (colors == 2)
        desc.colors_f32 = random_floats(s, r, 4 * vertices, -0.2f, 1.3f);
    desc.material_ids = random_indices(s, r, faces, SCENE_MAX_MATERIALS);
    int plain = random_once_in(r, 4); /* faces and edges only */
    desc.lines_count = plain ? 0 : random_below(r, 12);
    desc.lines = random_indices(s, r, 2 * desc.lines_count, vertices);
    desc.points_count = plain ? 0 : random_below(r, 12);
    desc.points = random_indices(s, r, desc.points_count, vertices);
    desc.edges_count = random_below(r, 60);
    desc.edges = random_indices(s, r, 2 * desc.edges_count, vertices);
    return e3d_mesh_create(&desc, 2, &s->meshes[index]);
}

/* A rotation from a random quaternion, a scale (negative now and then: a mirror) and an offset. */
static void random_pose(double *m, random_stream *r)
{
    double q[4], norm = 0.0;
    for (int k = 0; k < 4; k++) {
        q[k] = random_float(r, -1.0f, 1.0f);
        norm += q[k] * q[k];
    }
    double s = norm > 0.0 ? 2.0 / norm : 0.0;
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double rotation[9] = {1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),
                          s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w),
                          s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)};
    double mirror = random_once_in(r, 4) ? -1.0 : 1.0;
    double scale = mirror * random_float(r, 0.3f, 1.5f);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            m[4 * row + column] = rotation[3 * row + column] * scale;
        m[4 * row + 3] = random_float(r, -1.0f, 1.0f);
        m[12 + row] = 0.0;
    }
    m[15] = 1.0;
}

static void add_nodes(scene *s, random_stream *r, e3d_draw *draw)
{
    double *worlds = scene_array(s, 12 * (size_t)draw->instances, sizeof *worlds);
    for (int32_t i = 0; i < draw->instances; i++) {
        double pose[16];
        random_pose(pose, r);
        for (int k = 0; k < 12; k++)
            worlds[12 * i + k] = pose[k];
    }
    draw->node_worlds = worlds;
    draw->node_ids = random_indices(s, r, draw->instances, 1000);
}

static void add_instances(scene *s, random_stream *r, e3d_draw *draw)
{
    draw->pose_kind = (e3d_pose_kind)random_below(r, 4);
    draw->instances = 1;
    if (draw->pose_kind == E3D_POSE_NONE)
        return;
    draw->instances = random_below(r, 6);
    if (draw->pose_kind == E3D_POSE_NODES) {
        add_nodes(s, r, draw);
        return;
    }
    int32_t size = draw->pose_kind == E3D_POSE_MATRIX ? 16 : 4;
    float *poses = random_floats(s, r, size * draw->instances, -1.0f, 1.0f);
    for (int32_t i = 0; size == 16 && i < draw->instances; i++) {
        double pose[16];
        random_pose(pose, r);
        for (int k = 0; k < 16; k++)
            poses[16 * i + k] = (float)pose[k];
    }
    if (random_once_in(r, 6))
        hostile_replace(poses, size * draw->instances, r, 30);
    draw->poses = poses;
    if (random_once_in(r, 3))
        draw->instance_ids = random_indices(s, r, draw->instances, 1000);
    int32_t colors = random_below(r, 3);
    if (colors == 1)
        draw->instance_colors_u8 = random_bytes(s, r, 4 * draw->instances);
    if (colors == 2)
        draw->instance_colors_f32 = random_floats(s, r, 4 * draw->instances, 0.0f, 1.0f);
}

/* Every draw once, but those of nodes once for each; shuffled. */
static void add_order(scene *s, random_stream *r)
{
    e3d_frame *frame = &s->frame;
    int32_t *order = scene_array(s, 6 * SCENE_MAX_MESHES, sizeof *order), count = 0;
    for (int32_t d = 0; d < frame->draw_count; d++)
        for (int32_t i = 0; i < (s->draws[d].pose_kind == E3D_POSE_NODES ? s->draws[d].instances : 1); i++)
            order[count++] = d;
    for (int32_t i = count - 1; i > 0; i--) {
        int32_t other = random_below(r, i + 1), kept = order[i];
        order[i] = order[other];
        order[other] = kept;
    }
    frame->order = order;
    frame->order_count = count;
}

static e3d_status add_draws(scene *s, random_stream *r)
{
    e3d_status status = E3D_OK;
    int32_t count = random_once_in(r, 12) ? 0 : 1 + random_below(r, SCENE_MAX_MESHES);
    for (int32_t i = 0; i < count && status == E3D_OK; i++) {
        e3d_draw *draw = &s->draws[i];
        status = add_mesh(s, r, i);
        draw->mesh = s->meshes[i];
        random_pose(draw->world_from_node, r);
        add_instances(s, r, draw);
        draw->node_id = 10 * i;
    }
    s->frame.draws = s->draws;
    s->frame.draw_count = count;
    if (status == E3D_OK)
        add_order(s, r);
    return status;
}

static void add_texture_uses(scene *s, random_stream *r, e3d_material *material)
{
    for (int slot = 0; slot < E3D_TEXTURE_SLOTS; slot++) {
        e3d_texture_use use = {.uv_set = random_below(r, 2), .is_moved = random_once_in(r, 3)};
        if (random_once_in(r, 2))
            use.texture = s->textures[random_below(r, SCENE_MAX_TEXTURES)];
        for (int k = 0; k < 6; k++)
            use.matrix[k] = use.is_moved ? random_float(r, -3.0f, 3.0f) : 0.0f;
        e3d_material_set_texture(material, (e3d_texture_slot)slot, &use);
    }
}

static void make_physical(random_stream *r, e3d_material *material)
{
    e3d_physical *p = &material->physical;
    int coated = random_once_in(r, 2), fuzzy = random_once_in(r, 2), grey = random_once_in(r, 2);
    p->metallic = random_float(r, 0.0f, 1.0f);
    p->roughness = random_float(r, 0.0f, 1.0f);
    p->occlusion_strength = random_float(r, 0.0f, 1.0f);
    p->specular_intensity = random_float(r, 0.0f, 1.0f);
    p->clearcoat = coated ? random_float(r, 0.0f, 1.0f) : 0.0f;
    p->clearcoat_roughness = random_float(r, 0.0f, 1.0f);
    p->clearcoat_normal_scale = random_float(r, -2.0f, 2.0f);
    p->sheen_roughness = random_float(r, 0.0f, 1.0f);
    for (int k = 0; k < 3; k++) {
        p->reflectance[k] = grey ? 0.04f : random_float(r, 0.0f, 1.2f);
        p->sheen_color[k] = fuzzy ? random_float(r, 0.0f, 1.0f) : 0.0f;
    }
    material->is_physical = 1;
}

static e3d_status add_materials(scene *s, random_stream *r)
{
    for (int i = 0; i < SCENE_MAX_TEXTURES; i++) {
        int32_t width = 1 + random_below(r, 33), height = 1 + random_below(r, 33);
        uint8_t *pixels = random_bytes(s, r, 4 * width * height);
        const e3d_sampling sampling = {.filter = (e3d_filter)random_below(r, 3),
                                       .wrap = {(e3d_wrap)random_below(r, 3), (e3d_wrap)random_below(r, 3)},
                                       .anisotropy = random_once_in(r, 2) ? 1 + random_below(r, E3D_MAX_ANISOTROPY) : 1,
                                       .lod_bias = random_once_in(r, 2) ? random_float(r, -2.0f, 2.0f) : 0.0f,
                                       .holds_normals = random_once_in(r, 3)};
        e3d_status status = e3d_texture_create(pixels, width, height, random_below(r, 2), &sampling, &s->textures[i]);
        if (status != E3D_OK)
            return status;
    }
    for (int i = 0; i < SCENE_MAX_MATERIALS; i++) {
        e3d_material *material = &s->materials[i];
        int shiny = random_once_in(r, 2), glowing = random_once_in(r, 4);
        for (int k = 0; k < 3; k++) {
            material->color[k] = random_float(r, 0.0f, 1.2f);
            material->specular[k] = shiny ? random_float(r, 0.0f, 1.0f) : 0.0f;
            material->emissive[k] = glowing ? random_float(r, 0.0f, 0.5f) : 0.0f;
        }
        material->shininess = random_float(r, 0.01f, 300.0f);
        material->texture.texture = i < SCENE_MAX_TEXTURES ? s->textures[i] : NULL;
        material->id = 100 + i;
        material->two_sided = random_once_in(r, 3);
        material->flat = random_once_in(r, 3);
        material->is_unlit = random_once_in(r, 8);
        material->alpha = 1.0f;
        material->normal_scale = random_float(r, -2.0f, 2.0f);
        if (random_once_in(r, 2))
            add_texture_uses(s, r, material);
        if (random_once_in(r, 2))
            make_physical(r, material);
    }
    s->frame.materials = s->materials;
    s->frame.material_count = SCENE_MAX_MATERIALS;
    return E3D_OK;
}

#define ONE_MORE(...) +1
enum { LIGHT_KINDS = 0 E3D_EACH_LIGHT_KIND(ONE_MORE) };

/* Gives an area light its size: any, often none or very much along either side. */
static void extend_light(e3d_light *light, random_stream *r)
{
    float sizes[3] = {0};
    for (int k = 0; k < 3; k++) {
        if (random_once_in(r, 8))
            continue;
        int32_t exponent = random_below(r, random_once_in(r, 8) ? 60 : 6) - 4;
        sizes[k] = ldexpf(random_float(r, 0.5f, 1.0f), exponent);
    }
    for (int k = 0; k < 6; k++)
        light->extent[k / 3][k % 3] = random_float(r, -1.0f, 1.0f) * sizes[k / 3];
    light->radius = sizes[2];
}

static void add_lights(scene *s, random_stream *r)
{
    s->frame.lights = s->lights;
    s->frame.light_count = random_below(r, (random_once_in(r, 3) ? SCENE_MAX_LIGHTS : 4) + 1);
    for (int32_t i = 0; i < s->frame.light_count; i++) {
        e3d_light *light = &s->lights[i];
        light->kind = (e3d_light_kind)random_below(r, LIGHT_KINDS);
        light->falloff = (e3d_falloff)random_below(r, 3);
        int endless = light->falloff != E3D_FALLOFF_WINDOW && random_once_in(r, 2);
        light->range = endless ? INFINITY : random_float(r, 0.1f, 8.0f);
        for (int k = 0; k < 3; k++) {
            light->color[k] = random_float(r, 0.0f, 6.0f);
            light->to_light[k] = random_float(r, -1.0f, 1.0f);
            light->position[k] = random_float(r, -3.0f, 3.0f);
        }
        normalize(light->to_light);
        light->cone[0] = random_float(r, 0.0f, 0.95f);
        light->cone[1] = 1.0f / random_float(r, 0.001f, 1.0f);
        if (e3d_is_area_light(light->kind))
            extend_light(light, r);
    }
}

/* The eye is at (0, 0, distance) and looks down -Z, now and then into a mirror; a small distance puts triangles behind it. */
static void aim_camera(scene *s, random_stream *r)
{
    e3d_frame *frame = &s->frame;
    double distance = !s->calm && random_once_in(r, 3) ? 0.5 : 4.0;
    double near = 0.05, far = random_once_in(r, 4) ? 4.5 : 100.0;
    double aspect = (double)frame->width / frame->height;
    int orthographic = random_once_in(r, 4);
    double mirror = random_once_in(r, 4) ? -1.0 : 1.0;
    double *clip = frame->clip_from_world, *view = frame->view_from_world;
    for (int k = 0; k < 4; k++)
        view[5 * k] = 1.0;
    view[0] = mirror;
    view[11] = -distance;
    clip[0] = mirror * (orthographic ? 0.5 : 1.5) / aspect;
    clip[5] = orthographic ? 0.5 : 1.5;
    clip[10] = orthographic ? -2.0 / (far - near) : -(far + near) / (far - near);
    double offset = orthographic ? -(far + near) / (far - near) : -2.0 * far * near / (far - near);
    clip[11] = offset - clip[10] * distance;
    clip[14] = orthographic ? 0.0 : -1.0;
    clip[15] = orthographic ? 1.0 : distance;
    frame->eye[2] = orthographic ? 1.0f : (float)distance;
    frame->eye[3] = orthographic ? 0.0f : 1.0f;
    frame->depth_near = (float)near;
    frame->depth_far = (float)far;
}

static void choose_look(e3d_frame *frame, random_stream *r)
{
    frame->samples_axis = random_once_in(r, 4) ? 2 << random_below(r, 2) : 1;
    frame->mode = random_once_in(r, 2) ? E3D_MODE_LIT : (e3d_mode)random_below(r, 8);
    frame->cull = (e3d_cull)random_below(r, 3);
    frame->wireframe = random_once_in(r, 2) ? E3D_WIRE_NONE : (e3d_wireframe)random_below(r, 3);
    frame->hidden = random_once_in(r, 3) ? (e3d_hidden)random_below(r, 3) : E3D_HIDDEN_ZBUFFER;
    frame->shading = (e3d_shading)random_below(r, 2);
    frame->normals = (e3d_normals)random_below(r, 3);
    frame->remove_hidden_lines = random_below(r, 2);
    frame->line_width = random_once_in(r, 3) ? random_float(r, 0.01f, 20.0f) : 1.0f;
    frame->point_size = random_once_in(r, 3) ? random_float(r, 0.01f, 20.0f) : 1.0f;
    frame->line_shape = (e3d_line_shape)random_below(r, 2);
    frame->point_shape = (e3d_point_shape)random_below(r, 2);
    frame->encode_srgb = random_below(r, 2);
    frame->decode_srgb = random_below(r, 2);
    for (int k = 0; k < 3; k++) {
        frame->line_color[k] = random_float(r, 0.0f, 1.0f);
        frame->background[k] = random_float(r, 0.0f, 1.0f);
        frame->ambient[k] = random_float(r, 0.0f, 0.3f);
    }
    frame->background[3] = (float)random_below(r, 2);
    int clamped = random_once_in(r, 3);
    frame->light_clamp[0] = clamped ? 0.1f : 0.0f;
    frame->light_clamp[1] = clamped ? 1.0f : INFINITY;
    frame->exposure = random_once_in(r, 2) ? 1.0f : random_float(r, 0.1f, 4.0f);
    if (frame->samples_axis == 1 && random_once_in(r, 3))
        frame->msaa_samples = 2 << random_below(r, 4);
    frame->alpha_to_coverage = random_below(r, 2);
    frame->sample_shading = frame->msaa_samples && random_once_in(r, 2);
    frame->specular_antialiasing = random_below(r, 2);
}

/* Up to two apertures, in and beside the picture. */
static void add_apertures(scene *s, random_stream *r)
{
    const int32_t width = s->frame.width, height = s->frame.height;
    s->frame.apertures = s->apertures;
    s->frame.aperture_count = random_once_in(r, 2) ? random_below(r, 3) : 0;
    for (int k = 0; k < 2; k++) {
        e3d_aperture *w = &s->apertures[k];
        w->x0 = random_below(r, width);
        w->y0 = random_below(r, height);
        w->x1 = w->x0 + random_below(r, width);
        w->y1 = w->y0 + random_below(r, height);
    }
}

/* Fog near and far, thick and thin; what no display value may be is left out. */
static void choose_tone(e3d_frame *frame, random_stream *r)
{
    e3d_fog *fog = &frame->fog;
    frame->tone_mapping = random_once_in(r, 2) ? E3D_TONE_NONE : (e3d_tone_mapping)random_below(r, E3D_TONE_MAPPINGS);
    fog->kind = random_once_in(r, 3) ? E3D_FOG_NONE : (e3d_fog_kind)random_below(r, 3);
    fog->near = random_float(r, -1.0f, 4.0f);
    fog->far = fog->near + random_float(r, 0.001f, 20.0f);
    fog->density = random_once_in(r, 8) ? 1e20f : random_float(r, 0.0f, 2.0f);
    frame->gradient.shows = random_once_in(r, 3);
    if (frame->gradient.shows)
        frame->background[3] = 1.0f;
    for (int k = 0; k < 3; k++) {
        fog->color[k] = random_float(r, 0.0f, 1.5f);
        fog->lit_color[k] = random_float(r, 0.0f, 100.0f);
        frame->gradient.top[k] = random_float(r, 0.0f, 1.0f);
        frame->gradient.bottom[k] = random_float(r, 0.0f, 1.0f);
    }
}

/* Light from all around that differs by direction, and from pixel to pixel. */
static void add_ambient(scene *s, random_stream *r)
{
    e3d_ambient_light *light = &s->frame.ambient_light;
    light->is_given = random_once_in(r, 3);
    for (int k = 0; k < 3 * E3D_AMBIENT_TERMS && light->is_given; k++)
        light->terms[k / 3][k % 3] = random_float(r, -0.4f, 0.5f);
    if (random_once_in(r, 3))
        s->frame.ambient_visibility = random_floats(s, r, s->frame.width * s->frame.height, 0.0f, 1.0f);
}

/* Light passes through some physical materials that scatter it. The stream goes on as if there were none. */
static void add_translucency(scene *s, const random_stream *stream)
{
    random_stream own = *stream, *r = &own;
    for (int k = 0; k < SCENE_MAX_MATERIALS && random_once_in(r, 2); k++) {
        e3d_physical *p = &s->materials[k].physical;
        p->diffuse_transmission = random_once_in(r, 6) ? hostile_float(r) : random_float(r, 0.0f, 1.0f);
        for (int c = 0; c < 3; c++)
            p->diffuse_transmission_color[c] = random_float(r, 0.0f, 1.0f);
        if (random_once_in(r, 3))
            p->thickness = random_once_in(r, 6) ? hostile_float(r) : random_float(r, 0.0f, 1.0f);
    }
}

/* Random pictures for thick slices of space, which hold some of the faces. The stream goes on as if there were none. */
static void add_mirrors(scene *s, const random_stream *stream)
{
    e3d_frame *frame = &s->frame;
    random_stream own = *stream, *r = &own;
    int32_t axis = frame->samples_axis, count = random_once_in(r, 2) ? 1 + random_below(r, SCENE_MAX_MIRRORS) : 0;
    for (int k = 0; k < SCENE_MAX_MATERIALS && count; k++)
        s->materials[k].mirror = random_once_in(r, 6) ? hostile_float(r) : random_float(r, -0.3f, 1.0f);
    for (int32_t i = 0; i < count; i++) {
        e3d_mirror *mirror = &s->mirrors[i];
        int whole = random_once_in(r, 2);
        for (int k = 0; k < 3; k++)
            mirror->plane[k] = random_float(r, -1.0f, 1.0f);
        normalize(mirror->plane);
        mirror->plane[3] = random_once_in(r, 8) ? hostile_float(r) : random_float(r, -0.5f, 0.5f);
        mirror->slack = random_once_in(r, 4) ? 1e6f : random_float(r, 0.0f, 1.5f);
        mirror->width = whole ? frame->width * axis : random_below(r, 40);
        mirror->height = whole ? frame->height * axis : random_below(r, 40);
        mirror->left = whole ? 0 : random_below(r, 40) - 20;
        mirror->top = whole ? 0 : random_below(r, 40) - 20;
        mirror->scale = 1 << random_below(r, 3);
        mirror->radiance = random_texels(s, r, (size_t)(3 * mirror->width * mirror->height * mirror->scale * mirror->scale), 0.0f, 2.0f);
    }
    frame->mirrors = s->mirrors;
    frame->mirror_count = count;
}

e3d_status scene_create(scene *s, random_stream *r, int32_t most_side)
{
    memset(s, 0, sizeof *s);
    hostile_size(r, most_side, &s->frame.width, &s->frame.height);
    choose_look(&s->frame, r);
    s->calm = random_once_in(r, 3);
    aim_camera(s, r);
    add_lights(s, r);
    e3d_status status = add_materials(s, r);
    if (status == E3D_OK)
        status = add_draws(s, r);
    choose_tone(&s->frame, r);
    add_ambient(s, r);
    add_apertures(s, r);
    add_mirrors(s, r);
    add_translucency(s, r);
    return status;
}

/* Light passes through some of the physical materials; some absorb it, are brushed, or have a film. */
static void add_rare_parts(e3d_material *material, random_stream *r)
{
    e3d_physical *p = &material->physical;
    int transmits = random_once_in(r, 2), absorbs = random_once_in(r, 2), usual = !random_once_in(r, 6);
    p->transmission = transmits ? random_float(r, 0.2f, 1.0f) : 0.0f;
    p->thickness = absorbs ? random_float(r, 0.0f, 3.0f) : 0.0f;
    p->ior = random_once_in(r, 4) ? 1.0f : random_float(r, 1.0f, 2.5f);
    p->dispersion = random_once_in(r, 3) ? random_float(r, 0.0f, 4.0f) : 0.0f;
    if (random_once_in(r, 3))
        p->roughness = 0.0f;
    for (int k = 0; k < 3; k++)
        p->absorption[k] = random_float(r, -3.0f, 0.0f);
    p->anisotropy = random_once_in(r, 3) ? random_float(r, 0.0f, 1.0f) : 0.0f;
    p->iridescence = random_once_in(r, 3) ? random_float(r, 0.0f, 1.0f) : 0.0f;
    p->iridescence_ior = random_float(r, 1.0f, 2.5f);
    for (int k = 0; k < 2; k++) {
        p->anisotropy_turn[k] = random_float(r, -1.0f, 1.0f);
        p->iridescence_thickness[k] = random_float(r, 0.0f, 1500.0f);
    }
    if (!usual)
        p->transmission = hostile_float(r);
    if (!usual)
        p->thickness = hostile_float(r);
}

/* The frame may be a part of a picture. The stream goes on as if it were none. */
static void add_whole(e3d_frame *frame, random_stream own)
{
    if (random_once_in(&own, 2))
        return;
    frame->whole_width = 1 + random_below(&own, 400);
    frame->whole_height = 1 + random_below(&own, 400);
    frame->fineness = random_once_in(&own, 2) ? 2.0f : random_float(&own, 0.3f, 5.0f);
}

/* A picture behind glass, in which some things are in front of it; its shares are those of surfaces that are tone mapped. */
static void add_behind(scene *s, random_stream *r)
{
    e3d_frame *frame = &s->frame;
    size_t floats = e3d_behind_floats(frame->width, frame->height);
    float *texels = random_texels(s, r, floats, 0.0f, random_once_in(r, 4) ? 60000.0f : 1.5f);
    for (size_t i = 3; i < floats; i += 4)
        texels[i] = texels[i] < 1.0f ? texels[i] : 1.0f;
    frame->behind = texels;
    frame->behind_depth = random_texels(s, r, (size_t)frame->width * (size_t)frame->height, random_once_in(r, 2) ? -1.0f : 3.0f, 6.0f);
    add_whole(frame, *r);
}

void scene_add_alpha(scene *s, random_stream *r)
{
    int32_t sure = random_below(r, SCENE_MAX_MATERIALS);
    for (int i = 0; i < SCENE_MAX_MATERIALS; i++) {
        e3d_material *material = &s->materials[i];
        int usual = !random_once_in(r, 6);
        int32_t mode = random_below(r, 4);
        material->alpha_mode = i == sure || mode == 3 ? E3D_ALPHA_BLEND : (e3d_alpha_mode)mode;
        material->alpha = usual ? random_float(r, 0.2f, 1.1f) : hostile_float(r);
        material->alpha_cutoff = usual ? random_float(r, 0.1f, 0.7f) : hostile_float(r);
        if (material->is_physical)
            add_rare_parts(material, r);
    }
    s->frame.transparent_outputs = random_below(r, 2);
    s->frame.opaque_only = random_once_in(r, 6);
    if (random_once_in(r, 2))
        add_behind(s, r);
}

static e3d_environment_light environment_light(const scene *s, random_stream *r)
{
    float turn = random_float(r, -1.0f, 1.0f), intensity = random_once_in(r, 6) ? hostile_factor(r) : random_float(r, 0.0f, 3.0f);
    return (e3d_environment_light){s->environment, turn, sqrtf(1.0f - turn * turn), intensity};
}

e3d_status scene_add_environment(scene *s, random_stream *r)
{
    enum { WIDTH = 8,
           HEIGHT = 4 };
    const float *pixels = random_floats(s, r, WIDTH * HEIGHT * 3, 0.0f, 4.0f);
    e3d_backdrop *backdrop = &s->frame.backdrop;
    e3d_status status = e3d_environment_create(pixels, WIDTH, HEIGHT, 2, &s->environment);
    if (status != E3D_OK)
        return status;
    s->frame.environment = environment_light(s, r);
    if (random_once_in(r, 2))
        backdrop->light = environment_light(s, r);
    backdrop->level = random_float(r, 0.0f, (float)(E3D_ENVIRONMENT_LEVELS - 1));
    for (int k = 0; k < 3; k++) {
        backdrop->ray[k] = random_float(r, -1.0f, 1.0f);
        backdrop->across[k] = random_float(r, -0.02f, 0.02f);
        backdrop->down[k] = random_float(r, -0.02f, 0.02f);
    }
    return E3D_OK;
}

void scene_destroy(scene *s)
{
    e3d_environment_destroy(s->environment);
    for (int i = 0; i < SCENE_MAX_MESHES; i++)
        if (s->meshes[i] != NULL)
            e3d_mesh_destroy(s->meshes[i]);
    for (int i = 0; i < SCENE_MAX_TEXTURES; i++)
        if (s->textures[i] != NULL)
            e3d_texture_destroy(s->textures[i]);
    for (int32_t i = 0; i < s->array_count; i++)
        free(s->arrays[i]);
}
