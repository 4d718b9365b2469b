"""The structs and constants of the C headers: NumPy record types and numbers, read from there.

``layouts.VERTICES`` is the struct ``e3d_vertices``, ``layouts.PAD`` the constant ``E3D_PAD``.
Addresses are numbers.
"""

import functools

import numpy as np
from own_scripts import importable

with importable("csrc"):
    from headers import Enum, Headers, Struct, Typedef

HEADERS = Headers("kernels/kernels.h", "base/helping.h", "e3d_posing.h")
BASIC = {"float": "f4", "double": "f8", "char": "i1", "bool": "?", "int": "i4"}
BASIC |= {"size_t": "P", "ptrdiff_t": "p"}
BASIC |= {f"{u}int{8 * size}_t": f"{u or 'i'}{size}" for u in ("", "u") for size in (1, 2, 4, 8)}


def __getattr__(name):
    if f"E3D_{name}" in HEADERS.constants:
        return HEADERS.constants[f"E3D_{name}"]
    if f"e3d_{name.lower()}" in HEADERS.types:
        return layout(f"e3d_{name.lower()}")
    raise AttributeError(f"the headers have neither a constant nor a struct {name}")


@functools.cache
def layout(name):
    """The NumPy type of a type of C."""
    made = HEADERS.types.get(name)
    if isinstance(made, Struct):
        return _struct(made)
    if isinstance(made, Typedef):
        return _type_of(made.of)
    return np.dtype("i4" if isinstance(made, Enum) else BASIC[name])


def _struct(made):
    members = [(one.name, _type_of(one)) for one in made.members]
    together = np.dtype(members, align=True)
    if made.kind != "union":
        return together
    names, formats = zip(*members, strict=True)
    size = max(form.itemsize for form in formats)
    spec = {"names": names, "formats": formats, "offsets": [0] * len(names), "itemsize": size}
    return np.dtype(spec, align=True)


def _type_of(variable):
    sizes = tuple(HEADERS.value(size) for size in variable.sizes)
    if isinstance(variable, Struct):
        kind = _struct(variable)
    elif variable.is_pointer:
        return np.dtype("P")
    elif variable.stars:
        kind = np.dtype("P")
    else:
        kind = layout(variable.type)
    if kind.subdtype:
        kind, inner = kind.subdtype
        sizes += inner
    return np.dtype((kind, sizes))


# Whose names are those of constants.
BATCH_RECORD, SHADOW_MAP = layout("e3d_batch"), layout("e3d_shadow_map")


def viewport_of(width, height):
    """A viewport record: sizes in samples, and the guard factors of section 2 of the rules; one
    sample a pixel."""
    guard = [2.0 ** np.floor(np.log2(65536 / size)) for size in (width, height)]
    return np.array(
        [(width, height, 128 * width, 128 * height, *guard, 0, 0)], layout("e3d_viewport")
    )
