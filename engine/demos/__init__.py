"""The scenes that ``--scene`` names, each a function that makes a `ViewedScene`.

Nothing loads until a scene is asked for. A scene is made anew every time: what one caller changes
no other sees.
"""

from __future__ import annotations

from importlib import import_module

from ..errors import InvalidArgumentError

#: Name of the scene -> module and function that make it.
_MAKERS = {
    "default": ("models", "showcase"),
    "vertices": ("cubes", "vertices"),
    "edges": ("cubes", "edges"),
    "faces": ("cubes", "faces"),
    "cube": ("cubes", "cycle"),
    "shapes": ("shapes", "shapes"),
    "textured": ("models", "textured"),
    "asc": ("models", "asc"),
    "city": ("city", "city"),
    "solar": ("solar", "solar"),
    "spheres": ("crowds", "spheres"),
    "lod": ("crowds", "lod"),
    "parcels": ("crowds", "parcels"),
}
DEMO_NAMES = tuple(_MAKERS)


def load_demo(name: str, **options):
    """Return a scene by its name.

    Parameters
    ----------
    name : str
        One of `DEMO_NAMES`.
    **options
        ``triangles`` : int, of ``"city"``: how many, about. ``dusk`` : bool, of the same.
        ``subdivisions`` : int, of ``"shapes"``: into how many parts edges are cut.

    Returns
    -------
    ViewedScene

    Raises
    ------
    InvalidArgumentError
        There is no such scene.
    """
    if name not in _MAKERS:
        raise InvalidArgumentError(f"no scene {name!r}: there are {', '.join(DEMO_NAMES)}")
    module, function = _MAKERS[name]
    return getattr(import_module(f".{module}", __name__), function)(**options)
