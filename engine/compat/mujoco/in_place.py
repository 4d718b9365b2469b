"""Puts this renderer in the place of MuJoCo's, for programs that cannot be changed."""

from __future__ import annotations

import os
import sys
from types import ModuleType
from typing import Any

from ...base.optional_packages import require
from . import functions
from .context import GLContext, MjrContext
from .mujoco_renderer import Renderer

_VARIABLE = "MUJOCO_GL"
_PLATFORMS = ("egl", "osmesa", "glfw")
_WITH_RENDERER = ("mujoco", "mujoco.renderer", "mujoco.rendering.classic.renderer")
_WITH_CONTEXT = ("mujoco", "mujoco.gl_context", "mujoco.rendering.classic.gl_context")
#: The modules by which dm_control makes contexts, and the classes that it takes from them.
_OF_DM_CONTROL = {
    "dm_control._render.pyopengl.egl_renderer": "EGLContext",
    "dm_control._render.pyopengl.osmesa_renderer": "OSMesaContext",
    "dm_control._render.glfw_renderer": "GLFWContext",
}
#: The same of robosuite.
_OF_ROBOSUITE = {
    "robosuite.renderers.context.egl_context": "EGLGLContext",
    "robosuite.renderers.context.osmesa_context": "OSMesaGLContext",
    "robosuite.renderers.context.glfw_context": "GLFWGLContext",
}


class _DeviceContext(GLContext):
    """A context as robosuite makes it: for a device, which does not matter here."""

    def __init__(self, max_width: int, max_height: int, device_id: int = -1) -> None:
        super().__init__(max_width, max_height)


def install() -> None:
    """Make ``mujoco.Renderer``, ``mujoco.MjrContext`` and ``mujoco.mjr_…`` this renderer's.

    It serves programs that look these names up when they draw: Gymnasium, dm_control, robosuite,
    Metaworld, LeRobot. Call it before they are imported. Neither OpenGL nor GLFW is imported then;
    the environment variable ``MUJOCO_GL`` becomes ``egl`` unless it names a platform already.
    """
    require("mujoco", "engine3d.compat.mujoco")
    if os.environ.get(_VARIABLE, "").lower() not in _PLATFORMS:
        os.environ[_VARIABLE] = "egl"
    if "mujoco" not in sys.modules:
        for platform in _PLATFORMS:  # or its import would import OpenGL, or GLFW
            sys.modules[f"mujoco.{platform}"] = _platform_module(f"mujoco.{platform}")
    import mujoco

    for platform in _PLATFORMS:
        module = sys.modules.get(f"mujoco.{platform}")
        if module is None:
            module = sys.modules[f"mujoco.{platform}"] = _platform_module(f"mujoco.{platform}")
        module.GLContext = GLContext  # type: ignore[attr-defined]
        setattr(mujoco, platform, module)
    for name, value, modules in (
        ("Renderer", Renderer, _WITH_RENDERER),
        ("GLContext", GLContext, _WITH_CONTEXT),
        ("MjrContext", MjrContext, ("mujoco",)),
        *((name, getattr(functions, name), ("mujoco",)) for name in functions.__all__),
    ):
        for where in modules:
            module = sys.modules.get(where)
            if module is not None:
                setattr(module, name, value)
    _install_for_dm_control()
    for name, made in _OF_ROBOSUITE.items():
        module = sys.modules[name] = ModuleType(name, "A context without OpenGL.")
        setattr(module, made, _DeviceContext)


def _platform_module(name: str) -> ModuleType:
    module = ModuleType(name, "A context without OpenGL.")
    module.GLContext = GLContext  # type: ignore[attr-defined]
    return module


class _ContextModule(ModuleType):
    """A module whose class is made when dm_control asks for it, from dm_control's own base."""

    def __getattr__(self, name: str) -> Any:
        if name != _OF_DM_CONTROL.get(self.__name__):
            raise AttributeError(name)
        from dm_control._render import base, executor  # type: ignore[import-not-found]

        def begin(self: Any, max_width: int, max_height: int) -> None:
            base.ContextBase.__init__(
                self, max_width, max_height, executor.PassthroughRenderExecutor
            )

        methods: dict[str, Any] = {
            each: lambda self, *sizes: None
            for each in ("_platform_init", "_platform_make_current", "_platform_free")
        }
        methods["__init__"] = begin  # without it, a thread of its own would draw
        made = type(name, (base.ContextBase,), methods)
        setattr(self, name, made)
        return made


def _install_for_dm_control() -> None:
    for name in _OF_DM_CONTROL:
        sys.modules[name] = _ContextModule(name, "A context without OpenGL.")
    render = sys.modules.get("dm_control._render")
    if render is not None:
        name, made = next(iter(_OF_DM_CONTROL.items()))
        render.Renderer = getattr(sys.modules[name], made)  # type: ignore[attr-defined]
