"""Lets data sets of PyVista draw themselves: ``dataset.engine3d.render().save("a.png")``.

In: any data set of PyVista, or a MultiBlock. Out: frames and scenes of engine3d. PyVista finds this
module by the entry point of its group ``pyvista.accessors`` and imports it on first use.
"""

from __future__ import annotations

from typing import Any

import pyvista

from ...apps.viewer.show import show
from ...errors import InvalidArgumentError
from ...io.scenes.other_libraries import has_points, scene_of_library
from ...io.scenes.upright_loading import stand_upright
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...stage.render import render

__all__ = ["DatasetAccessor"]


@pyvista.register_dataset_accessor("engine3d", pyvista.DataObject)
class DatasetAccessor:
    """What ``dataset.engine3d`` is.

    Parameters
    ----------
    dataset : pyvista.DataObject
    """

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def scene(self) -> Scene:
        """Return a new scene of the data set, which stands upright: its +Z is the scene's +Y.

        Raises
        ------
        InvalidArgumentError
            The data set has no points, such as a table.
        """
        scene = scene_of_library(self._dataset)
        if scene is None or not has_points(scene):
            kind = type(self._dataset).__name__
            raise InvalidArgumentError(f"a {kind} without points cannot be drawn")
        stand_upright(scene, "+Z")
        return scene

    def render(self, camera: Any = None, **options: Any) -> Frame:
        """Draw the data set; parameters and errors as those of `engine3d.render`.

        Examples
        --------
        >>> grid.engine3d.render(color_by="stress", bar=True).save("stress.png")
        """
        return render(self.scene(), camera, **options)

    def show(self, **options: Any) -> None:
        """Show the data set in a window; parameters and errors as those of `engine3d.show`."""
        show(self.scene(), **options)
