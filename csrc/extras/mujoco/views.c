/* Views: the camera's, the mirrored one, a light's (R251, R262, R266).
 * In: a frame. Out: rows from the world to pixels and depth. */
#include <math.h>

#include "extras/mujoco/picture.h"

void muj_compose(const double rows[4], const double world[3][4], double out[4])
{
    for (int c = 0; c < 4; c++)
        out[c] = (rows[0] * world[0][c] + rows[1] * world[1][c]) + rows[2] * world[2][c];
    out[3] += rows[3];
}

/* Depth is 1 at the near plane, 0 at the far plane. */
static void set_depth_rows(const e3d_muj_frame *frame, int is_orthographic, muj_view *out)
{
    double range = frame->far_plane - frame->near_plane, scale = is_orthographic ? 1 / range : frame->depth_scale;
    for (int c = 0; c < 4; c++) {
        out->rows[2][c] = -out->ahead[c] * scale;
        out->rows[3][c] = is_orthographic ? c == 3 : out->ahead[c];
    }
    out->rows[2][3] += is_orthographic ? frame->far_plane * scale : frame->depth_offset;
}

void muj_set_view(const e3d_muj_frame *frame, muj_view *out)
{
    double wide = frame->right - frame->left, high = frame->top - frame->bottom;
    double across = frame->width / wide, up = frame->height / high;
    if (!frame->is_orthographic) {
        across *= frame->near_plane;
        up *= frame->near_plane;
    }
    memset(out, 0, sizeof *out);
    memcpy(out->ahead, frame->view[2], sizeof out->ahead);
    memcpy(out->eye, frame->eye, sizeof out->eye);
    set_depth_rows(frame, frame->is_orthographic, out);
    for (int c = 0; c < 4; c++) {
        out->rows[0][c] = frame->view[0][c] * across - out->rows[3][c] * (frame->left / wide * frame->width);
        out->rows[1][c] = out->rows[3][c] * (frame->top / high * frame->height) - frame->view[1][c] * up;
    }
    out->tint = 1;
    out->high[0] = frame->width - 1, out->high[1] = frame->height - 1;
    out->samples = frame->samples;
    out->first_sample = frame->samples == 1 ? 128 : 32;
    out->guard = frame->width > MUJ_GUARD / 2 || frame->height > MUJ_GUARD / 2 ? MUJ_MOST : MUJ_GUARD;
}

static void mirror_row(double row[4], const double normal[3], double offset)
{
    double along = (row[0] * normal[0] + row[1] * normal[1]) + row[2] * normal[2];
    for (int c = 0; c < 3; c++)
        row[c] -= 2 * along * normal[c];
    row[3] += 2 * along * offset;
}

int muj_set_mirror(const muj_view *view, const e3d_muj_geom *geom, muj_view *out)
{
    double normal[3], offset = 0, length = 0, away;
    for (int c = 0; c < 3; c++) {
        normal[c] = geom->mat[3 * c + 2];
        length += normal[c] * normal[c];
    }
    for (int c = 0; c < 3; c++) {
        normal[c] /= sqrt(length);
        offset += normal[c] * (geom->pos[c] + (geom->type == E3D_MUJ_BOX ? geom->size[2] * normal[c] : 0));
    }
    *out = *view;
    for (int r = 0; r < 4; r++)
        mirror_row(out->rows[r], normal, offset);
    mirror_row(out->ahead, normal, offset);
    away = ((view->eye[0] * normal[0] + view->eye[1] * normal[1]) + view->eye[2] * normal[2]) - offset;
    for (int c = 0; c < 3; c++) {
        out->eye[c] -= 2 * away * normal[c];
        out->clip[c] = normal[c];
    }
    out->clip[3] = -offset;
    out->is_mirrored = out->has_clip = 1;
    out->tint = geom->reflectance;
    return away >= 0;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

static void make_unit(double a[3])
{
    double length = sqrt((a[0] * a[0] + a[1] * a[1]) + a[2] * a[2]);
    for (int c = 0; c < 3 && length > 0; c++)
        a[c] /= length;
}

void muj_set_light_view(const e3d_muj_frame *frame, const e3d_muj_light *light, muj_view *out)
{
    static const double LEFT[3] = {-1, 0, 0}, BACK[3] = {0, 1, 0};
    double axis[3][3], up[3], ahead[3] = {light->dir[0], light->dir[1], light->dir[2]};
    double inner = frame->shadow_size - 2, scale = 0.5 * inner / light->shadow_reach, middle = 1 + 0.5 * inner;
    cross(ahead, LEFT, up);
    if ((up[0] * up[0] + up[1] * up[1]) + up[2] * up[2] <= 0.01)
        cross(ahead, BACK, up);
    make_unit(ahead);
    cross(ahead, up, axis[0]);
    make_unit(axis[0]);
    cross(axis[0], ahead, axis[1]);
    memcpy(axis[2], ahead, sizeof ahead);
    memset(out, 0, sizeof *out);
    double row[3][4];
    for (int r = 0; r < 3; r++) {
        row[r][3] = 0;
        for (int c = 0; c < 3; c++) {
            row[r][c] = axis[r][c];
            row[r][3] -= axis[r][c] * light->pos[c];
        }
    }
    memcpy(out->ahead, row[2], sizeof out->ahead);
    set_depth_rows(frame, light->is_directional, out);
    for (int c = 0; c < 4; c++) {
        out->rows[0][c] = row[0][c] * scale + out->rows[3][c] * middle;
        out->rows[1][c] = row[1][c] * scale + out->rows[3][c] * middle;
    }
    out->high[0] = out->high[1] = frame->shadow_size - 1;
    out->samples = 1;
    out->first_sample = 128;
    out->guard = frame->shadow_size > MUJ_GUARD ? frame->shadow_size : MUJ_GUARD;
}
