"""What files say of their materials and the engine does not draw, told once for each kind.

In: for each material in use, the kinds of such things that it has. Out: one warning a kind, with
the number of materials.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable

from .warning_list import WarningList

#: The kinds, in the order in which they are told -> what is said of one and of several materials.
KINDS = {
    "transparent": ("is transparent", "are transparent", "drawn opaque"),
    "cut out": ("has its alpha cut off", "have their alpha cut off", "drawn whole"),
    "emission map": ("has an emission map", "have emission maps", "drawn without emission"),
    "normal map": ("has a normal map", "have normal maps", "drawn without"),
    "bump map": ("has a bump map", "have bump maps", "drawn without"),
    "displacement": ("has a displacement map", "have displacement maps", "drawn without"),
    "physical": (
        "has physically based values or maps",
        "have physically based values or maps",
        "drawn as a matt surface",
    ),
    "occlusion": ("has an occlusion map", "have occlusion maps", "drawn without"),
    "reflection": ("has a reflection map", "have reflection maps", "drawn without"),
    "specular map": ("has a map of its highlight", "have maps of their highlights", "left out"),
    "ambient map": ("has an ambient map", "have ambient maps", "drawn without"),
    "decal": ("has a decal", "have decals", "drawn without"),
    "unlit": ("is to be drawn unlit", "are to be drawn unlit", "lit like others"),
}


def warn_of_undrawn(kinds: Iterable[Collection[str]], warnings: WarningList) -> None:
    """Add the warnings.

    Parameters
    ----------
    kinds : iterable of collection of str
        For each material, the keys of `KINDS` that are true of it.
    warnings : WarningList
    """
    counts = Counter(kind for of_one in kinds for kind in of_one)
    for kind, (one, several, drawn) in KINDS.items():
        if count := counts[kind]:
            what = f"1 material {one}" if count == 1 else f"{count} materials {several}"
            warnings.add(f"{what}: {drawn}")
