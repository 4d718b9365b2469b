"""PyVista, drawn by engine3d: ``plotter.engine3d.screenshot(file)``, ``dataset.engine3d.render()``.

PyVista finds this module by the entry points of its groups ``pyvista.plotter_components`` and
``pyvista.accessors``, and imports it on first use. `install` takes the place of VTK's drawing, so
that programs run unchanged. docs/pyvista.md tells what is drawn. Needs the extra ``pyvista``.
"""

from ...base.optional_packages import require

require("pyvista", __name__, "pyvista")

from ._windows import prefer_no_opengl  # noqa: E402
from .accessor import DatasetAccessor  # noqa: E402
from .component import PlotterComponent  # noqa: E402
from .plotter_hooks import install, uninstall  # noqa: E402

__all__ = ["DatasetAccessor", "PlotterComponent", "install", "uninstall"]

prefer_no_opengl()
