/* The light that a lobe gathers from cells around, for a block of texels. */
#pragma once

enum {
    E3D_CELLS = 4,
    E3D_LOBE_TEXELS = 16, /* of a block */
    E3D_LOBE_SUMS = 4     /* red, green, blue, and the sum for a light of 1 */
};

/* The four children of one cell: unit vectors to the mean direction of their light, their solid angles, and light times solid
 * angle. */
typedef struct e3d_cell_group {
    float direction[3][E3D_CELLS], weight[E3D_CELLS], light[3][E3D_CELLS];
    float middle[3]; /* the parent's direction: a unit vector */
} e3d_cell_group;

/* Texels of one roughness, with its alpha^2 and 1 - alpha^2. */
typedef struct e3d_lobe_block {
    float normal[3][E3D_LOBE_TEXELS], sums[E3D_LOBE_SUMS][E3D_LOBE_TEXELS];
    float square, rest;
} e3d_lobe_block;
