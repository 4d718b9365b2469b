/* Geoms to draws: which shapes a geom is made of, where they stand, how a texture lies on them (R252, R254, R256).
 * In: the geoms of a frame. Out: opaque draws in their order, the reflecting geom's first; transparent ones, near geoms first. */
#include <math.h>
#include <stdlib.h>

#include "extras/mujoco/picture.h"

#define LEAST 1e-15f
#define OPAQUE_ALPHA 0.995f
#define PLANE_DISTANCE 1e10f

const muj_draw *muj_draw_of(const muj_picture *picture, int32_t number)
{
    int32_t opaque = (int32_t)picture->draws.count;
    return number < opaque ? (const muj_draw *)picture->draws.data + number : (const muj_draw *)picture->blended.data + (number - opaque);
}

static muj_draw *add_draw(e3d_array *list, const muj_draw *draw)
{
    if (!e3d_array_reserve(list, list->count + 1, sizeof *draw))
        return NULL;
    muj_draw *out = (muj_draw *)list->data + list->count++;
    *out = *draw;
    return out;
}

/* ---- textures ---- */

/* The sizes of skins and flexes are those of no shape: a uniform texture repeats on them as any other. */
static int has_size(const e3d_muj_geom *geom)
{
    return geom->type != E3D_MUJ_FLEX && geom->type != E3D_MUJ_SKIN;
}

static void map_by_uvs(const e3d_muj_frame *frame, const e3d_muj_geom *geom, muj_draw *out)
{
    out->mapping = MUJ_BY_UVS;
    for (int c = 0; c < 2; c++) {
        out->scale[c] = geom->texrepeat[c] > 0 && frame->builtin_uvs ? geom->texrepeat[c] : 1;
        if (geom->texuniform && frame->builtin_uvs && geom->size[c] > 0 && has_size(geom))
            out->scale[c] *= geom->size[c];
        out->offset[c] = geom->type == E3D_MUJ_PLANE && (geom->size[0] <= 0 || geom->size[1] <= 0) ? -0.5f : 0;
    }
}

static void map_by_position(const e3d_muj_geom *geom, muj_draw *out)
{
    out->mapping = MUJ_BY_POSITION;
    for (int c = 0; c < 2; c++) {
        float scale = geom->texrepeat[c], size = geom->size[c];
        if (geom->dataid >= 0 && size > 0)
            scale /= size > LEAST ? size : LEAST;
        if (geom->texuniform && size > 0)
            scale *= size;
        out->scale[c] = c ? -0.5f * scale : 0.5f * scale;
        out->offset[c] = -0.5f;
    }
}

static int has_uvs(const e3d_muj_geom *geom)
{
    switch (geom->type) {
    case E3D_MUJ_HFIELD:
    case E3D_MUJ_MESH:
    case E3D_MUJ_SDF:
    case E3D_MUJ_FLEX:
    case E3D_MUJ_SKIN: return 0;
    default: return 1;
    }
}

static void set_texture(const e3d_muj_frame *frame, const e3d_muj_geom *geom, muj_draw *out)
{
    out->mapping = MUJ_UNTEXTURED;
    if (geom->matid < 0 || geom->texid < 0 || geom->texid >= frame->texture_count)
        return;
    const e3d_muj_texture *texture = &frame->textures[geom->texid];
    if (!texture->levels)
        return;
    out->texture = texture;
    if (geom->texcoord || (texture->faces == 1 && has_uvs(geom) && frame->builtin_uvs)) {
        if (texture->faces == 1)
            map_by_uvs(frame, geom, out);
    } else if (texture->faces == 1) {
        map_by_position(geom, out);
    } else {
        out->mapping = MUJ_BY_DIRECTION;
        for (int c = 0; c < 3; c++)
            out->scale[c] = geom->texuniform ? geom->size[c] : 1;
    }
}

/* ---- parts ---- */

/* The number of a model's shape; MUJ_NONE if there is none. */
static int32_t shape_of(const e3d_muj_frame *frame, int32_t first, int32_t number)
{
    return number >= 0 && number < frame->shape_count - first ? first + number : MUJ_NONE;
}

static int32_t plain_of(int32_t shape)
{
    switch (shape) {
    case E3D_MUJ_UNIT_CYLINDER: return E3D_MUJ_PLAIN_CYLINDER;
    case E3D_MUJ_OPEN_CYLINDER: return E3D_MUJ_PLAIN_OPEN_CYLINDER;
    case E3D_MUJ_CONE: return E3D_MUJ_PLAIN_CONE;
    case E3D_MUJ_UNIT_BOX: return E3D_MUJ_PLAIN_BOX;
    default: return shape;
    }
}

/* A shape, scaled, then moved along the geom's z axis. */
static int add_part(const muj_picture *picture, e3d_array *list, const muj_draw *start, int32_t shape, float sx, float sy, float sz, float shift)
{
    const e3d_muj_frame *frame = picture->frame;
    muj_draw draw = *start;
    double scale[3] = {sx, sy, sz};
    if (shape < 0 || shape >= frame->shape_count || !frame->shapes[shape].triangles)
        return 1;
    draw.plain = &frame->shapes[plain_of(shape)];
    draw.shape = frame->is_segmented || !draw.is_lit ? draw.plain : &frame->shapes[shape];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            double m = start->world[r][c];
            draw.world[r][c] = m * scale[c];
            draw.normal[r][c] = (float)(scale[c] != 0 ? m / scale[c] : 0);
        }
        draw.world[r][3] = start->world[r][3] + start->world[r][2] * shift;
    }
    return add_draw(list, &draw) != NULL;
}

static int add_arrow(const muj_picture *picture, e3d_array *list, const muj_draw *start, float wedge)
{
    const float *s = start->geom->size;
    float sixth = s[2] / 6;
    return add_part(picture, list, start, E3D_MUJ_UNIT_CYLINDER, s[0], s[1], sixth, sixth) &&
           add_part(picture, list, start, E3D_MUJ_CONE, wedge * s[0], wedge * s[1], sixth, 2 * sixth);
}

static int add_double_arrow(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    const float *s = start->geom->size;
    float sixth = s[2] / 6, x = 1.75f * s[0], y = 1.75f * s[1];
    return add_part(picture, list, start, E3D_MUJ_OPEN_CYLINDER, s[0], s[1], s[2] / 3, 0) &&
           add_part(picture, list, start, E3D_MUJ_CONE, x, -y, -sixth, -2 * sixth) &&
           add_part(picture, list, start, E3D_MUJ_CONE, x, y, sixth, 2 * sixth);
}

static int add_capsule(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    const float *s = start->geom->size;
    float radius = 0.5f * (s[0] + s[1]);
    return add_part(picture, list, start, E3D_MUJ_OPEN_CYLINDER, s[0], s[1], s[2], 0) &&
           add_part(picture, list, start, E3D_MUJ_CAP_TOP, s[0], s[1], radius, s[2] - radius) &&
           add_part(picture, list, start, E3D_MUJ_CAP_BOTTOM, s[0], s[1], radius, radius - s[2]);
}

static int add_plane(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    const e3d_muj_frame *frame = picture->frame;
    const e3d_muj_geom *geom = start->geom;
    muj_draw draw = *start;
    if (geom->dataid >= frame->plane_count - 1)
        return 1;
    int32_t number = geom->dataid >= 0 ? geom->dataid + 1 : 0;
    draw.kind = MUJ_GRID;
    draw.plane = &frame->planes[number];
    for (int r = 0; r < 3 && number == 0; r++)
        for (int c = 0; c < 2; c++)
            draw.world[r][c] *= geom->size[c];
    if (muj_is_behind(frame->eye, geom)) {
        draw.facing = -draw.facing;
        draw.rgba[3] *= 0.3f;
    }
    return add_draw(list, &draw) != NULL;
}

static int add_lines(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    static const int8_t ENDS[12][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7}, {7, 6}, {6, 4}, {0, 4}, {1, 5}, {3, 7}, {2, 6}};
    const e3d_muj_geom *geom = start->geom;
    muj_draw draw = *start;
    draw.kind = MUJ_LINES;
    draw.is_lit = 0;
    draw.facing = 0;
    draw.mapping = MUJ_UNTEXTURED;
    draw.lines = geom->type == E3D_MUJ_LINE ? 1 : 12;
    draw.width = (geom->type == E3D_MUJ_LINE ? geom->size[0] : 1.5f) * picture->frame->line_width;
    memset(draw.line_ends, 0, sizeof draw.line_ends);
    draw.line_ends[0][1][2] = geom->size[2];
    for (int i = 0; i < 12 && draw.lines == 12; i++)
        for (int e = 0; e < 2; e++)
            for (int c = 0; c < 3; c++)
                draw.line_ends[i][e][c] = ENDS[i][e] >> c & 1 ? geom->size[c] : -geom->size[c];
    return add_draw(list, &draw) != NULL;
}

/* Those of a geom that lie in the world as they are: skins, and the shapes that a flex is made of. */
static int add_in_world(const muj_picture *picture, e3d_array *list, const muj_draw *start, int32_t shape)
{
    muj_draw draw = *start;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            draw.world[r][c] = r == c;
    return add_part(picture, list, &draw, shape, 1, 1, 1, 0);
}

/* Vertices and edges of a flex have no texture; its faces may have one. */
static int add_flex(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    int32_t first = shape_of(picture->frame, picture->frame->first_flex, start->geom->objid);
    muj_draw plain = *start;
    plain.mapping = MUJ_UNTEXTURED;
    if (first < 0)
        return 1;
    first += start->geom->objid;
    return add_in_world(picture, list, &plain, first) && add_in_world(picture, list, start, first + 1);
}

static int add_parts(const muj_picture *picture, e3d_array *list, const muj_draw *start)
{
    const e3d_muj_frame *frame = picture->frame;
    const e3d_muj_geom *geom = start->geom;
    const float *s = geom->size;
    switch (geom->type) {
    case E3D_MUJ_PLANE: return add_plane(picture, list, start);
    case E3D_MUJ_HFIELD: return add_part(picture, list, start, shape_of(frame, frame->first_hfield, geom->dataid), 1, 1, 1, 0);
    case E3D_MUJ_SPHERE:
    case E3D_MUJ_ELLIPSOID: return add_part(picture, list, start, E3D_MUJ_UNIT_SPHERE, s[0], s[1], s[2], 0);
    case E3D_MUJ_CAPSULE: return add_capsule(picture, list, start);
    case E3D_MUJ_CYLINDER: return add_part(picture, list, start, E3D_MUJ_UNIT_CYLINDER, s[0], s[1], s[2], 0);
    case E3D_MUJ_BOX: return add_part(picture, list, start, E3D_MUJ_UNIT_BOX, s[0], s[1], s[2], 0);
    case E3D_MUJ_MESH:
    case E3D_MUJ_SDF: return add_part(picture, list, start, shape_of(frame, frame->first_mesh, geom->dataid), 1, 1, 1, 0);
    case E3D_MUJ_ARROW: return add_arrow(picture, list, start, 1.75f);
    case E3D_MUJ_ARROW1: return add_arrow(picture, list, start, 1);
    case E3D_MUJ_ARROW2: return add_double_arrow(picture, list, start);
    case E3D_MUJ_LINE:
    case E3D_MUJ_LINEBOX: return add_lines(picture, list, start);
    case E3D_MUJ_TRIANGLE: return add_part(picture, list, start, E3D_MUJ_UNIT_TRIANGLE, s[0], s[1], 1, 0);
    case E3D_MUJ_SKIN: return add_in_world(picture, list, start, shape_of(frame, frame->first_skin, geom->objid));
    case E3D_MUJ_FLEX: return add_flex(picture, list, start);
    default: return 1;
    }
}

static void begin_draw(const muj_picture *picture, int32_t number, muj_draw *out)
{
    const e3d_muj_frame *frame = picture->frame;
    const e3d_muj_geom *geom = &frame->geoms[number];
    memset(out, 0, sizeof *out);
    out->geom = geom;
    out->number = number;
    out->facing = frame->culls_backs && geom->type != E3D_MUJ_TRIANGLE;
    out->is_lit = 1;
    out->casts = geom->category != 4 && geom->type != E3D_MUJ_LINE && geom->castshadow;
    memcpy(out->rgba, geom->rgba, sizeof out->rgba);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            out->world[r][c] = out->normal[r][c] = geom->mat[3 * r + c];
        out->world[r][3] = geom->pos[r];
    }
    set_texture(frame, geom, out);
}

static int add_geom(muj_picture *picture, e3d_array *list, int32_t number, int is_reflective)
{
    muj_draw draw;
    begin_draw(picture, number, &draw);
    draw.is_reflective = is_reflective;
    return add_parts(picture, list, &draw);
}

/* ---- order (R250) ---- */

typedef struct placed {
    float distance;
    int32_t number;
} placed;

static int is_transparent(const e3d_muj_frame *frame, const e3d_muj_geom *geom)
{
    return geom->rgba[3] < OPAQUE_ALPHA || (geom->type == E3D_MUJ_PLANE && muj_is_behind(frame->eye, geom));
}

static int is_reflective(const e3d_muj_frame *frame, const e3d_muj_geom *geom)
{
    return (geom->type == E3D_MUJ_PLANE || geom->type == E3D_MUJ_BOX) && geom->reflectance > 0 && !is_transparent(frame, geom);
}

/* The radius of a sphere around a geom. */
static float bound_of(const e3d_muj_geom *geom)
{
    const float *s = geom->size;
    float most = s[0] > s[1] ? s[0] : s[1];
    if (geom->rbound >= 0)
        return geom->rbound;
    switch (geom->type) {
    case E3D_MUJ_SPHERE: return s[0];
    case E3D_MUJ_CAPSULE: return s[0] + s[2];
    case E3D_MUJ_CYLINDER: return sqrtf(s[0] * s[0] + s[2] * s[2]);
    case E3D_MUJ_BOX: return sqrtf((s[0] * s[0] + s[1] * s[1]) + s[2] * s[2]);
    default: return most > s[2] ? most : s[2];
    }
}

static float distance_of(const e3d_muj_frame *frame, const e3d_muj_geom *geom)
{
    float sum = 0;
    if (geom->type == E3D_MUJ_PLANE)
        return PLANE_DISTANCE;
    for (int c = 0; c < 3; c++) {
        float d = geom->pos[c] - (float)frame->eye[c];
        sum += d * d;
    }
    float distance = sqrtf(sum) - bound_of(geom);
    return distance < PLANE_DISTANCE ? distance : PLANE_DISTANCE; /* NaN: far */
}

static int compare_placed(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    if (p->distance != q->distance)
        return p->distance < q->distance ? -1 : 1;
    return p->number < q->number ? -1 : 1;
}

static int add_blended(muj_picture *picture)
{
    const e3d_muj_frame *frame = picture->frame;
    placed *list = malloc(((size_t)frame->geom_count + 1) * sizeof *list);
    int32_t count = 0, is_done = list != NULL;
    for (int32_t i = 0; is_done && i < frame->geom_count; i++)
        if (is_transparent(frame, &frame->geoms[i]))
            list[count++] = (placed){distance_of(frame, &frame->geoms[i]), i};
    if (count)
        qsort(list, (size_t)count, sizeof *list, compare_placed);
    for (int32_t i = 0; is_done && i < count; i++)
        is_done = add_geom(picture, &picture->blended, list[i].number, 0);
    free(list);
    return is_done;
}

/* ---- the sky ---- */

/* A cylinder around the head, of which the inside shows. */
static int add_sky(muj_picture *picture)
{
    const e3d_muj_frame *frame = picture->frame;
    muj_draw draw;
    if (frame->sky < 0 || frame->sky >= frame->texture_count || !frame->textures[frame->sky].levels)
        return 1;
    memset(&draw, 0, sizeof draw);
    draw.number = MUJ_NONE;
    draw.facing = frame->culls_backs ? -1 : 0;
    draw.mapping = MUJ_BY_DIRECTION;
    draw.texture = &frame->textures[frame->sky];
    for (int c = 0; c < 4; c++)
        draw.rgba[c] = 1;
    for (int c = 0; c < 3; c++) {
        draw.scale[c] = 1;
        draw.world[c][c] = 1;
        draw.world[c][3] = frame->eye[c];
    }
    float reach = (float)frame->far_plane * 0.7f;
    return add_part(picture, &picture->draws, &draw, E3D_MUJ_UNIT_CYLINDER, reach, reach, reach, 0);
}

/* The haze stands on the first plane without ends, if the head is above it. */
static int add_haze(muj_picture *picture, e3d_array *list)
{
    const e3d_muj_frame *frame = picture->frame;
    double reach = frame->far_plane * 0.7, above = 0;
    int32_t i = 0;
    while (i < frame->geom_count && (frame->geoms[i].type != E3D_MUJ_PLANE || frame->geoms[i].size[0] != 0 || frame->geoms[i].size[1] != 0))
        i++;
    if (frame->sky < 0 || !frame->has_haze || i == frame->geom_count)
        return 1;
    const e3d_muj_geom *geom = &frame->geoms[i];
    for (int c = 0; c < 3; c++)
        above += (frame->eye[c] - geom->pos[c]) * geom->mat[3 * c + 2];
    if (above < 0)
        return 1;
    muj_draw draw;
    memset(&draw, 0, sizeof draw);
    draw.number = MUJ_NONE;
    draw.facing = frame->culls_backs ? -1 : 0;
    draw.is_haze = 1;
    memcpy(draw.rgba, frame->haze, sizeof frame->haze);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++)
            draw.world[r][c] = geom->mat[3 * r + c];
        draw.world[r][3] = frame->eye[r] - geom->mat[3 * r + 2] * above;
    }
    picture->has_haze = 1;
    return add_part(picture, list, &draw, E3D_MUJ_HAZE, (float)reach, (float)reach, (float)above, 0);
}

int muj_expand(muj_picture *picture)
{
    const e3d_muj_frame *frame = picture->frame;
    int32_t mirror = MUJ_NONE;
    picture->draws.count = picture->blended.count = 0;
    picture->has_mirror = picture->has_haze = 0;
    if (frame->is_segmented) {
        for (int32_t i = 0; i < frame->geom_count; i++)
            if (frame->geoms[i].segid >= 0 && !add_geom(picture, &picture->draws, i, 0))
                return 0;
        return add_sky(picture) && add_haze(picture, &picture->draws); /* colours have left their depths, too */
    }
    for (int32_t i = 0; mirror == MUJ_NONE && i < frame->geom_count; i++)
        if (is_reflective(frame, &frame->geoms[i]))
            mirror = i;
    if (mirror != MUJ_NONE && !add_geom(picture, &picture->draws, mirror, 1))
        return 0;
    picture->has_mirror = mirror != MUJ_NONE && frame->reflects && muj_set_mirror(&picture->view, &frame->geoms[mirror], &picture->mirror);
    for (int32_t i = 0; i < frame->geom_count; i++)
        if (i != mirror && !is_transparent(frame, &frame->geoms[i]) && !add_geom(picture, &picture->draws, i, 0))
            return 0;
    return add_sky(picture) && add_haze(picture, &picture->blended) && add_blended(picture); /* geoms are blended over the haze */
}
