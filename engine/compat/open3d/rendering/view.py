"""How an offscreen scene is drawn: antialiasing, occlusion, shadows, post-processing."""

from __future__ import annotations

from ....errors import warn
from .._loading import load
from .view_camera import Camera

_own = load().visualization.rendering.View


class View:
    """Settings of pictures; ``Open3DScene.view`` is one."""

    ShadowType = _own.ShadowType

    def __init__(self) -> None:
        self._camera = Camera()
        self.samples = 4
        self.is_antialiased = self.has_post_processing = True
        self.has_occlusion = self.has_shadows = True

    def get_camera(self) -> Camera:
        """Return the camera."""
        return self._camera

    def set_antialiasing(self, enabled: bool, temporal: bool = False) -> None:
        """Smooth edges or not; pictures that stand alone have nothing ``temporal`` to use."""
        self.is_antialiased = bool(enabled)

    def set_sample_count(self, count: int) -> None:
        """Set the samples of a pixel: 1 is without antialiasing."""
        self.samples = max(int(count), 1)

    def set_post_processing(self, enabled: bool) -> None:
        """Tone map, occlude and smooth, or write light as it is."""
        self.has_post_processing = bool(enabled)

    def set_ambient_occlusion(self, enabled: bool, ssct_enabled: bool = False) -> None:
        """Darken corners or not; cones are not traced."""
        self.has_occlusion = bool(enabled)
        if ssct_enabled:
            warn("screen-space cone tracing is not drawn: ssct_enabled is ignored")

    def set_shadowing(self, enabled: bool, type: object = None) -> None:
        """Cast shadows or not; all types are drawn alike."""
        self.has_shadows = bool(enabled)

    def set_color_grading(self, color_grading: object) -> None:
        """Take the grading; Open3D's tone mapping is the same whatever it says.

        A white balance other than the usual one is not drawn: a warning says so.
        """
        if getattr(color_grading, "temperature", 0.0) or getattr(color_grading, "tint", 0.0):
            warn("the temperature and tint of a ColorGrading are not drawn")
