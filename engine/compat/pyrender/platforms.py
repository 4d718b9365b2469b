"""Where pyrender finds OpenGL: nowhere here. The module is for programs that import it."""

from __future__ import annotations


def __getattr__(name: str):
    raise AttributeError(
        f"platforms has no {name}: engine3d draws without OpenGL, EGL, OSMesa or a display"
    )
