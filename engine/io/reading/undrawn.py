"""Warnings about material features that the engine does not draw, one for each kind.

In: for each used material, its undrawn features. Out: one warning per kind, with the number of
materials.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable

from .warning_list import WarningList

#: The kinds, in reporting order -> the text for one and for several materials.
KINDS = {
    "emission map": ("has an emission map", "have emission maps", "drawn without emission"),
    "displacement": ("has a displacement map", "have displacement maps", "drawn without"),
    "anisotropy": ("is anisotropic", "are anisotropic", "drawn as if alike in all directions"),
    "occlusion": ("has an occlusion map", "have occlusion maps", "drawn without"),
    "reflection": ("has a reflection map", "have reflection maps", "drawn without"),
    "specular map": ("has a map of its highlight", "have maps of their highlights", "left out"),
    "ambient map": ("has an ambient map", "have ambient maps", "drawn without"),
    "decal": ("has a decal", "have decals", "drawn without"),
}


def warn_of_undrawn(kinds: Iterable[Collection[str]], warnings: WarningList) -> None:
    """Add the warnings.

    Parameters
    ----------
    kinds : iterable of collection of str
        For each material, the keys of `KINDS` that apply.
    warnings : WarningList
    """
    counts = Counter(kind for of_one in kinds for kind in of_one)
    for kind, (one, several, drawn) in KINDS.items():
        if count := counts[kind]:
            what = f"1 material {one}" if count == 1 else f"{count} materials {several}"
            warnings.add(f"{what}: {drawn}")
