"""The exact picture of tests of arithmetic: one sample a pixel, no look, no back faces."""

import engine3d as e3d

PLAIN = {"look": "plain", "samples": 1, "antialiasing": "ssaa"}


def render(scene, camera=None, **options):
    """`engine3d.render` with these defaults."""
    if "options" not in options:
        options = {"cull": "back", **options}
    return e3d.render(scene, camera, **{**PLAIN, **options})


class Renderer(e3d.Renderer):
    """`engine3d.Renderer` with these defaults."""

    def __init__(self, size, **options):
        super().__init__(size, **{**PLAIN, **options})

    def render(self, scene, camera=None, **options):
        if "options" not in options:
            options = {"cull": "back", **options}
        return super().render(scene, camera, **options)
