/* Written by make_area_table.py, which explains the table. */
#include "e3d_light.h"

const float E3D_AREA_TABLE[E3D_AREA_TABLES][E3D_AREA_SIZE * E3D_AREA_SIZE] = {
#include "light/area_table.inc"
};
