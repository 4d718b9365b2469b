"""Writes docs/materials.md: all that a material may say.

    python docs/make_materials.py            write it
    python docs/make_materials.py --check    exit with 1 if it is out of date

In: the rows of `Material`. Out: one Markdown page. A test keeps it up to date.
"""

from __future__ import annotations

import sys
from pathlib import Path

from generated_page import write_or_check

from engine3d.model.materials.material import PARAMETERS
from engine3d.model.materials.parameters import Parameter, TextureSlot

PAGE = Path(__file__).resolve().parent / "materials.md"
HEAD = "| Parameter | Values | By default | In glTF | Meaning |\n|---|---|---|---|---|\n"
INTRODUCTION = """\
# Materials

Made from the rows of `engine/model/materials/material.py` by `docs/make_materials.py`. Each
parameter is a keyword of `Material(...)`, and an attribute that checks what is assigned to it. With
`metallic` or `roughness` a material is physically based, as glTF 2.0 has it. Without, it is lit by
Lambert's and Blinn's and Phong's models. Colours are display values: names, `"#rrggbb"`,
integers 0..255 or floats 0..1; `e3d.linear(…)` are linear light.

    import engine3d as e3d

    brass = e3d.Material(color=(245, 229, 173), metallic=1.0, roughness=0.3, anisotropy=0.6)
    brass.roughness = 0.4

## Numbers and colours

"""
TEXTURES = """
## Textures

A texture multiplies what its slot is named after, by the channels of the last column. A
`PlacedTexture` also says at which coordinates it is read. Textures of colours are read as their
`color_space` says; the bytes of others are numbers.

"""


def line(name: str, row: Parameter) -> str:
    default = "" if row.default is None else f"`{row.default!r}`"
    place = (
        f"`{row.part}`: `{row.gltf.rpartition('/')[2]}`"
        if row.part
        else row.gltf and f"`{row.gltf}`"
    )
    cells = f"`{name}`", row.words, default, place, row.doc.replace("``", "`")
    return f"| {' | '.join(cells)} |\n"


def table(are_textures: bool) -> str:
    rows = [item for item in PARAMETERS.items() if isinstance(item[1], TextureSlot) == are_textures]
    return HEAD + "".join(line(*item) for item in rows)


if __name__ == "__main__":
    page = INTRODUCTION + table(False) + TEXTURES + table(True)
    sys.exit(write_or_check(PAGE, page, sys.argv[1:]))
