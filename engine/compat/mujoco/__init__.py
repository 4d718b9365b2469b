"""MuJoCo's renderer, drawn by this engine on the CPU: no OpenGL, no EGL, no display.

``from engine3d.compat.mujoco import Renderer`` is all that a program has to change; one that cannot
be changed runs after `install`. docs/mujoco.md tells what works and what differs. The package
mujoco is imported when a renderer is made.
"""

from . import functions
from .context import GLContext, MjrContext
from .functions import *  # noqa: F403
from .in_place import install
from .mujoco_renderer import Renderer

__all__ = ["GLContext", "MjrContext", "Renderer", "install", *functions.__all__]
