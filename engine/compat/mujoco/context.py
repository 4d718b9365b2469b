"""`MjrContext` and `GLContext`: where a program of MuJoCo draws to, without OpenGL."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np

from ..._native.mujoco import NativePicture
from ...base.numbers import shown
from ...base.thread_count import resolve_threads
from ...base.validation import whole_number
from ...errors import InvalidArgumentError, warn
from ...rendering.backend_selection import resolve_backend
from ._buffer_depths import BufferDepths
from ._model import Model
from ._quality import quality_of
from ._scenes import SceneView

_WINDOW, _OFFSCREEN = 0, 1  # of mjtFramebuffer
_ZERO_NEAR = 0  # of mjtDepthMap
_MOST_AUX = 10
_MOST_SAMPLES = 4
_MOST_FONT_SCALE = 300  # the largest of mjtFontScale
_MOST_PIXELS = 1 << 16  # of a side


def check_model(model: Any) -> None:
    """Raise an InvalidArgumentError unless something is an MjModel."""
    import mujoco

    if not isinstance(model, mujoco.MjModel):
        raise InvalidArgumentError(f"model must be a mujoco.MjModel, not {shown(model)}")


def check_context(context: Any) -> None:
    """Raise an InvalidArgumentError unless something is a context of this package."""
    if not isinstance(context, MjrContext):
        raise InvalidArgumentError(f"con must be an MjrContext of engine3d, not {shown(context)}")


def check_scene(scene: Any) -> None:
    """Raise an InvalidArgumentError unless something is an MjvScene."""
    import mujoco

    if not isinstance(scene, mujoco.MjvScene):
        raise InvalidArgumentError(f"scn must be a mujoco.MjvScene, not {shown(scene)}")


def check_numbers(array: Any, name: str) -> None:
    """Raise an InvalidArgumentError unless something is an array of numbers."""
    if not isinstance(array, np.ndarray):
        raise InvalidArgumentError(f"{name} must be an array of NumPy, not {shown(array)}")
    if array.dtype.kind not in "biufc":
        raise InvalidArgumentError(f"{name} must hold numbers, not {array.dtype}")


def warn_of_windows() -> None:
    """Warn that pictures go elsewhere."""
    warn("there is no window to draw to: pictures go to the offscreen buffer")


def font_scale_of(value: Any, name: str) -> int:
    """Return a checked mjtFontScale as a number."""
    return whole_number(getattr(value, "value", value), name, 0, _MOST_FONT_SCALE)


class GLContext:
    """Stands where programs make a context of OpenGL. It holds nothing, and belongs to no thread.

    Parameters
    ----------
    max_width, max_height : int
    """

    def __init__(self, max_width: int, max_height: int) -> None:
        pass

    def make_current(self) -> None:
        """Do nothing."""

    def free(self) -> None:
        """Do nothing."""


class MjrContext:
    """What pictures need of a model, and the picture that was drawn last.

    Several may be used at once, in any thread; each draws one picture after the other.

    Parameters
    ----------
    model : mujoco.MjModel, optional
        Its meshes, height fields, textures, and ``vis`` are copied, as by MuJoCo's context.
    fontscale : mujoco.mjtFontScale or int
        Not used, since text is not drawn.

    Attributes
    ----------
    offWidth, offHeight : int
        Of the buffer that `mjr_render` draws to.
    offSamples : int
        Whether pixels have four samples, or with 0 one.
    shadowSize : int
        The side of maps of shadows; with 0 no light has shadows.
    shadowClip, shadowScale, lineWidth, fogStart, fogEnd, fogRGBA
        As in MuJoCo; these, too, are read for each picture.
    readPixelFormat : int
        OpenGL's number of the order of colours that `mjr_readPixels` returns: GL_RGB or GL_BGR.
    readDepthMap : int
        Whether `mjr_readPixels` returns depths as 0 at the near plane (mjDEPTH_ZERONEAR), or at the
        far plane.
    """

    def __init__(self, model: Any = None, fontscale: Any = 150) -> None:
        self.fontScale = font_scale_of(fontscale, "fontscale")
        self.currentBuffer = _OFFSCREEN
        self.readDepthMap = _ZERO_NEAR
        self.readPixelFormat = 6407  # GL_RGB
        self.glInitialized = 1
        self.windowAvailable = self.windowSamples = self.windowStereo = self.windowDoublebuffer = 0
        self.auxWidth, self.auxHeight, self.auxSamples = (
            np.zeros(_MOST_AUX, np.int32) for _ in range(3)
        )
        self.lock = threading.Lock()
        self._picture: NativePicture | None = NativePicture(resolve_backend(), resolve_threads())
        self._view: SceneView | None = None
        self._colors: np.ndarray | None = None
        self._model: Model | None = None
        self.depths = BufferDepths()
        self.offWidth = self.offHeight = self.offSamples = 0
        self.shadowSize, self.lineWidth, self.shadowClip, self.shadowScale = 0, 1.0, 1.0, 0.6
        self.fogStart, self.fogEnd, self.fogRGBA = 0.0, 0.0, np.zeros(4, np.float32)
        self.nskin = self.ntexture = 0
        if model is not None:
            check_model(model)
            self._take(model)
        self._is_complete = True

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a field. There are no others, as in MuJoCo, and none of OpenGL's objects."""
        if name not in self.__dict__ and "_is_complete" in self.__dict__:
            raise AttributeError(f"MjrContext has no field {name} here")
        super().__setattr__(name, value)

    def _take(self, model: Any) -> None:
        import mujoco

        major, minor = mujoco.mj_versionString().split(".")[:2]
        self._model = Model(model, (int(major), int(minor)))
        vis, extent = model.vis, float(model.stat.extent)
        self.offWidth, self.offHeight = int(vis.global_.offwidth), int(vis.global_.offheight)
        self.offSamples = _MOST_SAMPLES if vis.quality.offsamples > 0 else 0
        self.shadowSize, self.lineWidth = int(vis.quality.shadowsize), float(vis.global_.linewidth)
        self.shadowClip = extent * float(vis.map.shadowclip)
        self.shadowScale = float(vis.map.shadowscale)
        self.fogStart, self.fogEnd = (
            extent * float(vis.map.fogstart),
            extent * float(vis.map.fogend),
        )
        self.fogRGBA = np.array(vis.rgba.fog, np.float32)
        self.nskin, self.ntexture = int(model.nskin), int(model.ntex)

    def free(self) -> None:
        """Free the memory; arrays that were returned stay valid."""
        self._picture = self._model = self._view = self._colors = None
        self.depths.clear()

    @property
    def model(self) -> Model:
        """What pictures need of the model."""
        if self._model is None:
            raise InvalidArgumentError(
                "a context without a model, or one that was freed, draws nothing"
            )
        return self._model

    @property
    def picture(self) -> NativePicture:
        """The memory that pictures are drawn in."""
        if self._picture is None:
            raise InvalidArgumentError("a context that was freed draws nothing")
        return self._picture

    def view(self, scene: Any) -> SceneView:
        """Return the memory of a scene; that of the last one is kept."""
        if self._view is None or self._view.scene is not scene:
            self._view = SceneView(scene)
        return self._view

    # ---- the buffer ----

    @property
    def colors(self) -> np.ndarray:
        """The buffer's colours, (offHeight, offWidth, 3) uint8, the lowest row first."""
        shape = self.offHeight, self.offWidth, 3
        if self._colors is None or self._colors.shape != shape:
            self._colors = np.zeros(shape, np.uint8)
        return self._colors

    def resize(self, width: int, height: int) -> None:
        """Give the buffer another size; what it showed is lost, unless the size is the same."""
        size = tuple(
            whole_number(value, name, 0, _MOST_PIXELS)
            for value, name in ((width, "width"), (height, "height"))
        )
        if size == (self.offWidth, self.offHeight):
            return
        self.offWidth, self.offHeight = size
        self._colors = None
        self.depths.clear()

    def settle_depths(self) -> None:
        """Draw what depths wait, before the shapes change that they are drawn from."""
        self.depths.settle(self)

    def hand_over(self) -> None:
        """Give the core what the fields say, as MuJoCo's does before each picture."""
        quality, model = quality_of(self), self.model
        if quality != model.quality:
            self.settle_depths()  # lines have a width there, too
            model.set_quality(quality)
        if self.currentBuffer == _WINDOW:
            warn_of_windows()


__all__ = ["GLContext", "MjrContext"]
