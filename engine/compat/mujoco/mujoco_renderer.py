"""`Renderer`, with the names and results of mujoco.Renderer."""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np

from ...base.numbers import shown
from ...base.validation import whole_number
from ...errors import InvalidArgumentError, OutOfMemoryError
from ._frames import draw_colors, draw_segments
from ._scenes import perspective_depth
from .context import MjrContext, check_model, check_numbers, font_scale_of

_FONT_SCALE = 150
_MOST_GEOMS = 2**31 - 1


class Renderer:
    """Renders MuJoCo scenes into arrays.

    Any number of them may be used at once, in any thread and process.

    Parameters
    ----------
    model : mujoco.MjModel
    height, width : int
        Pixels, at most ``model.vis.global_.offheight`` and ``offwidth``.
    max_geom : int
        How many geoms a scene may hold.
    font_scale : mujoco.mjtFontScale, optional
        Not used, since text is not drawn.

    Raises
    ------
    InvalidArgumentError
        Something is of another type; a size is less than 1.
    OutOfMemoryError
        A scene of so many geoms has no room.
    ValueError
        The size is larger than the model's offscreen buffer.
    """

    def __init__(
        self,
        model: Any,
        height: int = 240,
        width: int = 320,
        max_geom: int = 10000,
        font_scale: Any = _FONT_SCALE,
    ) -> None:
        self._mjr_context: MjrContext | None = None
        self._gl_context = None
        import mujoco

        check_model(model)
        self._width = _checked_size("width", width, model.vis.global_.offwidth)
        self._height = _checked_size("height", height, model.vis.global_.offheight)
        max_geom = whole_number(max_geom, "max_geom", 0, _MOST_GEOMS)
        scale = font_scale_of(font_scale, "font_scale")
        self._model = model
        try:
            self._scene = mujoco.MjvScene(model=model, maxgeom=max_geom)
        except mujoco.FatalError as error:
            raise OutOfMemoryError(f"no memory for a scene of {max_geom} geoms: {error}") from None
        self._scene_option = mujoco.MjvOption()
        self._rect = mujoco.MjrRect(0, 0, self._width, self._height)
        self._mjr_context = MjrContext(model, scale)
        self._mjr_context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        self._depth_rendering = self._segmentation_rendering = False

    @property
    def model(self) -> Any:
        """The model, a mujoco.MjModel."""
        return self._model

    @property
    def scene(self) -> Any:
        """The scene, a mujoco.MjvScene. Its flags and geoms may be changed before `render`."""
        return self._scene

    @property
    def height(self) -> int:
        """Height of pictures, in pixels."""
        return self._height

    @property
    def width(self) -> int:
        """Width of pictures, in pixels."""
        return self._width

    def enable_depth_rendering(self) -> None:
        """Let `render` return depths."""
        self._segmentation_rendering = False
        self._depth_rendering = True

    def disable_depth_rendering(self) -> None:
        """Let `render` return no depths."""
        self._depth_rendering = False

    def enable_segmentation_rendering(self) -> None:
        """Let `render` return which objects show."""
        self._segmentation_rendering = True
        self._depth_rendering = False

    def disable_segmentation_rendering(self) -> None:
        """Let `render` return no objects."""
        self._segmentation_rendering = False

    def update_scene(self, data: Any, camera: Any = -1, scene_option: Any = None) -> None:
        """Fill the scene.

        Parameters
        ----------
        data : mujoco.MjData
        camera : int, str or mujoco.MjvCamera
            A camera's number or name; -1 for the free camera.
        scene_option : mujoco.MjvOption, optional

        Raises
        ------
        ValueError
            There is no such camera.
        """
        import mujoco

        if not isinstance(data, mujoco.MjData):
            raise InvalidArgumentError(f"data must be a mujoco.MjData, not {shown(data)}")
        if not isinstance(camera, mujoco.MjvCamera):
            camera = self._camera(camera)
        category = mujoco.mjtCatBit.mjCAT_ALL.value
        option = self._scene_option if scene_option is None else scene_option
        if not isinstance(option, mujoco.MjvOption):
            raise InvalidArgumentError(
                f"scene_option must be a mujoco.MjvOption, not {shown(option)}"
            )
        mujoco.mjv_updateScene(self._model, data, option, None, camera, category, self._scene)

    def _camera(self, wanted: int | str) -> Any:
        import mujoco

        number = wanted
        if isinstance(wanted, str):
            number = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_CAMERA.value, wanted)
            if number == -1:
                raise ValueError(f'The camera "{wanted}" does not exist.')
        elif not isinstance(wanted, numbers.Integral):
            raise InvalidArgumentError(
                f"camera must be a number, a name or a mujoco.MjvCamera, not {shown(wanted)}"
            )
        number = int(number)
        if number < -1 or number >= self._model.ncam:
            raise ValueError(f"The camera id {number} is out of range [-1, {self._model.ncam}).")
        camera = mujoco.MjvCamera()
        camera.fixedcamid = number
        if number == -1:
            camera.type = mujoco.mjtCamera.mjCAMERA_FREE
            mujoco.mjv_defaultFreeCamera(self._model, camera)
        else:
            camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        return camera

    def render(self, *, out: np.ndarray | None = None) -> np.ndarray:
        """Draw the scene.

        Parameters
        ----------
        out : ndarray, optional
            Where to write, of the result's shape; of any dtype to which it can be cast. It is
            returned.

        Returns
        -------
        image : ndarray
            Colours, (H, W, 3) uint8, the top row first; of depth rendering, metres along the view
            axis, (H, W) float32; of segmentation rendering, object ID and type (mjtObj), (H, W, 2)
            int32, (-1, -1) where nothing is.

        Raises
        ------
        RuntimeError
            The renderer was closed.
        ValueError
            ``out`` has another shape.
        """
        context = self._mjr_context
        if context is None:
            raise RuntimeError("render cannot be called after close.")
        if out is not None:
            self._check_out(out)
        with context.lock:
            if self._depth_rendering:
                image = self._depths(context)
            elif self._segmentation_rendering:
                image = self._objects(context)
            else:
                image = draw_colors(self._scene, context, self._width, self._height)
        if out is None:
            return image
        out[...] = image
        return out

    def _check_out(self, out: np.ndarray) -> None:
        check_numbers(out, "out")
        channels = () if self._depth_rendering else (2,) if self._segmentation_rendering else (3,)
        shape = self._height, self._width, *channels
        if out.shape != shape:
            raise ValueError(
                f"Expected `out.shape == {shape}`. Got `out.shape={out.shape}` instead: of depth "
                "rendering it is `(height, width)`, of segmentation rendering "
                "`(height, width, 2)`, otherwise `(height, width, 3)`."
            )

    def _depths(self, context: MjrContext) -> np.ndarray:
        """Return metres, by mujoco.Renderer's own formula and in its precision."""
        size = self._width, self._height
        z = draw_segments(self._scene, context, *size, numbers=False, depths=True)[1]
        assert z is not None
        extent, maps = self._model.stat.extent, self._model.vis.map
        far, near = np.float32(maps.zfar * extent), np.float32(maps.znear * extent)
        wide = z.astype(np.float64)
        if self._scene.camera[0].orthographic:
            return (np.float64(far) - wide * np.float64(far - near)).astype(np.float32)
        scale, offset = perspective_depth(near, far)
        return (np.float64(offset) / (wide + np.float64(scale))).astype(np.float32)

    def _objects(self, context: MjrContext) -> np.ndarray:
        size = self._width, self._height
        numbers = draw_segments(self._scene, context, *size, numbers=True, depths=False)[0]
        assert numbers is not None
        return context.view(self._scene).objects_of(numbers)

    def close(self) -> None:
        """Free the memory; arrays that were returned stay valid."""
        if self._mjr_context is not None:
            self._mjr_context.free()
        self._mjr_context = None

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()


def _checked_size(side: str, size: int, most: int) -> int:
    if isinstance(size, numbers.Integral) and size > most:
        raise ValueError(
            f"Image {side} {size} > framebuffer {side} {most}. Either reduce the image\n{side} or "
            "specify a larger offscreen framebuffer in the model XML using the\nclause:\n<visual>\n"
            f'  <global off{side}="my_{side}"/>\n</visual>'
        )
    return whole_number(size, side, 1, most)


__all__ = ["Renderer"]
