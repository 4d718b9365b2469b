"""Draws the pictures of the tutorials by the programs that stand there.

    python docs/pictures/tutorials.py               draw them all again
    python docs/pictures/tutorials.py textures      only those of some pages
    python docs/pictures/tutorials.py --check       draw, and compare with the digests

In: the pages of docs/tutorials. The Python blocks of a page run one after another, in an empty
folder; each picture that the page shows is one that they write, NAME.png or NAME.apng. Out: small
WebP files in docs/tutorials/pictures/PAGE, and the digests of what was drawn, in drawn.json beside
them. If a page has a PAGE.py beside it, that is the program of its blocks, and is written, too.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from digests import Digests
from gallery import BLOCK, DOCS, empty_folder

FOLDER = DOCS / "tutorials"
PICTURES = FOLDER / "pictures"
DIGESTS = Digests(PICTURES / "drawn.json")
QUALITY = 82
#: The blocks of a page that write its pictures, which are no part of its program.
_DRAWS = re.compile(r'\bsave\w*\(.*"\w+\.a?png"')
_SHOWN = re.compile(r"\]\(pictures/(\w+/\w+)\.webp\)")


class Picture(NamedTuple):
    """A picture, or an animation of several."""

    frames: np.ndarray
    """(N, H, W, 3) uint8"""
    duration: int
    """Milliseconds a frame."""


def pages() -> dict[str, str]:
    """Return the text of each tutorial that shows pictures, by the name of the page."""
    texts = {path.stem: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("*.md"))}
    return {page: text for page, text in texts.items() if "```python\n" in text}


def shown(text: str) -> list[str]:
    """Return the pictures that a page shows, as PAGE/NAME."""
    return list(dict.fromkeys(_SHOWN.findall(text)))


def program(text: str) -> str:
    """Return the program of a page: its Python blocks, without those that write pictures."""
    blocks = [block for language, block in BLOCK.findall(text) if language == "python"]
    return "\n\n".join(block for block in blocks if not _DRAWS.search(block))


def draw(page: str) -> dict[str, Picture]:
    """Run a page's blocks, and return the pictures that it shows."""
    text = pages()[page]
    with empty_folder():
        values: dict = {"__name__": page}
        for language, block in BLOCK.findall(text):
            if language == "python":
                exec(compile(block, f"{page}.md", "exec"), values)
        return {name: _read(name.partition("/")[2]) for name in shown(text)}


def _read(name: str) -> Picture:
    from PIL import Image, ImageSequence

    animated = Path(f"{name}.apng")
    with Image.open(animated if animated.exists() else f"{name}.png") as image:
        frames = [np.array(frame.convert("RGB")) for frame in ImageSequence.Iterator(image)]
        return Picture(np.stack(frames), round(image.info.get("duration", 0)))


def save(picture: Picture, name: str) -> None:
    from PIL import Image

    first, *others = map(Image.fromarray, picture.frames)
    path = PICTURES / f"{name}.webp"
    path.parent.mkdir(parents=True, exist_ok=True)
    motion = {"save_all": True, "append_images": others, "duration": picture.duration, "loop": 0}
    first.save(path, method=6, quality=QUALITY, **(motion if others else {}))
    print(f"{name}: {first.width}x{first.height}, {path.stat().st_size:,} bytes")
    DIGESTS.record(name, picture.frames)


def delete_others() -> None:
    """Delete the pictures that no page shows."""
    names = {name for text in pages().values() for name in shown(text)}
    for path in PICTURES.glob("*/*.webp"):
        if f"{path.parent.name}/{path.stem}" not in names:
            path.unlink()
    DIGESTS.keep(names)


def main() -> int:
    parser = argparse.ArgumentParser(description="Draw the pictures of the tutorials.")
    parser.add_argument("pages", nargs="*", metavar="PAGE", help=", ".join(pages()))
    parser.add_argument("--check", action="store_true", help="compare with the digests instead")
    arguments = parser.parse_args()
    unknown = set(arguments.pages) - set(pages())
    if unknown:
        parser.error(f"no such page: {', '.join(sorted(unknown))}")
    stale = []
    for page in arguments.pages or pages():
        source = FOLDER / f"{page}.py"
        if source.exists() and not arguments.check:
            source.write_text(program(pages()[page]), "utf-8")
        elif source.exists() and source.read_text("utf-8") != program(pages()[page]):
            stale.append(source.name)
        for name, picture in draw(page).items():
            if not arguments.check:
                save(picture, name)
            elif not DIGESTS.knows(name, picture.frames):
                stale.append(f"{name}.webp")
    if not arguments.check:
        delete_others()
    if stale:
        print(f"not what the pages say: {', '.join(stale)}", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
