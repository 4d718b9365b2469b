/* What a lobe gathers: light of cells around, for a block of texels. */
#ifndef E3D_KERNELS_LOBE_H
#define E3D_KERNELS_LOBE_H

enum {
    E3D_CELLS = 4,
    E3D_LOBE_TEXELS = 16, /* of a block */
    E3D_LOBE_SUMS = 4     /* red, green, blue, and what light of 1 would be */
};

/* The four cells of one parent, side by side: unit vectors to where their light comes from on average, their solid angles, and light
 * times solid angle. */
typedef struct e3d_cell_group {
    float direction[3][E3D_CELLS], weight[E3D_CELLS], light[3][E3D_CELLS];
    float middle[3]; /* of the parent: a unit vector */
} e3d_cell_group;

/* Texels of one roughness, whose alpha^2 and 1 - alpha^2 these are. */
typedef struct e3d_lobe_block {
    float normal[3][E3D_LOBE_TEXELS], sums[E3D_LOBE_SUMS][E3D_LOBE_TEXELS];
    float square, rest;
} e3d_lobe_block;

#endif
