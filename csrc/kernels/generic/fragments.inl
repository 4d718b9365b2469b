/* fragments: the samples that small triangles cover, with their depths (R9, R10, R12-R14), a vector of triangles at a time.
 *
 * Those with boxes of at most 2 x 2 samples are tried first: most of them cover nothing.
 */

/* The lanes of `bits` of one vector, to the end of a list, which may be the same: it then is not longer than what was read. */
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

/* The tiny ones that cover samples to the front, with their cover; those that aren't tiny to another list. */
static inline void fragment_sort(e3d_small_triangles *triangles, int first, int left, const e3d_viewport *viewport,
                                 uint8_t *covers, e3d_small_triangles *wide)
{
    vi32 x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = v_loadi(triangles->x[k] + first);
        y[k] = v_loadi(triangles->y[k] + first);
    }
    setup_span across = setup_samples(setup_min3(x[0], x[1], x[2]), setup_max3(x[0], x[1], x[2]), viewport->width);
    setup_span down = setup_samples(setup_min3(y[0], y[1], y[2]), setup_max3(y[0], y[1], y[2]), viewport->height);
    uint32_t tinies = v_bits(v_mand(setup_narrow(across, 2), setup_narrow(down, 2))), asked = setup_tail(left);
    if (asked & ~tinies)
        fragment_move(triangles, first, asked & ~tinies, wide);
    vi32 cover = record_cover(x, y, across, down);
    tinies &= asked & ~v_bits(v_eqi(cover, v_seti(0)));
    v_pack8(covers + triangles->count, cover, tinies);
    fragment_move(triangles, first, tinies, triangles);
}

/* One vector of triangles, as their fragments need them. */
typedef struct fragment_vector {
    setup_span across, down;
    record_plane plane;
    vi32 id;
    uint32_t lanes; /* those whose plane is finite */
} fragment_vector;

static inline fragment_vector fragment_begin(const e3d_small_triangles *triangles, int first,
                                             const e3d_viewport *viewport, record_corners *c)
{
    fragment_vector v;
    vmask finite;
    for (int k = 0; k < 3; k++) {
        c->x[k] = v_loadi(triangles->x[k] + first);
        c->y[k] = v_loadi(triangles->y[k] + first);
        c->zn[k] = c->iw[k] = v_loadf(triangles->zn[k] + first);
    }
    record_swap(c, v_negi(setup_area(c->x, c->y)));
    v.across = setup_samples(setup_min3(c->x[0], c->x[1], c->x[2]), setup_max3(c->x[0], c->x[1], c->x[2]),
                             viewport->width);
    v.down = setup_samples(setup_min3(c->y[0], c->y[1], c->y[2]), setup_max3(c->y[0], c->y[1], c->y[2]),
                           viewport->height);
    v.plane = record_plane_of(c, v.across, v.down, &finite);
    v.id = v_loadi(triangles->id + first);
    v.lanes = v_bits(finite) & setup_tail(triangles->count - first);
    return v;
}

/* The tile's last block, with room for a vector. */
static inline e3d_fragment_block *fragment_block(e3d_fragment_bins *out, int32_t tile)
{
    e3d_bin *bin = &out->bins[tile];
    if (bin->last != E3D_NO_BLOCK && out->blocks[bin->last].count <= E3D_BLOCK_FRAGMENTS - V_LANES)
        return &out->blocks[bin->last];
    e3d_fragment_block *block = &out->blocks[out->count];
    for (size_t at = 0; at < sizeof *block; at += 64) /* in no cache yet */
        __builtin_prefetch((const char *)block + at, 1);
    block->next = E3D_NO_BLOCK;
    block->count = 0;
    *(bin->last == E3D_NO_BLOCK ? &bin->first : &out->blocks[bin->last].next) = out->count;
    bin->last = out->count++;
    return block;
}

/* The fragments in the lanes of `bits` to the tiles that they lie in, which mostly is one. */
static inline void fragment_bin(vf32 z, vi32 id, vi32 tile, vi32 sample, uint32_t bits, e3d_fragment_bins *out)
{
    int32_t tiles[V_LANES];
    v_storei(tiles, tile);
    out->fragments += __builtin_popcount(bits);
    while (bits) {
        int32_t one = tiles[__builtin_ctz(bits)];
        uint32_t here = bits & v_bits(v_eqi(tile, v_seti(one)));
        e3d_fragment_block *block = fragment_block(out, one);
        uint32_t count = block->count;
        v_pack(block->z + count, v_asi(z), here);
        v_pack(block->id + count, id, here);
        block->count = count + (uint32_t)v_pack16(block->sample + count, sample, here);
        bits &= ~here;
    }
}

/* The fragments in the lanes of `bits`, at one sample of their boxes. */
static inline void fragment_add(const fragment_vector *v, int column, int row, uint32_t bits, int32_t tiles_x,
                                e3d_fragment_bins *out)
{
    const record_plane *p = &v->plane;
    vf32 z = v_add(v_add(p->z0, v_mul(v_setf((float)column), p->gx)), v_mul(v_setf((float)row), p->gy));
    z = v_min(v_max(z, p->zmin), p->zmax);
    vi32 x = v_addi(v->across.first, v_seti(column)), y = v_addi(v->down.first, v_seti(row)), low = v_seti(E3D_TILE - 1);
    vi32 tile = v_addi(v_muli(v_sra(y, E3D_TILE_SHIFT), v_seti(tiles_x)), v_sra(x, E3D_TILE_SHIFT));
    vi32 sample = v_ori(v_shl(v_andi(y, low), E3D_TILE_SHIFT), v_andi(x, low));
    fragment_bin(z, v->id, tile, sample, bits, out);
}

static inline void fragment_tiny(const e3d_small_triangles *triangles, int first, const uint8_t *covers,
                                 const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out)
{
    record_corners c;
    fragment_vector v = fragment_begin(triangles, first, viewport, &c);
    vi32 cover = v_loadu8(covers + first);
    out->triangles += __builtin_popcount(v.lanes);
    for (int sample = 0; sample < 4; sample++) {
        vi32 chosen = v_andi(cover, v_seti(1 << sample));
        uint32_t bits = v.lanes & ~v_bits(v_eqi(chosen, v_seti(0)));
        if (bits)
            fragment_add(&v, sample & 1, sample >> 1, bits, tiles_x, out);
    }
}

static inline void fragment_wide(const e3d_small_triangles *triangles, int first, const e3d_viewport *viewport, int tiles_x,
                                 e3d_fragment_bins *out)
{
    record_corners c;
    record_edge e[3];
    fragment_vector v = fragment_begin(triangles, first, viewport, &c);
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
                fragment_add(&v, column, row, bits, tiles_x, out);
            for (int k = 0; k < 3; k++)
                at[k] = v_addi(at[k], v_shl(e[k].a, 8));
        }
        for (int k = 0; k < 3; k++)
            e[k].c = v_addi(e[k].c, v_shl(e[k].b, 8));
    }
    out->triangles += __builtin_popcount(any);
}

static void kernel_fragments(e3d_small_triangles *triangles, const e3d_viewport *viewport, int tiles_x, e3d_fragment_bins *out)
{
    e3d_small_triangles wide;
    uint8_t covers[E3D_SMALLS + E3D_PAD];
    int count = triangles->count;
    wide.count = triangles->count = out->fragments = out->triangles = 0;
    for (int i = 0; i < count; i += V_LANES)
        fragment_sort(triangles, i, count - i, viewport, covers, &wide);
    for (int i = 0; i < triangles->count; i += V_LANES)
        fragment_tiny(triangles, i, covers, viewport, tiles_x, out);
    for (int i = 0; i < wide.count; i += V_LANES)
        fragment_wide(&wide, i, viewport, tiles_x, out);
    triangles->count = 0;
}
