/* The tiles of a picture, one after the other. */
#ifndef E3D_TILE_H
#define E3D_TILE_H

typedef struct e3d_context e3d_context;

/* Draws all tiles that something is in, and clears the others. */
void e3d_tiles(e3d_context *context);

#endif
