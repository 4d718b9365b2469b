/* Directions are spread evenly; their order in a cell is that of ordered dithering (Bayer 1973), so that rows and columns of four, too,
 * look all around.
 */
#include "core/occlusion_pattern.h"

#define FAR 0x1.f6297cp-1f   /* cos 11.25 degrees */
#define LARGE 0x1.a9b662p-1f /* cos 33.75 */
#define SMALL 0x1.1c73b4p-1f /* cos 56.25 */
#define NEAR 0x1.8f8b84p-3f  /* cos 78.75 */

const float E3D_OCCLUSION_DIRECTIONS[16][2] = {
    {FAR, NEAR},     {LARGE, SMALL},   {SMALL, LARGE},   {NEAR, FAR},   {-NEAR, FAR},  {-SMALL, LARGE}, {-LARGE, SMALL}, {-FAR, NEAR},
    {-FAR, -NEAR},   {-LARGE, -SMALL}, {-SMALL, -LARGE}, {-NEAR, -FAR}, {NEAR, -FAR},  {SMALL, -LARGE}, {LARGE, -SMALL}, {FAR, -NEAR},
};

const unsigned char E3D_OCCLUSION_NUMBERS[E3D_OCCLUSION_CELL][E3D_OCCLUSION_CELL] = {
    {0, 8, 2, 10},
    {12, 4, 14, 6},
    {3, 11, 1, 9},
    {15, 7, 13, 5},
};

const unsigned char E3D_OCCLUSION_SHIFTS[E3D_OCCLUSION_CELL][E3D_OCCLUSION_CELL] = {
    {1, 13, 5, 9},
    {7, 11, 3, 15},
    {8, 4, 12, 0},
    {14, 2, 10, 6},
};
