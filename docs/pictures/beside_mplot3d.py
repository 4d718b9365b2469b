"""Draws the picture of docs/matplotlib.md: the same program with both projections.

    python docs/pictures/beside_mplot3d.py

It is no part of make.py: letters and ticks are those of the installed matplotlib. Needs the extra
`matplotlib`.
"""

import io
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import engine3d.compat.matplotlib  # noqa: F401


def draw(ax) -> None:
    """Draw rings that go through each other and a sheet, an orbit and two words."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 73), np.linspace(0, 2 * np.pi, 33))
    x, y, z = (
        (0.6 + 0.17 * np.cos(v)) * np.cos(u),
        (0.6 + 0.17 * np.cos(v)) * np.sin(u),
        0.17 * np.sin(v),
    )
    whole = {"rcount": 73, "ccount": 73, "linewidth": 0}
    ax.plot_surface(x - 0.3, y, z, color="tab:red", **whole)
    ax.plot_surface(x + 0.3, z, y, color="tab:blue", **whole)
    X, Y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
    Z = -0.3 + 0.12 * np.cos(4 * X) * np.cos(4 * Y)
    ax.plot_surface(X, Y, Z, cmap="viridis", rcount=41, ccount=41, linewidth=0, alpha=0.75)
    ax.contour(X, Y, Z, levels=5, colors="k", linewidths=0.8)
    t = np.linspace(0, 2 * np.pi, 200)
    ax.plot(1.05 * np.cos(t), 0.35 * np.sin(t), 0.45 * np.cos(t), color="k", linewidth=3)
    a = np.linspace(0, 2 * np.pi, 13)[:-1]
    ax.scatter(
        0.9 * np.cos(a), 0.9 * np.sin(a), 0 * a - 0.05, s=60, color="orange", depthshade=False
    )
    box = {"facecolor": "white", "edgecolor": "gray", "alpha": 0.9, "pad": 2}
    ax.text(0.1, -0.8, -0.2, "before", ha="center", bbox=box)
    ax.text(0.5, 1, 0.25, "behind", ha="center", bbox=box)
    ax.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-0.8, 0.8))
    ax.view_init(elev=24, azim=-62)


def main() -> None:
    figure = plt.figure(figsize=(10.4, 4.6), dpi=100, layout="constrained")
    for k, name in enumerate(("3d", "engine3d")):
        ax = figure.add_subplot(1, 2, k + 1, projection=name)
        draw(ax)
        ax.set_title(f'projection="{name}"', family="monospace")
    out = io.BytesIO()
    figure.savefig(out)
    picture = Image.open(out).convert("RGB")
    picture.save(Path(__file__).with_name("matplotlib.webp"), quality=88, method=6)


if __name__ == "__main__":
    main()
