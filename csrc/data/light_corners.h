/* The corners of area lights along the two vectors of their extent, in the order of R232; the first one follows the last. */
#pragma once

enum { E3D_RECTANGLE_CORNERS = 4,
       E3D_DISC_CORNERS = 16 };

typedef float e3d_light_corner[2];

static const e3d_light_corner E3D_RECTANGLE_CORNER[E3D_RECTANGLE_CORNERS + 1] = {
    {-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}, {-1.0f, -1.0f}};

/* r (cos(k pi / 8), sin(k pi / 8)), each the nearest f32: r^2 = pi / (8 sin(pi / 8)), so that the area is a unit disc's. */
static const e3d_light_corner E3D_DISC_CORNER[E3D_DISC_CORNERS + 1] = {
    {0x1.035412p+0f, 0.0f}, {0x1.df2d28p-1f, 0x1.8cf676p-2f}, {0x1.6ebee8p-1f, 0x1.6ebee8p-1f}, {0x1.8cf676p-2f, 0x1.df2d28p-1f}, {0.0f, 0x1.035412p+0f}, {-0x1.8cf676p-2f, 0x1.df2d28p-1f}, {-0x1.6ebee8p-1f, 0x1.6ebee8p-1f}, {-0x1.df2d28p-1f, 0x1.8cf676p-2f}, {-0x1.035412p+0f, 0.0f}, {-0x1.df2d28p-1f, -0x1.8cf676p-2f}, {-0x1.6ebee8p-1f, -0x1.6ebee8p-1f}, {-0x1.8cf676p-2f, -0x1.df2d28p-1f}, {0.0f, -0x1.035412p+0f}, {0x1.8cf676p-2f, -0x1.df2d28p-1f}, {0x1.6ebee8p-1f, -0x1.6ebee8p-1f}, {0x1.df2d28p-1f, -0x1.8cf676p-2f}, {0x1.035412p+0f, 0.0f}};
