"""Where the fields of MuJoCo's structs lie in memory, found out by writing into one.

In: the installed mujoco. Out: NumPy dtypes by which all geoms, or lights, of a scene are read at
once. Versions of MuJoCo order the fields differently.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numpy as np

_ARRAYS_OF_GEOMS = {"size": 3, "pos": 3, "mat": 9, "rgba": 4, "texrepeat": 2}
_INTEGERS_OF_GEOMS = (
    *("type", "dataid", "objtype", "objid", "category", "matid", "texid", "texuniform"),
    *("texcoord", "segid"),
)
_FLOATS_OF_GEOMS = ("emission", "specular", "shininess", "reflectance", "modelrbound")
_ARRAYS_OF_LIGHTS = dict.fromkeys(
    ("pos", "dir", "attenuation", "ambient", "diffuse", "specular"), 3
)
_INTEGERS_OF_LIGHTS = ("type",)
_FLOATS_OF_LIGHTS = ("exponent", "cutoff")
_BYTES = ("castshadow", "directional")  # the second: of lights, before they had types
_TEXTS = ("label",)  # of geoms: its first byte tells whether there is one


def _address(array: np.ndarray) -> int:
    return int(array.ctypes.data)


def _scalar_offset(items: Any, name: str, marks: tuple, kind: Any, start: int, size: int) -> int:
    """Return a scalar's place in a struct, from that of ``pos``, at which ``start`` is.

    The bytes from one struct's ``pos`` to the next one's hold each scalar once: of the first struct
    if it comes after ``pos``, else of the second.
    """
    memory = np.ctypeslib.as_array((ctypes.c_uint8 * size).from_address(start))
    for which, shift in ((0, 0), (1, -size)):
        # What a text holds before its first use cannot be read
        before = "" if isinstance(marks[0], str) else getattr(items[which], name)
        places = None
        for mark in marks:
            setattr(items[which], name, mark)
            text = mark.encode() if isinstance(mark, str) else np.array(mark, kind).tobytes()
            wanted = np.frombuffer(text, np.uint8)
            seen = np.lib.stride_tricks.sliding_window_view(memory, len(wanted))
            found = set(np.flatnonzero((seen == wanted).all(1)).tolist())
            places = found if places is None else places & found
        setattr(items[which], name, before)
        if places:
            return min(places) + shift
    raise RuntimeError(f"this version of mujoco hides where {name} is")


def _layout(items: Any, arrays: dict, integers: tuple, floats: tuple) -> tuple[np.dtype, int]:
    """Return a dtype, and how far ``pos`` is from its beginning."""
    start = _address(items[0].pos)
    size = _address(items[1].pos) - start
    fields: list[tuple[str, Any, int]] = []
    for name, length in arrays.items():
        if hasattr(type(items[0]), name):
            offset = _address(getattr(items[0], name)) - start
            fields.append((name, (np.float32, length), offset))
    for names, marks, kind in (
        (integers, (0x51A3C7, 0x2B7E15), np.int32),
        (floats, (1234.5, 777.25), np.float32),
        (_BYTES, (1, 0, 1), np.uint8),
        (_TEXTS, ("a label", "another"), np.uint8),
    ):
        for name in names:
            if hasattr(type(items[0]), name):
                offset = _scalar_offset(items, name, marks, kind, start, size)
                fields.append((name, kind, offset))
    first = min(offset for _, _, offset in fields) // 4 * 4  # structs are whole words
    dtype = np.dtype(
        {
            "names": [name for name, _, _ in fields],
            "formats": [kind for _, kind, _ in fields],
            "offsets": [offset - first for _, _, offset in fields],
            "itemsize": size,
        }
    )
    return dtype, -first


@cache
def _layouts() -> tuple[tuple[np.dtype, int], tuple[np.dtype, int]]:
    import mujoco

    scene = mujoco.MjvScene(mujoco.MjModel.from_xml_string("<mujoco/>"), maxgeom=2)
    geoms, lights = scene.geoms, scene.lights
    for pair in (geoms, lights):
        for item in pair[:2]:  # the memory is not cleared before its first use
            item.pos[:] = 0
            for name in (*_INTEGERS_OF_GEOMS, *_FLOATS_OF_GEOMS, *_FLOATS_OF_LIGHTS, *_BYTES):
                if hasattr(type(item), name):
                    setattr(item, name, 0)
    return (
        _layout(geoms, _ARRAYS_OF_GEOMS, _INTEGERS_OF_GEOMS, _FLOATS_OF_GEOMS),
        _layout(lights, _ARRAYS_OF_LIGHTS, _INTEGERS_OF_LIGHTS, _FLOATS_OF_LIGHTS),
    )


def _view(items: Any, layout: tuple[np.dtype, int], count: int) -> np.ndarray:
    dtype, before = layout
    if not count:
        return np.empty(0, dtype)
    start = _address(items[0].pos) - before
    memory = (ctypes.c_uint8 * (dtype.itemsize * count)).from_address(start)
    return np.frombuffer(memory, dtype, count)


def view_geoms(scene: Any) -> np.ndarray:
    """Return all geoms of a scene's memory as one array, valid as long as the scene is."""
    return _view(scene.geoms, _layouts()[0], len(scene.geoms))


def view_lights(scene: Any) -> np.ndarray:
    """Return all lights of a scene's memory as one array, valid as long as the scene is."""
    return _view(scene.lights, _layouts()[1], len(scene.lights))
