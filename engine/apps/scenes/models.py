"""Scenes of the bundled models: a textured one, and one in 3D Studio's ASCII format."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from ...model.materials.linear_colors import linear
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight
from ...stage.open_model import open_model
from ...stage.viewed_scene import ViewedScene

SHOWCASE_MODEL = "island.obj"
SKY = (142, 178, 204)
SHOWCASE_SECONDS = 24.0
TEXTURED_MODEL = "teapot.obj"
ASC_MODEL = "train.asc"


def showcase() -> ViewedScene:
    """Return the default scene: an island by day, turning slowly."""
    viewed = data_model(SHOWCASE_MODEL)
    scene = viewed.scene
    scene.background = SKY
    viewed.themed = False
    scene.ambient = linear(0.20, 0.23, 0.27)
    scene.add(
        DirectionalLight((-0.55, -0.75, -0.55), linear(1.0, 0.94, 0.82), 0.95 * WHITE_INTENSITY)
    )
    scene.add(DirectionalLight((0.7, -0.25, 0.5), linear(0.65, 0.80, 1.0), 0.18 * WHITE_INTENSITY))
    viewed.title = "island"
    viewed.plays = True
    viewed.period = SHOWCASE_SECONDS
    return viewed


def textured() -> ViewedScene:
    """Return a model with a texture."""
    return data_model(TEXTURED_MODEL)


def asc() -> ViewedScene:
    """Return a model of several objects from an .asc file."""
    return data_model(ASC_MODEL)


def data_model(name: str) -> ViewedScene:
    """Return a model of `engine3d.data` by its file name."""
    return open_model(Path(str(files("engine3d.data"))) / "models" / name)
