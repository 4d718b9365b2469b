"""A window of VTK that never makes an OpenGL context.

In: nothing. Out: a ``vtkRenderWindow`` that PyVista takes for any other.
"""

from __future__ import annotations

import ctypes.util
import os
import sys
from typing import Any

from vtkmodules import vtkRenderingOpenGL2
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkRenderingCore import vtkRenderWindow

VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
_CLASS = "vtkOSOpenGLRenderWindow"
_Base: Any = getattr(vtkRenderingOpenGL2, _CLASS, vtkRenderWindow)


class Window(_Base):  # type: ignore[misc]
    """A window whose pictures engine3d draws when PyVista reads them.

    Attributes
    ----------
    live : LiveWindow or None
        What shows them while the program goes on.
    """

    live: Any = None

    def Render(self) -> None:
        """Do nothing: pictures are drawn when they are read."""

    def MakeCurrent(self) -> None:
        """Do nothing: there is no context."""

    def IsCurrent(self) -> bool:
        """Tell PyVista that pictures can be read."""
        return True

    def Finalize(self) -> None:
        """Close what shows the pictures; there is no context."""
        if self.live is not None:
            self.live.close()
            self.live = None

    def GetNeverRendered(self) -> bool:
        return False

    def SupportsOpenGL(self) -> int:
        return 0

    def ReportCapabilities(self) -> str:
        return "engine3d draws on the processor, without OpenGL"


def new_window() -> Window:
    """Return a new window."""
    kept = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()  # of OSMesa, which is not needed
    try:
        return Window()
    finally:
        vtkObject.SetGlobalWarningDisplay(kept)


def active_camera(window: Any) -> Any:
    """Return the camera of a window's first renderer that draws something."""
    renderers = window.GetRenderers()
    renderers.InitTraversal()
    found = [renderers.GetNextItem() for _ in range(renderers.GetNumberOfItems())]
    return next(one for one in found if one.GetDraw()).GetActiveCamera()


def prefer_no_opengl() -> None:
    """Set VTK's variable where no OpenGL can be loaded, so that plotters can be made."""
    if sys.platform != "linux" or VARIABLE in os.environ:
        return
    if not all(_is_found(name) for name in ("GL", "EGL")):
        os.environ[VARIABLE] = _CLASS


def _is_found(name: str) -> bool:
    return ctypes.util.find_library(name) is not None
