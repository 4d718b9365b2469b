/* apertures: finds where a picture may show backs of objects that enclose a volume, because one looks into their holes (R9).
 * A ray from outside enters such a volume before it leaves it: it meets a front first, unless it enters through a hole. So a
 * back may show only where the fan of triangles that would close a hole faces the viewer; an aperture is the box of these
 * triangles on the screen.
 * In: what is drawn, and from where. Out: apertures, in pixels.
 * Always: f64; a triangle that rounding or snapping might turn to the viewer counts as facing him. */
#include <math.h>

#include "base/fpenv.h"
#include "data/mesh/mesh.h"
#include "e3d_scene.h"
#include "e3d_apertures.h"

/* Points nearer to a plane than this share of their coordinates don't surely lie before it. */
#define LEAST 1e-6
/* A bound, with a wide margin, of how far snapping moves a corner along an axis, in pixels. */
#define SNAPS (1.0 / 64)

/* A point lies before a plane if plane[0..2] . point + plane[3] > 0. */
static int is_before(const double plane[4], double x, double y, double z)
{
    double rise = ((plane[0] * x + plane[1] * y) + plane[2] * z) + plane[3];
    double size = ((fabs(plane[0] * x) + fabs(plane[1] * y)) + fabs(plane[2] * z)) + fabs(plane[3]);
    return rise > LEAST * size;
}

static int box_is_before(const double plane[4], const double low[3], const double high[3])
{
    double at[3];
    for (int k = 0; k < 3; k++)
        at[k] = plane[k] > 0 ? low[k] : high[k];
    return is_before(plane, at[0], at[1], at[2]);
}

static int cluster_is_before(const double plane[4], const e3d_cluster *cluster)
{
    const float *x = cluster->positions, *y = x + cluster->stride, *z = y + cluster->stride;
    const double low[3] = {cluster->lo[0], cluster->lo[1], cluster->lo[2]}, high[3] = {cluster->hi[0], cluster->hi[1], cluster->hi[2]};
    if (!cluster->any_finite || box_is_before(plane, low, high))
        return 1;
    for (int i = 0; i < cluster->vertices; i++)
        if (!is_before(plane, x[i], y[i], z[i]))
            return 0;
    return 1;
}

/* Whether everything that a node draws lies before the near plane. */
static int node_is_before(const double clip_from_world[16], const double *bounds, const e3d_draw *draw, const double world[12])
{
    double plane[4], own[4];
    for (int c = 0; c < 4; c++)
        plane[c] = clip_from_world[8 + c] + clip_from_world[12 + c];
    if (bounds[0] > bounds[3] || box_is_before(plane, bounds, bounds + 3))
        return 1;
    if (draw->pose_kind != E3D_POSE_NONE)
        return 0; /* each instance would need a test of its own */
    for (int c = 0; c < 4; c++)
        own[c] = ((plane[0] * world[c] + plane[1] * world[4 + c]) + plane[2] * world[8 + c]) + (c == 3 ? plane[3] : 0);
    for (int32_t i = 0; i < draw->mesh->cluster_count; i++)
        if (!cluster_is_before(own, &draw->mesh->clusters[i]))
            return 0;
    return 1;
}

/* ---- holes ---- */

static double determinant(const double *a, const double *b, const double *c)
{
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The projection of a node's points into the picture: x and y in pixels, y down, times w; and w. */
typedef struct projection {
    double row[3][4];
    int mirrored; /* fronts turn the other way on the screen */
} projection;

static projection projection_of(const e3d_looking *looking, const double world[12])
{
    const double *clip = looking->clip_from_world, *view = looking->view_from_world;
    const double half_w = 0.5 * looking->width, half_h = 0.5 * looking->height;
    double row[3][4];
    projection p;
    for (int c = 0; c < 4; c++) {
        row[0][c] = half_w * (clip[c] + clip[12 + c]);
        row[1][c] = half_h * (clip[12 + c] - clip[4 + c]);
        row[2][c] = clip[12 + c];
    }
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            p.row[r][c] =
                ((row[r][0] * world[c] + row[r][1] * world[4 + c]) + row[r][2] * world[8 + c]) + (c == 3 ? row[r][3] : 0);
    p.mirrored = (determinant(world, world + 4, world + 8) < 0) != (determinant(view, view + 4, view + 8) < 0);
    return p;
}

typedef struct pixel {
    double x, y;
} pixel;

static pixel project(const projection *p, const double at[3])
{
    double v[3];
    for (int r = 0; r < 3; r++)
        v[r] = ((p->row[r][0] * at[0] + p->row[r][1] * at[1]) + p->row[r][2] * at[2]) + p->row[r][3];
    return (pixel){v[0] / v[2], v[1] / v[2]};
}

/* Whether a triangle faces the viewer, or snapping might make it do so. */
static int may_face(pixel a, pixel b, pixel c, int mirrored)
{
    double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    double area = (bx * cy - cx * by) * (mirrored ? 1 : -1); /* y is down */
    return !(area < -SNAPS * (((fabs(bx) + fabs(by)) + (fabs(cx) + fabs(cy))) + 1));
}

/* A box of pixels that grows; it is empty if low is above high. */
typedef struct extent {
    double low_x, low_y, high_x, high_y;
} extent;

static void extend(extent *e, pixel p)
{
    e->low_x = fmin(e->low_x, p.x);
    e->low_y = fmin(e->low_y, p.y);
    e->high_x = fmax(e->high_x, p.x);
    e->high_y = fmax(e->high_y, p.y);
}

/* The box of a fan's triangles that may face the viewer. The fan goes from the middle of a hole to its rim. */
static extent open_extent(const projection *p, const double *rim, int32_t count)
{
    extent open = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    double middle[3] = {0, 0, 0};
    for (int32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            middle[k] += rim[3 * i + k];
    for (int k = 0; k < 3; k++)
        middle[k] /= count;
    const pixel centre = project(p, middle);
    pixel before = project(p, rim + 3 * (count - 1));
    for (int32_t i = 0; i < count; i++) {
        const pixel at = project(p, rim + 3 * i);
        if (may_face(at, before, centre, p->mirrored)) { /* sides of the fan run against those of the triangles beside the hole */
            extend(&open, at);
            extend(&open, before);
            extend(&open, centre);
        }
        before = at;
    }
    return open;
}

static double within(double v, double low, double high)
{
    if (v < low)
        return low;
    return v < high ? v : high;
}

/* Finds the pixels of an extent, and one more on each side; 0 if none is in the picture. */
static int aperture_of(const extent *e, const e3d_looking *looking, e3d_aperture *aperture)
{
    const double right = looking->width - 1, bottom = looking->height - 1;
    if (!(e->low_x <= right + 1) || !(e->low_y <= bottom + 1) || !(e->high_x >= -1) || !(e->high_y >= -1))
        return 0;
    *aperture = (e3d_aperture){(int32_t)within(floor(e->low_x) - 1, 0, right), (int32_t)within(floor(e->low_y) - 1, 0, bottom),
                               (int32_t)within(ceil(e->high_x) + 1, 0, right), (int32_t)within(ceil(e->high_y) + 1, 0, bottom)};
    return 1;
}

/* Adds an aperture; if there is no room, the last one grows to include it. */
static int32_t add_aperture(e3d_aperture apertures[E3D_MAX_APERTURES], int32_t count, e3d_aperture aperture)
{
    if (count < E3D_MAX_APERTURES) {
        apertures[count] = aperture;
        return count + 1;
    }
    e3d_aperture *last = &apertures[count - 1];
    last->x0 = aperture.x0 < last->x0 ? aperture.x0 : last->x0;
    last->y0 = aperture.y0 < last->y0 ? aperture.y0 : last->y0;
    last->x1 = aperture.x1 > last->x1 ? aperture.x1 : last->x1;
    last->y1 = aperture.y1 > last->y1 ? aperture.y1 : last->y1;
    return count;
}

static int32_t add_holes(const e3d_placed *object, const e3d_looking *looking, const double world[12],
                         e3d_aperture apertures[E3D_MAX_APERTURES], int32_t count)
{
    const projection p = projection_of(looking, world);
    for (int32_t hole = 0, first = 0; hole < object->holes; first = object->rim_ends[hole++]) {
        const extent open = open_extent(&p, object->rims + 3 * (size_t)first, object->rim_ends[hole] - first);
        e3d_aperture aperture;
        if (aperture_of(&open, looking, &aperture))
            count = add_aperture(apertures, count, aperture);
    }
    return count;
}

int32_t e3d_find_apertures(const e3d_draw_list *list, const e3d_node_rows *rows, const double *bounds, const e3d_placed *objects,
                           const e3d_looking *looking, e3d_aperture apertures[E3D_MAX_APERTURES])
{
    const e3d_fpenv saved = e3d_fpenv_enter();
    int32_t count = 0;
    for (int32_t i = 0; i < list->nodes && count >= 0; i++) {
        const int32_t slot = list->slots[i];
        const e3d_placed *object = &objects[rows->object[slot]];
        if (!object->encloses)
            continue;
        const double *world = e3d_placing_pose(rows->world, rows->anchor, slot);
        if (node_is_before(looking->clip_from_world, bounds + E3D_BOX * (size_t)slot, &object->draw, world))
            count = add_holes(object, looking, world, apertures, count);
        else
            count = -1;
    }
    e3d_fpenv_leave(saved);
    return count;
}
