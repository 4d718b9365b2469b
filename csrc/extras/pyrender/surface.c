/* Surfaces: finds the surface of a fragment from its corners and textures.
 * In: corners, their weights, the plane of the triangle. Out: a row of a batch.
 * Always: textures are read at the detail of the 2x2 pixels around the fragment, as graphics hardware does. */
#include <math.h>

#include "base/vectors.h"
#include "extras/pyrender/picture.h"
#include "extras/pyrender/transfer_tables.h"

static void interpolate(const float *array, int channels, const pyr_weights *weights, float *out)
{
    for (int c = 0; c < channels; c++)
        out[c] = 0;
    for (int k = 0; k < 3; k++) {
        const float *row = array + (size_t)channels * (size_t)weights->corner[k];
        for (int c = 0; c < channels; c++)
            out[c] += weights->weight[k] * row[c];
    }
}

/* u, v and the position at a point of the triangle's plane. */
typedef struct place {
    float uv[2], world[3];
} place;

static place place_at(const e3d_pyr_draw *draw, const pyr_plane *plane, double x, double y)
{
    place out = {{0}, {0}};
    pyr_weights weights;
    pyr_weigh(plane, x, y, &weights);
    interpolate(draw->uvs, 2, &weights, out.uv);
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            out.world[c] += weights.weight[k] * plane->vertex[k]->world[c];
    return out;
}

/* The change of coordinates and positions from pixel to pixel, to the right and up. */
typedef struct slopes {
    float uv[2][2], world[2][3];
} slopes;

static slopes slopes_of(const e3d_pyr_frame *frame, const e3d_pyr_draw *draw, const pyr_plane *plane, int32_t x, int32_t y)
{
    slopes out;
    int32_t left = x & ~1, low = (frame->height - 1 - y) & ~1; /* the corner of the four pixels, with rows counted from below */
    double px = left + 0.5, py = (frame->height - 1 - low) + 0.5;
    place at = place_at(draw, plane, px, py), right = place_at(draw, plane, px + 1, py), up = place_at(draw, plane, px, py - 1);
    for (int c = 0; c < 2; c++) {
        out.uv[0][c] = right.uv[c] - at.uv[c];
        out.uv[1][c] = up.uv[c] - at.uv[c];
    }
    for (int c = 0; c < 3; c++) {
        out.world[0][c] = right.world[c] - at.world[c];
        out.world[1][c] = up.world[c] - at.world[c];
    }
    return out;
}

static float most_texels(const e3d_pyr_texture *texture, const slopes *change)
{
    float most = 0;
    for (int along = 0; along < 2; along++) {
        float u = change->uv[along][0] * (float)texture->width, v = change->uv[along][1] * (float)texture->height;
        float square = u * u + v * v;
        most = square > most ? square : most;
    }
    return sqrtf(most);
}

static void read(const e3d_pyr_texture *texture, const float uv[2], const slopes *change, float out[4])
{
    pyr_sample(texture, uv[0], uv[1], most_texels(texture, change), out);
}

static float light_of(float code) { return E3D_PYR_SRGB_LIGHT[(int)(code * 255 + 0.5f)]; }

static void make_unit(float v[3])
{
    float square = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2], scale = square > 0 ? 1 / sqrtf(square) : 0;
    for (int c = 0; c < 3; c++)
        v[c] *= scale;
}

static void cross(const float a[3], const float b[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

/* Finds the normal of a normal texture, in the frame of the texture's directions along the surface (Mikkelsen 2010, without
 * vertex tangents). */
static void map_normal(const e3d_pyr_texture *texture, const float uv[2], const slopes *change, pyr_batch *batch, int i)
{
    float texel[4], n[3] = {batch->normal[0][i], batch->normal[1][i], batch->normal[2][i]}, t[3], b[3];
    read(texture, uv, change, texel);
    float det = change->uv[0][0] * change->uv[1][1] - change->uv[1][0] * change->uv[0][1];
    for (int c = 0; c < 3; c++)
        t[c] = (change->uv[1][1] * change->world[0][c] - change->uv[0][1] * change->world[1][c]) / det;
    make_unit(n);
    float along = (n[0] * t[0] + n[1] * t[1]) + n[2] * t[2];
    for (int c = 0; c < 3; c++)
        t[c] -= n[c] * along;
    make_unit(t);
    cross(n, t, b);
    make_unit(b);
    for (int c = 0; c < 3; c++)
        batch->normal[c][i] = (t[c] * (2 * texel[0] - 1) + b[c] * (2 * texel[1] - 1)) + n[c] * (2 * texel[2] - 1);
}

static void fill(float *out, float value)
{
    for (int i = 0; i < PYR_BATCH; i++)
        out[i] = value;
}

void pyr_begin_surfaces(const e3d_pyr_frame *frame, pyr_batch *batch)
{
    const e3d_pyr_draw *draw = batch->draw;
    if (frame->shading == E3D_PYR_PLAIN || frame->shading == E3D_PYR_DEPTH || (batch->filled == draw && !draw->uvs))
        return;
    batch->filled = draw;
    for (int c = 0; c < 4; c++) {
        fill(batch->base[c], draw->color[c]);
        fill(batch->vertex_color[c], 1);
    }
    fill(batch->roughness, draw->roughness);
    fill(batch->metallic, draw->metallic);
    fill(batch->occlusion, 1);
    for (int c = 0; c < 3; c++)
        fill(batch->emissive[c], draw->emissive[c] * draw->emissive[c]);
}

static void set_vertex_color(pyr_batch *batch, int i, const pyr_weights *weights)
{
    float color[4];
    interpolate(batch->draw->colors, 4, weights, color);
    for (int c = 0; c < 4; c++)
        batch->vertex_color[c][i] = color[c];
}

static void set_geometry(const e3d_pyr_frame *frame, pyr_batch *batch, int i, const pyr_weights *weights)
{
    float4 world = splat(0), normal = splat(0);
    for (int k = 0; k < 3; k++) {
        const pyr_vertex *vertex = &batch->vertices[weights->corner[k]];
        float4 weight = splat(weights->weight[k]);
        world += weight * load4(vertex->world);
        normal += weight * load4(vertex->normal);
    }
    if (!batch->draw->normals)
        normal = (float4){frame->eye[0], frame->eye[1], frame->eye[2], 0} - world;
    for (int c = 0; c < 3; c++) {
        batch->world[c][i] = world[c];
        batch->normal[c][i] = normal[c];
    }
}

static void read_textures(const e3d_pyr_frame *frame, pyr_batch *batch, int i, const pyr_weights *weights, const pyr_plane *plane)
{
    const e3d_pyr_draw *draw = batch->draw;
    const e3d_pyr_texture *const *textures = draw->textures;
    slopes change = {{{0}}, {{0}}};
    float uv[2], texel[4];
    interpolate(draw->uvs, 2, weights, uv);
    if (plane)
        change = slopes_of(frame, draw, plane, batch->x[i], batch->y[i]);
    if (textures[E3D_PYR_BASE_COLOR]) {
        read(textures[E3D_PYR_BASE_COLOR], uv, &change, texel);
        int is_lit = frame->shading == E3D_PYR_LIT;
        for (int c = 0; c < 4; c++)
            batch->base[c][i] *= is_lit && c < 3 ? light_of(texel[c]) : texel[c];
    }
    if (frame->shading != E3D_PYR_LIT)
        return;
    if (textures[E3D_PYR_ROUGHNESS_METALLIC]) {
        read(textures[E3D_PYR_ROUGHNESS_METALLIC], uv, &change, texel);
        batch->roughness[i] *= texel[0];
        batch->metallic[i] *= texel[1];
    }
    if (textures[E3D_PYR_NORMAL] && draw->normals && plane)
        map_normal(textures[E3D_PYR_NORMAL], uv, &change, batch, i);
    if (textures[E3D_PYR_OCCLUSION]) {
        read(textures[E3D_PYR_OCCLUSION], uv, &change, texel);
        batch->occlusion[i] = texel[0];
    }
    if (textures[E3D_PYR_EMISSIVE]) {
        read(textures[E3D_PYR_EMISSIVE], uv, &change, texel);
        for (int c = 0; c < 3; c++)
            batch->emissive[c][i] *= light_of(texel[c]);
    }
}

void pyr_find_surface(pyr_band *band, int i, const pyr_weights *weights, const pyr_plane *plane)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    pyr_batch *batch = &band->batch;
    if (frame->shading == E3D_PYR_PLAIN)
        return;
    if (batch->draw->colors)
        set_vertex_color(batch, i, weights);
    if (frame->shading == E3D_PYR_LIT)
        set_geometry(frame, batch, i, weights);
    if (batch->draw->uvs)
        read_textures(frame, batch, i, weights, plane);
}
