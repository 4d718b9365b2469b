"""Options of a `Visualizer`: Open3D's own class, whose lights can be read."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import NamedTuple

from ...base.near_words import meant
from ._loading import load


class Lamp(NamedTuple):
    """One of the four lights.

    Attributes
    ----------
    place : (float, float, float)
        Along right, up and front of the view, in longest sides of the box from its middle.
    color : (float, float, float)
    diffuse, specular, shininess : float
    """

    place: tuple[float, float, float]
    color: tuple[float, float, float]
    diffuse: float
    specular: float
    shininess: float


class RenderOption(load().visualization.RenderOption):
    """Open3D's render options; ``load_from_json`` also takes the lights."""

    def __init__(self) -> None:
        super().__init__()
        self._read()

    def __setattr__(self, name: str, value) -> None:
        """Set an option; a name that is none is an AttributeError, as in Open3D."""
        if not name.startswith("_") and not hasattr(type(self), name):
            hint = meant(name, (known for known in dir(type(self)) if not known.startswith("_")))
            raise AttributeError(f"RenderOption has no {name!r}{hint}")
        super().__setattr__(name, value)

    def load_from_json(self, filename) -> None:
        """Take the options of a file of Open3D."""
        super().load_from_json(str(filename))
        self._read()

    @property
    def ambient(self) -> tuple[float, float, float]:
        """Colour of the ambient light."""
        return self._ambient

    @property
    def lamps(self) -> tuple[Lamp, ...]:
        """The four lights."""
        return self._lamps

    @property
    def default_mesh_color(self) -> tuple[float, float, float]:
        """Colour of meshes without colours."""
        return self._mesh_color

    def _read(self) -> None:
        """Read the values that Open3D gives to files only."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "options.json"
            self.save_to_json(str(path))
            values = json.loads(path.read_text("utf-8"))
        self._ambient = tuple(values["light_ambient_color"])
        self._mesh_color = tuple(values["default_mesh_color"])
        self._lamps = tuple(
            Lamp(
                tuple(values[f"light{number}_position"]),
                tuple(values[f"light{number}_color"]),
                values[f"light{number}_diffuse_power"],
                values[f"light{number}_specular_power"],
                values[f"light{number}_specular_shininess"],
            )
            for number in range(4)
        )
