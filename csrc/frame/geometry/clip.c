/* clip: the few primitives that cross the near plane, the eye's plane or the guard band (R5, R7), by Sutherland and Hodgman
 * (1974) in homogeneous space. A cut point is computed from the inside to the outside vertex, so that both triangles of an edge
 * get the same bits. */
#include "data/clip_planes.h"
#include "base/limits.h"
#include "frame/geometry/clip.h"

typedef struct exact_vertex {
    double v[4], c[3];
} exact_vertex;

static double distance(const exact_vertex *p, int plane, const e3d_viewport *viewport)
{
    return e3d_inside(p->v, plane, (double)E3D_W_MIN, (double)viewport->guard_x, (double)viewport->guard_y);
}

static exact_vertex cut(const exact_vertex *inside, const exact_vertex *outside, double di, double d_out)
{
    exact_vertex result;
    double t = di / (di - d_out);
    for (int k = 0; k < 4; k++)
        result.v[k] = inside->v[k] + (outside->v[k] - inside->v[k]) * t;
    for (int k = 0; k < 3; k++)
        result.c[k] = inside->c[k] + (outside->c[k] - inside->c[k]) * t;
    return result;
}

/* Clips the edges of a polygon (closed) or of a segment (not closed) at one plane. */
static int clip_plane(const exact_vertex *in, int count, int closed, int plane,
                      const e3d_viewport *viewport, exact_vertex *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const exact_vertex *a = &in[i], *b = &in[(i + 1) % count];
        double da = distance(a, plane, viewport), db = distance(b, plane, viewport);
        if (da >= 0)
            out[kept++] = *a;
        if ((closed || i + 1 < count) && (da >= 0) != (db >= 0))
            out[kept++] = da >= 0 ? cut(a, b, da, db) : cut(b, a, db, da);
    }
    return kept;
}

static int clip_all(exact_vertex *polygon, int count, int closed, const e3d_viewport *viewport,
                    e3d_clip_vertex *out)
{
    exact_vertex other[E3D_CLIP_MAX], *from = polygon, *to = other;
    for (int plane = 0; plane < E3D_CLIP_PLANES && count; plane++) {
        count = clip_plane(from, count, closed, plane, viewport, to);
        exact_vertex *swap = from;
        from = to;
        to = swap;
    }
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++)
            out[i].v[k] = (float)from[i].v[k];
        for (int k = 0; k < 3; k++)
            out[i].c[k] = (float)from[i].c[k];
    }
    return count;
}

static exact_vertex widen(const float v[4], int corner)
{
    exact_vertex e = {{v[0], v[1], v[2], v[3]}, {0, 0, 0}};
    e.c[corner] = 1;
    return e;
}

int e3d_clip_triangle(const float corner[3][4], const e3d_viewport *viewport,
                      e3d_clip_vertex out[E3D_CLIP_MAX])
{
    exact_vertex polygon[E3D_CLIP_MAX];
    for (int k = 0; k < 3; k++)
        polygon[k] = widen(corner[k], k);
    return clip_all(polygon, 3, 1, viewport, out);
}

int e3d_clip_line(const float end[2][4], const e3d_viewport *viewport, e3d_clip_vertex out[2])
{
    exact_vertex segment[E3D_CLIP_MAX];
    e3d_clip_vertex result[E3D_CLIP_MAX];
    segment[0] = widen(end[0], 0);
    segment[1] = widen(end[1], 1);
    int count = clip_all(segment, 2, 0, viewport, result);
    if (count < 2)
        return 0;
    out[0] = result[0];
    out[1] = result[1];
    return 2;
}

int e3d_outcode(const float v[4], const e3d_viewport *viewport)
{
    float x = v[0], y = v[1], z = v[2], w = v[3];
    float gx = viewport->guard_x * w, gy = viewport->guard_y * w;
    float none = ((x - x) + (y - y)) + ((z - z) + (w - w));
    return (z < -w ? E3D_NEAR : 0) | (z > w ? E3D_FAR : 0) | (x < -w ? E3D_LEFT : 0) |
           (x > w ? E3D_RIGHT : 0) | (y < -w ? E3D_BOTTOM : 0) | (y > w ? E3D_TOP : 0) |
           (w < E3D_W_MIN ? E3D_BEHIND : 0) |
           (x > gx || x < -gx || y > gy || y < -gy ? E3D_BEYOND_GUARD : 0) |
           (none == 0.0f ? 0 : E3D_NONFINITE);
}
