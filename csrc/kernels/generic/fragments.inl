/* fragments: the samples that a cluster's small triangles cover, with their depths (R9, R10, R12-R14), a vector of triangles at
 * a time.
 *
 * Small is a box of at most 4 x 4 samples, and sides whose products 32 bits hold. Those of at most 2 x 2 are tried first: most of
 * them cover nothing. What is not small is left for records.
 */

enum { FRAGMENT_REACH = 16383 }; /* of 1/256 sample: edge functions stay below 2^31 four samples beyond the box */

/* Small triangles with samples in their boxes that face the right way: the tiny ones that cover samples, and the others, which may. */
typedef struct fragment_lists {
    uint8_t tiny[E3D_CLUSTER_TRIANGLES + E3D_PAD], cover[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    uint8_t small[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    int tinies, smalls;
} fragment_lists;

static inline vmask fragment_narrow(setup_span s, int32_t samples)
{
    return v_mnot(v_gti(v_subi(s.last, s.first), v_seti(samples - 1)));
}

/* As many lanes as there are elements left. */
static inline uint32_t fragment_tail(int left)
{
    return (uint32_t)((1ull << (left < V_LANES ? left : V_LANES)) - 1);
}

static inline void fragment_sort(const e3d_record_request *q, int first, fragment_lists *lists, e3d_fragments *out)
{
    vi32 x[3], y[3];
    const uint8_t *triangles = q->triangles + first;
    uint32_t asked = fragment_tail(q->count - first);
    for (int k = 0; k < 3; k++) {
        vi32 i = record_places(q->indices, triangles, k);
        x[k] = v_gatheri(q->vertices->sx, i);
        y[k] = v_gatheri(q->vertices->sy, i);
    }
    vi32 xlo = setup_min3(x[0], x[1], x[2]), xhi = setup_max3(x[0], x[1], x[2]);
    vi32 ylo = setup_min3(y[0], y[1], y[2]), yhi = setup_max3(y[0], y[1], y[2]);
    setup_span across = setup_samples(xlo, xhi, q->viewport->width);
    setup_span down = setup_samples(ylo, yhi, q->viewport->height);
    vmask large = v_gti(v_maxi(v_subi(xhi, xlo), v_subi(yhi, ylo)), v_seti(FRAGMENT_REACH));
    vmask small = v_mandnot(v_mand(fragment_narrow(across, E3D_SMALL), fragment_narrow(down, E3D_SMALL)), large);
    vmask tiny = v_mand(small, v_mand(fragment_narrow(across, 2), fragment_narrow(down, 2)));
    vmask empty = v_mor(v_gti(across.first, across.last), v_gti(down.first, down.last));
    vmask culled = v_mor(empty, setup_culled(setup_area(x, y), q->cull));
    uint32_t tinies = v_bits(v_mandnot(tiny, culled)) & asked;
    vi32 triangle = v_loadu8(triangles);
    out->rests += v_pack8(out->rest + out->rests, triangle, asked & ~v_bits(small));
    lists->smalls += v_pack8(lists->small + lists->smalls, triangle,
                             asked & v_bits(v_mandnot(v_mandnot(small, tiny), culled)));
    if (!tinies)
        return;
    vi32 cover = record_cover(x, y, across, down);
    tinies &= ~v_bits(v_eqi(cover, v_seti(0)));
    v_pack8(lists->cover + lists->tinies, cover, tinies);
    lists->tinies += v_pack8(lists->tiny + lists->tinies, triangle, tinies);
}

/* One vector of triangles, as their fragments need them. */
typedef struct fragment_vector {
    setup_span across, down;
    record_plane plane;
    vi32 id;
    uint32_t lanes; /* those whose plane is finite */
} fragment_vector;

static inline fragment_vector fragment_begin(const e3d_record_request *q, const e3d_fragment_ids *ids,
                                             const uint8_t *triangles, int count, record_corners *c)
{
    fragment_vector v;
    vmask finite;
    *c = record_fetch(q->vertices, q->indices, triangles);
    record_swap(c, v_negi(setup_area(c->x, c->y)));
    v.across = setup_samples(setup_min3(c->x[0], c->x[1], c->x[2]), setup_max3(c->x[0], c->x[1], c->x[2]),
                             q->viewport->width);
    v.down = setup_samples(setup_min3(c->y[0], c->y[1], c->y[2]), setup_max3(c->y[0], c->y[1], c->y[2]),
                           q->viewport->height);
    v.plane = record_plane_of(c, v.across, v.down, &finite);
    v.id = v_addi(v_seti(ids->id), v_muli(v_loadu8(triangles), v_seti(ids->step)));
    v.lanes = v_bits(finite) & fragment_tail(count);
    return v;
}

/* The fragments in the lanes of `bits`, at one sample of their boxes. */
static inline void fragment_add(const fragment_vector *v, int column, int row, uint32_t bits, int32_t tiles_x,
                                e3d_fragments *out)
{
    const record_plane *p = &v->plane;
    vf32 z = v_add(v_add(p->z0, v_mul(v_setf((float)column), p->gx)), v_mul(v_setf((float)row), p->gy));
    z = v_min(v_max(z, p->zmin), p->zmax);
    vi32 x = v_addi(v->across.first, v_seti(column)), y = v_addi(v->down.first, v_seti(row)), low = v_seti(E3D_TILE - 1);
    vi32 tile = v_addi(v_muli(v_sra(y, E3D_TILE_SHIFT), v_seti(tiles_x)), v_sra(x, E3D_TILE_SHIFT));
    vi32 place = v_ori(v_shl(v_andi(y, low), E3D_TILE_SHIFT), v_andi(x, low));
    v_pack(out->z + out->count, v_asi(z), bits);
    v_pack(out->id + out->count, v->id, bits);
    out->count += v_pack(out->place + out->count, v_ori(place, v_shl(tile, E3D_PLACE_BITS)), bits);
}

static inline void fragment_tiny(const e3d_record_request *q, const e3d_fragment_ids *ids, const fragment_lists *lists,
                                 int first, e3d_fragments *out)
{
    record_corners c;
    fragment_vector v = fragment_begin(q, ids, lists->tiny + first, lists->tinies - first, &c);
    vi32 cover = v_loadu8(lists->cover + first);
    out->triangles += __builtin_popcount(v.lanes);
    for (int sample = 0; sample < 4; sample++) {
        vi32 chosen = v_andi(cover, v_seti(1 << sample));
        uint32_t bits = v.lanes & ~v_bits(v_eqi(chosen, v_seti(0)));
        if (bits)
            fragment_add(&v, sample & 1, sample >> 1, bits, ids->tiles_x, out);
    }
}

static inline void fragment_small(const e3d_record_request *q, const e3d_fragment_ids *ids, const fragment_lists *lists,
                                  int first, e3d_fragments *out)
{
    record_corners c;
    record_edge e[3];
    fragment_vector v = fragment_begin(q, ids, lists->small + first, lists->smalls - first, &c);
    vi32 half = v_seti(128), zero = v_seti(0), wide = v_subi(v.across.last, v.across.first);
    vi32 high = v_subi(v.down.last, v.down.first), x0 = v_addi(v_shl(v.across.first, 8), half);
    vi32 y0 = v_addi(v_shl(v.down.first, 8), half);
    uint32_t any = 0;
    for (int k = 0; k < 3; k++)
        e[k] = record_edge_of(c.x, c.y, k, zero, x0, y0);
    for (int row = 0; row < E3D_SMALL; row++) {
        uint32_t rows = v.lanes & ~v_bits(v_gti(v_seti(row), high));
        if (!rows)
            break; /* all boxes are lower */
        vi32 at[3] = {e[0].c, e[1].c, e[2].c};
        for (int column = 0; column < E3D_SMALL; column++) {
            uint32_t columns = rows & ~v_bits(v_gti(v_seti(column), wide));
            if (!columns)
                break;
            uint32_t bits = columns & ~v_bits(v_negi(v_ori(v_ori(at[0], at[1]), at[2])));
            any |= bits;
            if (bits)
                fragment_add(&v, column, row, bits, ids->tiles_x, out);
            for (int k = 0; k < 3; k++)
                at[k] = v_addi(at[k], v_shl(e[k].a, 8));
        }
        for (int k = 0; k < 3; k++)
            e[k].c = v_addi(e[k].c, v_shl(e[k].b, 8));
    }
    out->triangles += __builtin_popcount(any);
}

static void kernel_fragments(const e3d_record_request *q, const e3d_fragment_ids *ids, e3d_fragments *out)
{
#ifdef E3D_NARROW_TABLE
    if (q->count <= V_LANES / 2) {
        E3D_NARROW_TABLE.fragments(q, ids, out);
        return;
    }
#endif
    fragment_lists lists;
    lists.tinies = lists.smalls = 0;
    out->count = out->triangles = out->rests = 0;
    for (int i = 0; i < q->count; i += V_LANES)
        fragment_sort(q, i, &lists, out);
    memset(lists.tiny + lists.tinies, 0, E3D_PAD); /* whole vectors are read */
    memset(lists.cover + lists.tinies, 0, E3D_PAD);
    memset(lists.small + lists.smalls, 0, E3D_PAD);
    memset(out->rest + out->rests, 0, E3D_PAD);
    for (int i = 0; i < lists.tinies; i += V_LANES)
        fragment_tiny(q, ids, &lists, i, out);
    for (int i = 0; i < lists.smalls; i += V_LANES)
        fragment_small(q, ids, &lists, i, out);
}
