"""Shader classes, which only raise errors: pictures are drawn without OpenGL.

Programs with their own shaders get an error with advice.
"""

from __future__ import annotations

ADVICE = (
    "shaders cannot run: engine3d draws without OpenGL. For normals, positions, uv and the like, "
    "ask engine3d.Renderer.render for outputs, such as outputs=('normal', 'depth')"
)


class ShaderProgram:
    """Raises: GLSL cannot run here."""

    def __init__(self, *args, **kwargs):
        raise NotImplementedError(ADVICE)


class ShaderProgramCache:
    """A shader cache, which programs replace to use their own shaders.

    Parameters
    ----------
    shader_dir : str, optional
        A folder of shaders; naming one raises.
    """

    def __init__(self, shader_dir=None):
        if shader_dir is not None:
            raise NotImplementedError(ADVICE)

    def get_program(self, *args, **kwargs):
        """Raise: GLSL cannot run here."""
        raise NotImplementedError(ADVICE)

    def clear(self) -> None:
        """Do nothing: the cache is empty."""


__all__ = ["ShaderProgram", "ShaderProgramCache"]
