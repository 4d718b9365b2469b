/* Fragments on vectors: what is interpolated, texels, fog, codes (R259, R263, R264, R267). */

#define MUJ_PART(member) (int)(offsetof(muj_face, member) / sizeof(float))

enum { FACE_BLOCK = 8,
       FACE_BLOCKS = (sizeof(muj_face) / sizeof(float) + FACE_BLOCK - 1) / FACE_BLOCK };

/* The faces of a vector's fragments: one for all, or one each, whose numbers are turned to columns. */
typedef struct face_view {
    const float *one;               /* NULL: one each */
    vi32 column[FACE_BLOCK * FACE_BLOCKS];
} face_view;

static ALWAYS_INLINE vf32 part_at(const face_view *view, int number)
{
    return view->one ? v_setf(view->one[number]) : v_asf(view->column[number]);
}

/* The first numbers of faces that a batch's fragments need. */
static inline int count_parts(const muj_batch *batch)
{
    if (batch->needs_place)
        return muj_color_at(batch->passes);
    if (batch->fog)
        return MUJ_PART(place);
    if (batch->needs_alpha)
        return MUJ_PART(ahead);
    return batch->texture ? MUJ_PART(alpha) : MUJ_PART(coordinates);
}

static ALWAYS_INLINE void load_faces(const muj_batch *batch, int i, int count, face_view *out)
{
    const void *row[V_LANES];
    for (int l = 0; l < V_LANES; l++)
        row[l] = batch->faces + batch->face[i + l];
    for (int at = 0; at < count; at += FACE_BLOCK) {
        v_load_rows(row, out->column + at);
        for (int l = 0; l < V_LANES; l++)
            row[l] = (const float *)row[l] + FACE_BLOCK;
    }
}

static ALWAYS_INLINE void parts_at(const face_view *view, int number, int count, vf32 *out)
{
    for (int k = 0; k < count; k++)
        out[k] = part_at(view, number + k);
}

static ALWAYS_INLINE vf32 mixed(const vf32 weight[3], const vf32 corner[3])
{
    return v_add(v_add(v_mul(weight[0], corner[0]), v_mul(weight[1], corner[1])), v_mul(weight[2], corner[2]));
}

static ALWAYS_INLINE vf32 mixed_part(const face_view *view, const vf32 weight[3], int number)
{
    vf32 corner[3];
    parts_at(view, number, 3, corner);
    return mixed(weight, corner);
}

/* slopes: base, across, down. The weights of the corners; of a triangle seen from the side, they may be no numbers. */
static ALWAYS_INLINE void weigh(const vf32 slopes[9], vf32 x, vf32 y, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_add(v_add(slopes[k], v_mul(x, slopes[3 + k])), v_mul(y, slopes[6 + k]));
    vf32 scale = v_div(v_setf(1), v_add(v_add(out[0], out[1]), out[2]));
    for (int k = 0; k < 3; k++)
        out[k] = v_mul(out[k], scale);
}

/* Weights that are numbers: of a triangle seen from the side, any will do. */
static ALWAYS_INLINE void mend(vf32 weight[3])
{
    vmask usable = v_eq(v_sub(weight[0], weight[0]), v_setf(0));
    for (int k = 1; k < 3; k++)
        usable = v_mand(usable, v_eq(v_sub(weight[k], weight[k]), v_setf(0)));
    for (int k = 0; k < 3; k++)
        weight[k] = v_self(usable, weight[k], v_setf(1.0f / 3));
}

/* ---- textures ---- */

/* The changes across a block of 2 x 2 pixels, in texels; of cubes, on the face of its first pixel. */
static ALWAYS_INLINE vf32 detail_of(const e3d_muj_texture *texture, const vf32 at[3][3])
{
    vf32 place[3][2], most = v_setf(0);
    if (texture->faces == 6) {
        on_cube on = cube_face(at[0]);
        for (int k = 0; k < 3; k++)
            cube_place(&on, at[k], place[k]);
    } else {
        for (int k = 0; k < 3; k++)
            place[k][0] = at[k][0], place[k][1] = at[k][1];
    }
    for (int c = 0; c < 2; c++) {
        vf32 size = v_setf((float)(c ? texture->height : texture->width));
        for (int k = 1; k < 3; k++)
            most = v_max(v_mul(size_of(v_sub(place[k][c], place[0][c])), size), most);
    }
    return most;
}

/* Blocks are counted from the picture's lowest row. */
static ALWAYS_INLINE void apply_texture(const muj_batch *batch, const level_table *table, const face_view *view, const vf32 slopes[9],
                                        const vf32 weight[3], int i, vf32 out[4])
{
    vi32 x = v_andi(v_loadi(batch->x + i), v_seti(-2)), bottom = v_seti(batch->bottom);
    vi32 y = v_subi(bottom, v_andi(v_subi(bottom, v_loadi(batch->y + i)), v_seti(-2)));
    vf32 corner[3][3], at[3] = {v_setf(0), v_setf(0), v_setf(0)}, around[3][3];
    int count = batch->texture->faces == 6 ? 3 : 2;
    for (int c = 0; c < count; c++) {
        parts_at(view, MUJ_PART(coordinates) + 3 * c, 3, corner[c]);
        at[c] = mixed(weight, corner[c]);
    }
    for (int k = 0; k < 3; k++) {
        vf32 beside[3];
        weigh(slopes, v_float(k == 1 ? v_addi(x, v_seti(1)) : x), v_float(k == 2 ? v_subi(y, v_seti(1)) : y), beside);
        for (int c = 0; c < 3; c++)
            around[k][c] = c < count ? mixed(beside, corner[c]) : at[c];
    }
    vi32 number;
    vf32 share;
    find_level(batch->texture, detail_of(batch->texture, around), &number, &share);
    sample_texture(batch->texture, table, at, number, share, out);
}

/* ---- codes ---- */

static ALWAYS_INLINE vi32 code_of(vf32 v) { return v_trunc(v_add(v_mul(unit_range(v), v_setf(255)), v_setf(0.5f))); }

/* Fog is black in the passes of lights with shadows. */
static ALWAYS_INLINE void apply_fog(const muj_fog *fog, vf32 share, int pass, vf32 rgb[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c] = v_add(v_mul(rgb[c], share), v_mul(v_setf(pass ? 0 : fog->color[c]), v_sub(v_setf(1), share)));
}

static ALWAYS_INLINE void shade_vector(muj_batch *batch, const level_table *table, const face_view *view, int i)
{
    vf32 slopes[9], weight[3], texel[4] = {v_setf(1), v_setf(1), v_setf(1), v_setf(1)}, share = v_setf(1);
    parts_at(view, MUJ_PART(base), 9, slopes);
    weigh(slopes, v_float(v_loadi(batch->x + i)), v_float(v_loadi(batch->y + i)), weight);
    mend(weight);
    if (batch->texture)
        apply_texture(batch, table, view, slopes, weight, i, texel);
    if (batch->fog) {
        vf32 ahead = size_of(mixed_part(view, weight, MUJ_PART(ahead)));
        share = unit_range(v_div(v_sub(v_setf(batch->fog->end), ahead), v_setf(batch->fog->range)));
    }
    for (int p = 0; p < batch->passes; p++) {
        vf32 rgb[3];
        for (int c = 0; c < 3; c++) {
            rgb[c] = unit_range(mixed_part(view, weight, muj_color_at(p) + 3 * c));
            if (batch->texture)
                rgb[c] = v_mul(rgb[c], texel[c]);
        }
        if (batch->fog)
            apply_fog(batch->fog, share, p, rgb);
        vi32 code = v_ori(code_of(rgb[0]), v_ori(v_shl(code_of(rgb[1]), 8), v_shl(code_of(rgb[2]), 16)));
        v_storei(batch->code[p] + i, code);
    }
    if (batch->needs_alpha) {
        vf32 alpha = mixed_part(view, weight, MUJ_PART(alpha));
        if (batch->texture)
            alpha = v_mul(alpha, texel[3]);
        v_storef(batch->alpha + i, alpha);
    }
    for (int c = 0; c < 3 && batch->needs_place; c++)
        v_storef(batch->place[c] + i, mixed_part(view, weight, MUJ_PART(place) + 3 * c));
}

static void kernel_shade(muj_batch *batch)
{
    level_table table;
    const level_table *levels = batch->texture && !batch->texture->meaning && set_table(batch->texture, &table) ? &table : NULL;
    face_view one, each;
    each.one = NULL;
    for (int i = 0, count = count_parts(batch); i < batch->count; i += V_LANES) {
        if (v_any(v_mnot(v_eqi(v_loadi(batch->face + i), v_seti(batch->face[i]))))) {
            load_faces(batch, i, count, &each);
            shade_vector(batch, levels, &each, i);
        } else {
            one.one = batch->faces + batch->face[i];
            shade_vector(batch, levels, &one, i);
        }
    }
}
