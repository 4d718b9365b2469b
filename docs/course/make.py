"""Makes what follows from the lessons: their pictures, the links between pages, the lists of them.

    python docs/course/make.py             draw the pictures, write links and lists
    python docs/course/make.py 03_lines    the pictures of some lessons only
    python docs/course/make.py --check     write nothing; exit status 1 if something is out of date

In: the programs of lessons/, and their pages in en/ and fr/, whose third line has the links.
Out: pictures/*.png, the third lines, and in the index of each language a row per lesson.
"""

from __future__ import annotations

import argparse
import re
import runpy
import sys
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).resolve().parent
LESSONS = FOLDER.parents[1] / "lessons"
#: The words of the links in each language, and the name of the other language.
WORDS = {
    "en": {"before": "Previous: ", "after": "Next: ", "other": ("fr", "Français")},
    "fr": {"before": "Avant : ", "after": "Suite : ", "other": ("en", "English")},
}
ROWS = re.compile(r"(<!-- lessons -->\n).*?(<!-- end -->)", re.S)


def lesson_names() -> list[str]:
    return sorted(path.stem for path in LESSONS.glob("[0-9][0-9]_*.py"))


def draw_sheet(name: str) -> np.ndarray:
    """Return all steps of a lesson as one picture, (H, W, 3) uint8."""
    sys.path.insert(0, str(LESSONS))
    try:
        import lesson

        steps = runpy.run_path(str(LESSONS / f"{name}.py"))["steps"]
        return lesson.sheet([lesson.block(*step) for step in steps()])[:, :, :3]
    finally:
        sys.path.remove(str(LESSONS))


def same_picture(path: Path, picture: np.ndarray) -> bool:
    if not path.exists():
        return False
    with Image.open(path) as image:
        return np.array_equal(np.asarray(image.convert("RGB")), picture)


def title(language: str, name: str) -> str:
    first = (FOLDER / language / f"{name}.md").read_text(encoding="utf-8").partition("\n")[0]
    return first.removeprefix("# ")


def links(language: str, name: str, names: list[str]) -> str:
    """Return the line that leads to the pages around one."""
    words, place = WORDS[language], names.index(name)
    parts = ["[Index](README.md)"]
    if place > 0:
        before = names[place - 1]
        parts.insert(0, f"[{words['before']}{title(language, before)}]({before}.md)")
    if place + 1 < len(names):
        after = names[place + 1]
        parts.append(f"[{words['after']}{title(language, after)}]({after}.md)")
    folder, other = words["other"]
    return " · ".join([*parts, f"[{other}](../{folder}/{name}.md)"])


def page_with_links(language: str, name: str, names: list[str]) -> str:
    lines = (FOLDER / language / f"{name}.md").read_text(encoding="utf-8").splitlines()
    lines[2] = links(language, name, names)
    return "\n".join(lines) + "\n"


def index_with_rows(language: str, names: list[str]) -> str:
    rows = ""
    for name in names:
        page = (FOLDER / language / f"{name}.md").read_text(encoding="utf-8")
        number, _, words = title(language, name).partition(". ")
        shown = re.search(rf"!\[(.*?)\]\(\.\./pictures/{name}\.png\)", page)[1]
        rows += f"| {number} | [{words}]({name}.md) | {shown} |\n"
    index = (FOLDER / language / "README.md").read_text(encoding="utf-8")
    return ROWS.sub(lambda found: found[1] + rows + found[2], index)


def texts() -> dict[Path, str]:
    """Return the text that each page should have."""
    names = lesson_names()
    pages = {}
    for language in WORDS:
        for name in names:
            pages[FOLDER / language / f"{name}.md"] = page_with_links(language, name, names)
        pages[FOLDER / language / "README.md"] = index_with_rows(language, names)
    return pages


def main() -> int:
    parser = argparse.ArgumentParser(description="Make the pictures and the links of the course.")
    parser.add_argument("names", nargs="*", metavar="LESSON", help="such as 03_lines")
    parser.add_argument("--check", action="store_true", help="compare with the files instead")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(lesson_names())
    if unknown:
        parser.error(f"no such lesson: {', '.join(sorted(unknown))}")
    stale = []
    for name in arguments.names or lesson_names():
        picture, path = draw_sheet(name), FOLDER / "pictures" / f"{name}.png"
        if not same_picture(path, picture):
            stale.append(path)
            if not arguments.check:
                Image.fromarray(picture).save(path, optimize=True)
    for path, text in texts().items():
        if path.read_text(encoding="utf-8") != text:
            stale.append(path)
            if not arguments.check:
                path.write_text(text, encoding="utf-8")
    for path in stale:
        print(path.relative_to(FOLDER), file=sys.stderr if arguments.check else sys.stdout)
    return 1 if stale and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main())
