/* What rough surfaces reflect of light that is 1 all around: make_dfg_table.py writes the numbers, and says what they are. */
#include "e3d_environment.h"

const float E3D_DFG_TABLE[E3D_DFG_TABLES][E3D_DFG_SIZE * E3D_DFG_SIZE] = {
#include "light/dfg_table.inc"
};
