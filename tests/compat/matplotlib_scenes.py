"""Small scenes for matplotlib's 3-D axes: each draws, and says what is where.

`SCENES` maps names to functions of axes, which return the shapes of matplotlib_truth.py.
"""

import matplotlib.pyplot as plt
import numpy as np
from compat.matplotlib_truth import Shape, line, sheet
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection, pathpatch_2d_to_3d

RED, BLUE, GREEN, ORANGE = (0.9, 0.1, 0.1), (0.1, 0.3, 0.9), (0.2, 0.7, 0.2), (1.0, 0.6, 0.0)
U, V = np.meshgrid([-1.0, 1.0], [-1.0, 1.0])
FLAT = {"shade": False, "linewidth": 0}


def points_to_pixels(ax) -> float:
    return ax.get_figure().dpi / 72


def wall(ax, color=BLUE, y=0.0):
    ax.plot_surface(U, 0 * U + y, V, color=color, **FLAT)
    return sheet(color, U, 0 * U + y, V)


def quiver_through_wall(ax):
    x, z = (g.ravel() for g in np.meshgrid(np.linspace(-0.7, 0.7, 4), np.linspace(-0.7, 0.7, 4)))
    ax.quiver(x, 0 * x - 0.8, z, 0, 1.6, 0, color=RED, linewidth=6, arrow_length_ratio=0.2)
    shafts = np.stack([np.stack([x, 0 * x - 0.8, z], -1), np.stack([x, 0 * x + 0.8, z], -1)], 1)
    tips = shafts[:, 1:] - [0, 0.16, 0]
    return [
        wall(ax),
        Shape(RED, shafts, 3 * points_to_pixels(ax)),
        Shape(RED, tips, 18, certain=False),
    ]


def wireframe_and_wall(ax):
    x, z = np.meshgrid(np.linspace(-0.9, 0.9, 4), np.linspace(-0.9, 0.9, 4))
    y = 0.6 * np.sign(x) * np.ones_like(z)
    ax.plot_wireframe(x, y, z, color=RED, linewidth=5, rcount=4, ccount=4)
    p = np.stack([x, y, z], -1)
    lines = [line(RED, one, 2.5 * points_to_pixels(ax)) for one in [*p, *p.transpose(1, 0, 2)]]
    ends = Shape(RED, p.reshape(-1, 1, 3), 7, certain=False)
    return [wall(ax), *lines, ends]


def disc_patch(ax):
    disc = plt.Circle((0.0, 0.0), 0.7, color=RED, linewidth=0)
    ax.add_patch(disc)
    pathpatch_2d_to_3d(disc, z=0.1, zdir="x")
    t = np.linspace(0, 2 * np.pi, 97)
    ring = np.stack([0 * t + 0.1, 0.7 * np.cos(t), 0.7 * np.sin(t)], -1)
    middle = np.broadcast_to([0.1, 0, 0], ring[1:].shape)
    return [wall(ax), Shape(RED, np.stack([middle, ring[:-1], ring[1:]], 1))]


def bars_in_planes(ax):
    shapes = [wall(ax)]
    for color, y in ((RED, -0.6), (GREEN, 0.6)):
        left, height = np.array([-0.8, -0.2, 0.4]), np.array([0.9, 0.5, 0.7])
        ax.bar(left, height, width=0.4, align="edge", zs=y, zdir="y", color=color)
        for a, h in zip(left, height, strict=True):
            x, z = np.meshgrid([a, a + 0.4], [0, h])
            shapes.append(sheet(color, x, 0 * x + y, z))
    return shapes


def filled_between(ax):
    t = np.linspace(-0.9, 0.9, 31)
    low, high = np.stack([t, t, -0.5 + 0 * t]), np.stack([t, t, 0.5 + 0.3 * np.sin(4 * t)])
    ax.fill_between(*low, *high, color=RED, shade=False)
    return [wall(ax), sheet(RED, *(np.stack([low[k], high[k]]) for k in range(3)))]


def holes_in_contours(ax):
    x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
    ax.contourf(x, y, np.maximum(abs(x), abs(y)), levels=[0.5, 2], colors=[RED], offset=0.3)
    shapes = [sheet(BLUE, U, V, 0 * U - 0.2)]
    ax.plot_surface(U, V, 0 * U - 0.2, color=BLUE, **FLAT)
    for x0, x1, y0, y1 in (
        (-1, -0.5, -1, 1),
        (0.5, 1, -1, 1),
        (-0.5, 0.5, -1, -0.5),
        (-0.5, 0.5, 0.5, 1),
    ):
        a, b = np.meshgrid([x0, x1], [y0, y1])
        shapes.append(sheet(RED, a, b, 0 * a + 0.3))
    return shapes


def concave_polygons(ax):
    star = [
        (0, 0.9),
        (0.2, 0.2),
        (0.9, 0),
        (0.2, -0.2),
        (0, -0.9),
        (-0.2, -0.2),
        (-0.9, 0),
        (-0.2, 0.2),
    ]
    polygon = np.array([(x, 0.3 * x, z) for x, z in star])
    ax.add_collection3d(Poly3DCollection([polygon], facecolors=[RED], linewidths=0))
    middle = np.zeros_like(polygon)
    return [wall(ax), Shape(RED, np.stack([middle, polygon, np.roll(polygon, -1, 0)], 1))]


def errorbars_round_wall(ax):
    x = np.linspace(-0.7, 0.7, 4)
    y = np.array([-0.5, 0.5, -0.5, 0.5])
    ax.errorbar(
        x,
        y,
        0 * x,
        zerr=0.5,
        fmt="o",
        color=RED,
        ecolor=RED,
        elinewidth=6,
        markersize=14,
        capsize=0,
    )
    places = np.stack([x, y, 0 * x], -1)
    bars = np.stack([places - [0, 0, 0.5], places + [0, 0, 0.5]], 1)
    return [
        wall(ax),
        Shape(RED, bars, 3 * points_to_pixels(ax)),
        Shape(RED, places[:, None], 7 * points_to_pixels(ax)),
        Shape(RED, bars.reshape(-1, 1, 3), 5, certain=False),
    ]


def square_markers(ax):
    x, z = (g.ravel() for g in np.meshgrid(np.linspace(-0.7, 0.7, 3), np.linspace(-0.7, 0.7, 3)))
    y = np.where(np.arange(9) % 2, 0.4, -0.4)
    ax.plot(x, y, z, "s", color=RED, markersize=16, markeredgewidth=0)
    places = np.stack([x, y, z], -1)[:, None]
    corners = Shape(RED, places, 12 * points_to_pixels(ax), certain=False)
    return [wall(ax), Shape(RED, places, 7.5 * points_to_pixels(ax)), corners]


def mapped_line_collection(ax):
    t = np.linspace(-0.9, 0.9, 5)
    segments = [np.array([[a, -0.7, -0.8], [a, 0.7, 0.8]]) for a in t]
    ax.add_collection3d(
        Line3DCollection(segments, colors=[RED, GREEN, ORANGE, RED, GREEN], linewidths=8)
    )
    return (
        [wall(ax)]
        + [
            Shape(color, one[None], 4 * points_to_pixels(ax))
            for color, one in zip([RED, GREEN, ORANGE, RED, GREEN], segments, strict=True)
        ]
        + [Shape(RED, np.array(segments).reshape(-1, 1, 3), 4, certain=False)]
    )


def steep_lens(ax):
    ax.set_proj_type("persp", focal_length=0.3)
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    ax.plot_surface(x, y, 0.5 * x, color=RED, **FLAT)
    ax.plot_surface(x, y, -0.5 * x + 0.2 * y, color=GREEN, **FLAT)
    return [sheet(RED, x, y, 0.5 * x), sheet(GREEN, x, y, -0.5 * x + 0.2 * y)]


def seen_from_below(ax):
    ax.view_init(elev=-35, azim=130, roll=-15, vertical_axis="y")
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    ax.plot_surface(x, y, 0.4 * np.sin(3 * x), color=RED, **FLAT)
    ax.plot_surface(0.3 * x, y, x, color=GREEN, **FLAT)
    return [sheet(RED, x, y, 0.4 * np.sin(3 * x)), sheet(GREEN, 0.3 * x, y, x)]


def strided_surface(ax):
    x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
    ax.plot_surface(x, y, 0.6 * x, color=RED, rstride=7, cstride=7, **FLAT)
    ax.plot_surface(x, y, -0.6 * x, color=GREEN, rcount=10, ccount=12, **FLAT)
    return [sheet(RED, U, V, 0.6 * U), sheet(GREEN, U, V, -0.6 * U)]


def holes_of_nan(ax):
    x, y = np.meshgrid(np.linspace(-1, 1, 21), np.linspace(-1, 1, 21))
    z = np.where((abs(x) < 0.55) & (abs(y) < 0.55), np.nan, 0.4)
    ax.plot_surface(x, y, z, color=RED, rcount=21, ccount=21, **FLAT)
    ax.plot_surface(U, V, 0 * U - 0.3, color=BLUE, **FLAT)
    shapes = [sheet(BLUE, U, V, 0 * U - 0.3)]
    for x0, x1, y0, y1 in (
        (-1, -0.6, -1, 1),
        (0.6, 1, -1, 1),
        (-0.6, 0.6, -1, -0.6),
        (-0.6, 0.6, 0.6, 1),
    ):
        a, b = np.meshgrid([x0, x1], [y0, y1])
        shapes.append(sheet(RED, a, b, 0 * a + 0.4))
    return shapes


def line_on_its_surface(ax):
    x, y = np.meshgrid(np.linspace(-1, 1, 21), np.linspace(-1, 1, 21))
    ax.plot_surface(x, y, 0.5 * x, color=BLUE, **FLAT)
    t = np.linspace(-0.8, 0.8, 33)
    ax.plot(t, 0.5 * t, 0.5 * t, color=RED, linewidth=4)
    # Nearer than the sheet by more than what is unsure.
    toward = 0.06 * np.array(
        [np.cos(-1.05) * np.cos(0.44), np.sin(-1.05) * np.cos(0.44), np.sin(0.44)]
    )
    return [
        sheet(BLUE, x, y, 0.5 * x),
        line(RED, np.stack([t, 0.5 * t, 0.5 * t], -1) + toward, 2 * points_to_pixels(ax)),
    ]


def fits_one_plane(ax):
    """Of artists in one plane, the one with the greater zorder shows, then the later one."""
    a, b = np.meshgrid([-0.6, 0.6], [-0.6, 0.6])
    ax.plot_surface(a, b, 0 * a, color=RED, zorder=3, **FLAT)
    ax.plot_surface(U, V, 0 * U, color=BLUE, zorder=2, **FLAT)
    shift = 0.03
    return [sheet(BLUE, U, V, 0 * U), sheet(RED, a, b, 0 * a + shift)]


SCENES = {
    scene.__name__: scene
    for scene in (
        quiver_through_wall,
        wireframe_and_wall,
        disc_patch,
        bars_in_planes,
        filled_between,
        holes_in_contours,
        concave_polygons,
        errorbars_round_wall,
        square_markers,
        mapped_line_collection,
        steep_lens,
        seen_from_below,
        strided_surface,
        holes_of_nan,
        line_on_its_surface,
        fits_one_plane,
    )
}
