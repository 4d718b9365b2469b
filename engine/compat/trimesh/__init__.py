"""trimesh's viewer without pyglet and OpenGL: ``scene.save_image()`` on a bare server.

`install` puts a module in the place of ``trimesh.viewer.windowed``. docs/trimesh.md tells what it
takes over. Needs the extra ``trimesh``.
"""

from ...base.optional_packages import require

require("trimesh", __name__, "trimesh")

from .viewer_hooks import install, uninstall  # noqa: E402

__all__ = ["install", "uninstall"]
