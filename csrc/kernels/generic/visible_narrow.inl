/* raster, the visible surface of a tile: blocks are 8 samples wide, so the table of 8 lanes takes it. */

static void kernel_raster_visible(e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids,
                                  int count)
{
    E3D_NARROW_TABLE.raster_visible(tile, table, ids, count);
}

static void kernel_raster_fragments(e3d_visible_tile *tile, const e3d_record_table *table, const e3d_fragment_block *block)
{
    E3D_NARROW_TABLE.raster_fragments(tile, table, block);
}

static void kernel_raster_settle(e3d_visible_tile *tile, const e3d_record_table *table, int depths)
{
    E3D_NARROW_TABLE.raster_settle(tile, table, depths);
}

static void kernel_raster_measure(e3d_visible_tile *tile)
{
    E3D_NARROW_TABLE.raster_measure(tile);
}
