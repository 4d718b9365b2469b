"""Makes what follows from the lessons: their pictures, their pages, the lists of them.

    python docs/course/make.py             draw the pictures, write pages and lists
    python docs/course/make.py 03_lines    the pictures of some lessons only
    python docs/course/make.py --check     write nothing; exit status 1 if something is out of date

In: the programs of lessons/, and the files with their texts. Out: pictures/*.png, those with French
captions in pictures/fr, the pages in en/ and fr/, and in the index of each language a row per
lesson.
"""

from __future__ import annotations

import argparse
import itertools
import re
import runpy
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from engine3d.apps.learn.lesson_file import LessonFile, read_lesson

FOLDER = Path(__file__).resolve().parent
LESSONS = FOLDER.parents[1] / "lessons"
#: The words of the pages in each language, and the name of the other language.
WORDS = {
    "en": {"before": "Previous: ", "after": "Next: ", "other": ("fr", "Français")},
    "fr": {"before": "Avant : ", "after": "Suite : ", "other": ("en", "English")},
}
#: Headings of the sections, by their names in the files of the lessons.
HEADINGS = {
    "en": {
        "idea": "The idea",
        "program": "The program",
        "observe": "What to observe",
        "code": "In a few lines",
        "tasks": "Exercises",
        "terms": "Terms",
    },
    "fr": {
        "idea": "L'idée",
        "program": "Le programme",
        "observe": "À observer",
        "code": "En quelques lignes",
        "tasks": "Exercices",
        "terms": "Vocabulaire",
    },
}
TYPED = {
    "en": "This program runs as it stands, in an empty folder: `engine3d learn {0} --code` "
    "prints it.",
    "fr": "Ce programme fonctionne tel quel, dans un dossier vide : `engine3d learn {0} --code` "
    "l'affiche.",
}
CHECKED = {
    "en": "**With a check.** {1} `engine3d learn {0}` checks the answer.",
    "fr": "**Avec vérification.** {1} `engine3d learn {0}` vérifie la réponse.",
}
TERMS = {"en": "| English | French |", "fr": "| français | anglais |"}
ROWS = re.compile(r"(<!-- lessons -->\n).*?(<!-- end -->)", re.S)


def lesson_names() -> list[str]:
    return sorted(path.stem for path in LESSONS.glob("[0-9][0-9]_*.py"))


def draw_sheet(name: str, language: str) -> np.ndarray:
    """Return all steps of a lesson as one picture, (H, W, 3) uint8."""
    sys.path.insert(0, str(LESSONS))
    try:
        import lesson

        text_of = lesson.captions_of(name, language)
        steps = runpy.run_path(str(LESSONS / f"{name}.py"))["steps"]
        blocks = [lesson.block(text_of(caption), *shown) for caption, *shown in steps()]
        return lesson.sheet(blocks)[:, :, :3]
    finally:
        sys.path.remove(str(LESSONS))


def picture_path(name: str, language: str) -> Path:
    return FOLDER / "pictures" / ("" if language == "en" else language) / f"{name}.png"


def same_picture(path: Path, picture: np.ndarray) -> bool:
    if not path.exists():
        return False
    with Image.open(path) as image:
        return np.array_equal(np.asarray(image.convert("RGB")), picture)


def lesson_file(name: str) -> LessonFile:
    return read_lesson(LESSONS / f"{name}.md")


def title(language: str, name: str) -> str:
    return lesson_file(name).title(language)


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


def page(language: str, name: str, names: list[str]) -> str:
    """Return the page of a lesson."""
    lesson = lesson_file(name)
    picture = picture_path(name, language).relative_to(FOLDER).as_posix()
    parts = [
        f"# {lesson.title(language)}",
        links(language, name, names),
        f"![{lesson.texts['shown', language]}](../{picture})",
        lesson.texts["commands", language],
    ]
    for section, heading in HEADINGS[language].items():
        parts += [f"## {heading}", section_text(lesson, section, language)]
    return "\n\n".join(parts) + "\n"


def section_text(lesson: LessonFile, section: str, language: str) -> str:
    """Return what stands below a heading of a page."""
    short = lesson.name[3:]
    if section == "code":
        return f"{TYPED[language].format(short)}\n\n{lesson.texts['code', '']}"
    if section == "tasks":
        question = lesson.texts["exercise", language]
        first = CHECKED[language].format(short, question)
        return f"{first}\n\n{lesson.texts['tasks', language]}"
    if section == "terms":
        rows = lesson.texts["terms", ""].splitlines()
        if language == "fr":
            pairs = [row.strip("| ").split(" | ") for row in rows]
            rows = [f"| {french} | {english} |" for english, french in pairs]
        return "\n".join([TERMS[language], "|---|---|", *rows])
    return lesson.texts[section, language]


def index_with_rows(language: str, names: list[str]) -> str:
    rows = ""
    for name in names:
        number, _, words = title(language, name).partition(". ")
        shown = lesson_file(name).texts["shown", language]
        rows += f"| {number} | [{words}]({name}.md) | {shown} |\n"
    index = (FOLDER / language / "README.md").read_text(encoding="utf-8")
    return ROWS.sub(lambda found: found[1] + rows + found[2], index)


def texts() -> dict[Path, str]:
    """Return the text that each page should have."""
    names = lesson_names()
    pages = {}
    for language in WORDS:
        for name in names:
            pages[FOLDER / language / f"{name}.md"] = page(language, name, names)
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
    names = arguments.names or lesson_names()
    for name, language in itertools.product(names, WORDS):
        picture, path = draw_sheet(name, language), picture_path(name, language)
        if not same_picture(path, picture):
            stale.append(path)
            if not arguments.check:
                path.parent.mkdir(exist_ok=True)
                Image.fromarray(picture).save(path, optimize=True)
    for path, text in texts().items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path)
            if not arguments.check:
                path.write_text(text, encoding="utf-8")
    for path in stale:
        print(path.relative_to(FOLDER), file=sys.stderr if arguments.check else sys.stdout)
    return 1 if stale and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main())
