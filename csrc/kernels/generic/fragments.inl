/* fragments: finds the samples that small triangles cover, with their depths (R9, R10, R12-R14): a vector of triangles at a
 * time, then a vector of samples, then tile by tile. The stages are short loops over a batch. A single loop from corners to
 * tiles would not fit the out-of-order window: iterations would not overlap, and a city from above took 5 % longer. */
#pragma once

#include <string.h>

#include "base/limits.h"
#include "kernels/types/fragments.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/record.inl"

/* ---- triangles of a cluster ---- */

static inline void fragment_add_each(const e3d_vertices *v, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
                                     e3d_small_triangles *to)
{
    for (; triangles; triangles &= triangles - 1) {
        int32_t n = to->count++, triangle = __builtin_ctzll(triangles);
        for (int k = 0; k < 3; k++) {
            int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
            to->x[k][n] = v->sx[i];
            to->y[k][n] = v->sy[i];
            to->zn[k][n] = v->zn[i];
        }
        to->id[n] = first + (triangle << bits);
    }
}

/* Looks up the vertices of a vector of triangles in tables; lanes beyond the last triangle hold anything. */
static inline void fragment_add_vectors(const e3d_vertices *v, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
                                        e3d_small_triangles *to)
{
    int32_t list[E3D_CLUSTER_TRIANGLES + E3D_PAD], count = 0;
    vtable x, y, zn;
    for (int i = 0; i < E3D_CLUSTER_TRIANGLES; i += V_LANES)
        count += v_pack(list + count, v_addi(v_iota(), v_seti(i)), (uint32_t)(triangles >> i) & setup_tail(V_LANES));
    v_table(v->sx, v->count, &x);
    v_table(v->sy, v->count, &y);
    v_table(v->zn, v->count, &zn);
    for (int i = 0, n = to->count; i < count; i += V_LANES, n += V_LANES) {
        vi32 triangle = v_loadi(list + i);
        for (int k = 0; k < 3; k++) {
            vi32 at = v_lookup8(indices + k * E3D_CLUSTER_TRIANGLES, triangle);
            v_storei(to->x[k] + n, v_lookup(&x, at));
            v_storei(to->y[k] + n, v_lookup(&y, at));
            v_storei(to->zn[k] + n, v_lookup(&zn, at));
        }
        v_storei(to->id + n, v_addi(v_seti(first), v_muli(triangle, v_seti(1 << bits))));
    }
    to->count += count;
}

/* Vectors are faster only if the tables lie in registers; a lookup there needs no valid index, either. */
static void kernel_add_small(const e3d_vertices *v, const uint8_t *indices, uint64_t triangles, int32_t first, int bits,
                             e3d_small_triangles *to)
{
    if (V_LANES < 16)
        fragment_add_each(v, indices, triangles, first, bits, to);
    else
        fragment_add_vectors(v, indices, triangles, first, bits, to);
}

/* ---- which triangles cover samples ---- */

/* Appends the lanes of `bits` of one vector to a list. This may be the list that they come from, if that is no longer than
 * what was read. */
static inline void fragment_move(const e3d_small_triangles *from, int first, uint32_t bits, e3d_small_triangles *to)
{
    int at = to->count;
    for (int k = 0; k < 3; k++) {
        v_pack(to->x[k] + at, v_loadi(from->x[k] + first), bits);
        v_pack(to->y[k] + at, v_loadi(from->y[k] + first), bits);
        v_pack(to->zn[k] + at, v_asi(v_loadf(from->zn[k] + first)), bits);
    }
    to->count += v_pack(to->id + at, v_loadi(from->id + first), bits);
}

/* Sorts a vector of triangles: tiny ones (2 x 2 samples) that cover a sample go to the front, with their cover; others go to
 * `wide`. */
static inline void fragment_sort(e3d_small_triangles *triangles, int first, int left, const e3d_viewport *viewport,
                                 uint8_t *covers, e3d_small_triangles *wide)
{
    vi32 x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = v_loadi(triangles->x[k] + first);
        y[k] = v_loadi(triangles->y[k] + first);
    }
    setup_span across = setup_box(x, viewport->width, 0), down = setup_box(y, viewport->height, 0);
    uint32_t tinies = v_bits(v_mand(setup_narrow(across, 2), setup_narrow(down, 2))), asked = setup_tail(left);
    if (asked & ~tinies)
        fragment_move(triangles, first, asked & ~tinies, wide);
    vi32 cover = record_cover(x, y, across, down);
    tinies &= asked & ~v_bits(v_eqi(cover, v_seti(0)));
    v_pack8(covers + triangles->count, cover, tinies);
    fragment_move(triangles, first, tinies, triangles);
}

/* ---- vectors of triangles, and which samples they cover ---- */

/* A vector of triangles, and the places of their covered samples. A place is a byte: the triangle's lane, and the column and
 * row in its box. */
enum { FRAGMENT_COLUMN = 4,
       FRAGMENT_ROW = 6 };
typedef struct fragment_vector {
    vi32 x, y, id; /* first sample of the box */
    record_plane plane;
    int places;
    uint8_t place[V_LANES * E3D_SMALL * E3D_SMALL + E3D_PAD];
} fragment_vector;

/* A vector of triangles with a positive area (R9), and their boxes. */
typedef struct fragment_corners {
    record_corners at;
    setup_span across, down;
} fragment_corners;

/* Loads a vector of triangles and finds their planes; returns the lanes whose plane is finite. */
static inline uint32_t fragment_begin(const e3d_small_triangles *triangles, int first, const e3d_viewport *viewport,
                                      fragment_corners *c, fragment_vector *v)
{
    vmask finite;
    for (int k = 0; k < 3; k++) {
        c->at.x[k] = v_loadi(triangles->x[k] + first);
        c->at.y[k] = v_loadi(triangles->y[k] + first);
        c->at.zn[k] = c->at.iw[k] = v_loadf(triangles->zn[k] + first);
    }
    record_swap(&c->at, v_negi(setup_area(c->at.x, c->at.y)));
    c->across = setup_box(c->at.x, viewport->width, 0);
    c->down = setup_box(c->at.y, viewport->height, 0);
    v->plane = record_plane_of(&c->at, c->across, c->down, &finite);
    v->x = c->across.first;
    v->y = c->down.first;
    v->id = v_loadi(triangles->id + first);
    v->places = 0;
    return v_bits(finite) & setup_tail(triangles->count - first);
}

/* The place of a sample. Places are listed triangle by triangle, so that shading meets each triangle once. */
static inline vi32 fragment_place(vi32 lane, vi32 column, vi32 row)
{
    return v_ori(lane, v_ori(v_shl(column, FRAGMENT_COLUMN), v_shl(row, FRAGMENT_ROW)));
}

/* Packs eight numbers below 16 into the nibbles of a word. */
static inline uint32_t fragment_nibbles(const uint8_t bytes[8])
{
    uint64_t b;
    memcpy(&b, bytes, 8);
    b = (b | b >> 4) & 0x00FF00FF00FF00FF;
    b = (b | b >> 8) & 0x0000FFFF0000FFFF;
    return (uint32_t)(b | b >> 16);
}

/* Lists the places of tiny triangles; returns how many triangles have some. */
static inline int fragment_tiny(const e3d_small_triangles *triangles, uint8_t *covers, const e3d_viewport *viewport,
                                fragment_vector *vectors)
{
    int some = 0;
    for (int first = 0; first < triangles->count; first += V_LANES, vectors++) {
        fragment_corners c;
        uint32_t lanes = fragment_begin(triangles, first, viewport, &c, vectors);
        some += __builtin_popcount(lanes);
        for (uint32_t left = setup_tail(V_LANES) & ~lanes; left; left &= left - 1)
            covers[first + __builtin_ctz(left)] = 0;
        uint64_t samples = fragment_nibbles(covers + first);
        if (V_LANES > 8)
            samples |= (uint64_t)fragment_nibbles(covers + first + 8) << 32;
        for (int i = 0; i < 4 * V_LANES; i += V_LANES) {
            vi32 at = v_addi(v_iota(), v_seti(i)), one = v_seti(1);
            vi32 place = fragment_place(v_shr(at, 2), v_andi(at, one), v_andi(v_shr(at, 1), one));
            vectors->places += v_pack8(vectors->place + vectors->places, place, (uint32_t)(samples >> i) & setup_tail(V_LANES));
        }
    }
    return some;
}

/* The samples of its box that each lane's triangle covers (R12): bit 4 * row + column. */
static inline vi32 fragment_cover(const fragment_corners *c)
{
    record_edge e[3];
    vi32 half = v_seti(128), zero = v_seti(0), cover = zero, wide = v_subi(c->across.last, c->across.first);
    vi32 high = v_subi(c->down.last, c->down.first), x0 = v_addi(v_shl(c->across.first, 8), half);
    vi32 y0 = v_addi(v_shl(c->down.first, 8), half);
    for (int k = 0; k < 3; k++)
        e[k] = record_edge_of(c->at.x, c->at.y, k, zero, x0, y0);
    for (int row = 0; row < E3D_SMALL; row++) {
        vmask below = v_gti(v_seti(row), high);
        vi32 at[3] = {e[0].c, e[1].c, e[2].c};
        for (int column = 0; column < E3D_SMALL; column++) {
            vmask out = v_mor(v_mor(below, v_gti(v_seti(column), wide)), v_negi(v_ori(v_ori(at[0], at[1]), at[2])));
            cover = v_ori(cover, v_seli(out, zero, v_seti(1 << (E3D_SMALL * row + column))));
            for (int k = 0; k < 3; k++)
                at[k] = v_addi(at[k], v_shl(e[k].a, 8));
        }
        for (int k = 0; k < 3; k++)
            e[k].c = v_addi(e[k].c, v_shl(e[k].b, 8));
    }
    return cover;
}

/* Lists the places of a vector of triangles; returns the lanes that have some. */
static inline uint32_t fragment_list_wide(const fragment_corners *c, uint32_t lanes, fragment_vector *v)
{
    int32_t covers[V_LANES];
    vi32 cover = fragment_cover(c);
    v_storei(covers, cover);
    lanes &= ~v_bits(v_eqi(cover, v_seti(0)));
    for (uint32_t left = lanes; left; left &= left - 1) {
        int lane = __builtin_ctz(left);
        for (int i = 0; i < E3D_SMALL * E3D_SMALL; i += V_LANES) {
            vi32 at = v_addi(v_iota(), v_seti(i)), low = v_seti(E3D_SMALL - 1);
            vi32 place = fragment_place(v_seti(lane), v_andi(at, low), v_shr(at, 2));
            v->places += v_pack8(v->place + v->places, place, (uint32_t)covers[lane] >> i & setup_tail(V_LANES));
        }
    }
    return lanes;
}

static inline int fragment_wide(const e3d_small_triangles *triangles, const e3d_viewport *viewport, fragment_vector *vectors)
{
    int some = 0;
    for (int first = 0; first < triangles->count; first += V_LANES, vectors++) {
        fragment_corners c;
        uint32_t lanes = fragment_begin(triangles, first, viewport, &c, vectors);
        some += __builtin_popcount(fragment_list_wide(&c, lanes, vectors));
    }
    return some;
}

/* ---- fragments, not yet sorted by tile ---- */

enum { FRAGMENT_MANY = 512,
       FRAGMENT_ROOM = FRAGMENT_MANY + V_LANES * E3D_SMALL * E3D_SMALL + E3D_PAD };
typedef struct fragment_buffer {
    float z[FRAGMENT_ROOM];
    int32_t id[FRAGMENT_ROOM], at[FRAGMENT_ROOM]; /* at: number of the tile * E3D_TILE_SAMPLES + sample in it */
    int count;
} fragment_buffer;

/* Makes the fragments of the first `count` places of a vector (R14). */
static inline void fragment_make(const fragment_vector *v, vi32 place, int count, int32_t tiles_x, fragment_buffer *out)
{
    const record_plane *p = &v->plane;
    vi32 low = v_seti(E3D_TILE - 1), column = v_andi(v_shr(place, FRAGMENT_COLUMN), v_seti(E3D_SMALL - 1));
    vi32 row = v_shr(place, FRAGMENT_ROW);
    vpick lane = v_picker(v_andi(place, v_seti(V_LANES - 1)));
    vf32 z = v_add(v_pick(&p->z0, lane), v_mul(v_float(column), v_pick(&p->gx, lane)));
    z = v_add(z, v_mul(v_float(row), v_pick(&p->gy, lane)));
    z = v_min(v_max(z, v_pick(&p->zmin, lane)), v_pick(&p->zmax, lane));
    vi32 x = v_addi(v_asi(v_pick(&v->x, lane)), column), y = v_addi(v_asi(v_pick(&v->y, lane)), row);
    vi32 tile = v_addi(v_muli(v_sra(y, E3D_TILE_SHIFT), v_seti(tiles_x)), v_sra(x, E3D_TILE_SHIFT));
    vi32 sample = v_ori(v_shl(v_andi(y, low), E3D_TILE_SHIFT), v_andi(x, low));
    v_storef(out->z + out->count, z);
    v_storei(out->id + out->count, v_asi(v_pick(&v->id, lane)));
    v_storei(out->at + out->count, v_ori(v_shl(tile, 2 * E3D_TILE_SHIFT), sample));
    out->count += count;
}

/* ---- to their tiles ---- */

/* Returns the tile's last link, or a new one, with room for a vector. */
static inline e3d_fragment_link *fragment_link(e3d_fragment_bins *out, int32_t tile)
{
    e3d_bin *bin = &out->bins[tile];
    if (bin->last != E3D_NO_LINK && out->links[bin->last].count <= E3D_LINK_FRAGMENTS - V_LANES)
        return &out->links[bin->last];
    e3d_fragment_link *link = &out->links[out->count];
    /* Prefetched for writing, since it is in no cache and would be fetched line by line as it fills */
    for (size_t at = 0; at < sizeof *link; at += 64)
        __builtin_prefetch((const char *)link + at, 1);
    link->next = E3D_NO_LINK;
    link->count = 0;
    *(bin->last == E3D_NO_LINK ? &bin->first : &out->links[bin->last].next) = out->count;
    bin->last = out->count++;
    return link;
}

/* Moves the fragments of one tile, in the vectors from `first` on, to its list, and removes them from `left`. */
static inline void fragment_bin(const fragment_buffer *from, int first, int32_t tile, uint32_t *left, e3d_fragment_bins *out)
{
    e3d_fragment_link *link = fragment_link(out, tile);
    uint32_t count = link->count;
    for (int i = first; i * V_LANES < from->count; i++) {
        vi32 at = v_loadi(from->at + i * V_LANES);
        uint32_t here = left[i] & v_bits(v_eqi(v_shr(at, 2 * E3D_TILE_SHIFT), v_seti(tile)));
        if (!here)
            continue;
        if (count > E3D_LINK_FRAGMENTS - V_LANES) {
            link->count = count;
            link = fragment_link(out, tile);
            count = 0;
        }
        v_pack(link->z + count, v_asi(v_loadf(from->z + i * V_LANES)), here);
        v_pack(link->id + count, v_loadi(from->id + i * V_LANES), here);
        count += (uint32_t)v_pack16(link->sample + count, v_andi(at, v_seti(E3D_TILE_SAMPLES - 1)), here);
        left[i] &= ~here;
    }
    link->count = count;
}

static inline void fragment_bin_all(fragment_buffer *from, e3d_fragment_bins *out)
{
    uint32_t left[FRAGMENT_ROOM / V_LANES];
    for (int i = 0; i * V_LANES < from->count; i++)
        left[i] = setup_tail(from->count - i * V_LANES);
    for (int i = 0; i * V_LANES < from->count; i++)
        while (left[i]) {
            uint32_t at = (uint32_t)from->at[i * V_LANES + __builtin_ctz(left[i])];
            fragment_bin(from, i, (int32_t)(at >> (2 * E3D_TILE_SHIFT)), left, out);
        }
    out->fragments += from->count;
    from->count = 0;
}

/* ---- all ---- */

/* Makes fragments of vectors of triangles, and sorts them by tile whenever many have gathered. */
static inline void fragment_finish(const fragment_vector *vectors, int triangles, int32_t tiles_x, fragment_buffer *buffer,
                                   e3d_fragment_bins *out)
{
    for (int first = 0; first < triangles; first += V_LANES, vectors++) {
        for (int i = 0, left = vectors->places; left > 0; i += V_LANES, left -= V_LANES)
            fragment_make(vectors, v_loadu8(vectors->place + i), left < V_LANES ? left : V_LANES, tiles_x, buffer);
        if (buffer->count >= FRAGMENT_MANY)
            fragment_bin_all(buffer, out);
    }
}

static void kernel_fragments(e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out)
{
    _Alignas(64) e3d_small_triangles wide;
    fragment_vector vectors[E3D_SMALLS / V_LANES];
    _Alignas(64) fragment_buffer buffer;
    uint8_t covers[E3D_SMALLS + E3D_PAD];
    int count = triangles->count;
    wide.count = triangles->count = buffer.count = out->fragments = 0;
    for (int i = 0; i < count; i += V_LANES)
        fragment_sort(triangles, i, count - i, viewport, covers, &wide);
    out->triangles = fragment_tiny(triangles, covers, viewport, vectors);
    fragment_finish(vectors, triangles->count, tiles_x, &buffer, out);
    out->triangles += fragment_wide(&wide, viewport, vectors);
    fragment_finish(vectors, wide.count, tiles_x, &buffer, out);
    fragment_bin_all(&buffer, out);
    triangles->count = 0;
}
