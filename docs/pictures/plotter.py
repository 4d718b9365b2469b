"""Draws the picture of docs/pyvista.md: two subplots of PyVista, drawn by engine3d.

    python docs/pictures/plotter.py

It is no part of make.py: letters and colours are those of the installed PyVista. Needs the extra
`pyvista`; a machine without OpenGL will do.
"""

from pathlib import Path

import engine3d.compat.pyvista

engine3d.compat.pyvista.install()

import numpy as np  # noqa: E402
import pyvista as pv  # noqa: E402
from PIL import Image  # noqa: E402


def main() -> None:
    plotter = pv.Plotter(shape=(1, 2), off_screen=True, window_size=(1200, 520), border=False)
    x, y = np.meshgrid(np.linspace(-8, 8, 90), np.linspace(-8, 8, 90))
    waves = pv.StructuredGrid(x, y, 2.0 * np.sinc(np.hypot(x, y) / 3))
    waves["height"] = waves.points[:, 2]
    plotter.add_mesh(waves, scalars="height", cmap="viridis", smooth_shading=True)
    plotter.add_mesh(waves.contour(7), color="black", line_width=2)
    plotter.show_bounds(grid="back", location="outer", font_size=9)
    plotter.subplot(0, 1)
    plotter.add_mesh(pv.Cube(), color="steelblue", opacity=0.3, show_edges=True)
    plotter.add_mesh(
        pv.Icosphere(radius=0.4, nsub=2), color="gold", pbr=True, metallic=0.7, roughness=0.35
    )
    points = np.random.default_rng(3).uniform(-0.5, 0.5, (60, 3))
    plotter.add_points(points, color="tomato", render_points_as_spheres=True, point_size=14)
    plotter.add_text("a cube, a ball, points", font_size=10)
    plotter.add_axes()
    picture = Image.fromarray(plotter.screenshot(None))
    picture.save(Path(__file__).with_name("pyvista.webp"), quality=88, method=6)


if __name__ == "__main__":
    main()
