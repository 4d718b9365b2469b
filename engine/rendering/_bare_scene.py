"""A scene whose background is drawn apart from it."""

from __future__ import annotations

from typing import Any

from ..model.scene.staged_scene import AnyScene


class BareScene:
    """A scene without its background, which ``apart`` holds: mirrors show that."""

    background = None

    def __init__(self, scene: AnyScene) -> None:
        self._scene, self.apart = scene, scene.background

    def __getattr__(self, name: str) -> Any:
        return getattr(self._scene, name)
