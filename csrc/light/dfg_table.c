/* Written by make_dfg_table.py, which explains the table. */
#include "e3d_environment.h"

const float E3D_DFG_TABLE[E3D_DFG_TABLES][E3D_DFG_SIZE * E3D_DFG_SIZE] = {
#include "light/dfg_table.inc"
};
