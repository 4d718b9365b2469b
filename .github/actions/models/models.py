"""Draws the models that differ between two commits, side by side, and tells of them in a table.

    python models.py --before TREE --base COMMIT --size WxH --folder OUT --summary FILE \\
        --patterns LINES

In:  the folder that is the working tree of a repository; TREE, that of its commit COMMIT.
Out: in OUT `models.png` (before, after, and what differs, a model in a row), the pictures in
     `before`, `after` and `different`, `report.html` of `engine3d diff`, `models.json`; in FILE, a
     table in Markdown; on standard output, `changed` and `broken` as GitHub reads them.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from changed_models import changed_models, is_there, named_models
from drawn_model import compare
from PIL import Image, ImageDraw, ImageFont

from engine3d.apps.golden.names import portable_part

sys.path.append(str(Path(__file__).resolve().parents[1] / "golden"))
from summary import cell

MOST = 50  # models
ROWS = 12  # of the picture
SIDES = ("before", "after", "different")  # folders of pictures
HEAD = (
    "| Model | | Triangles | Size | Volume | Surfaces apart, at most |\n|---|---|---|---|---|---|"
)
EDGE, LINE, PAPER = 8, 24, (255, 255, 255)


def main():
    parser = argparse.ArgumentParser()
    for name in ("--before", "--folder", "--summary"):
        parser.add_argument(name, type=Path, required=True)
    parser.add_argument("--base", required=True)
    parser.add_argument("--size", type=size, required=True)
    parser.add_argument("--patterns", type=lines, default=[])
    arguments = parser.parse_args()
    check_folder(arguments.folder)
    named = named_models(arguments.base, arguments.patterns)
    names = changed_models(arguments.base, named)
    changes = [change for change in drawn(names[:MOST], arguments) if change.status != "same"]
    clear(arguments.folder)
    write_json(changes, arguments.folder / "models.json")
    write_pictures(changes, arguments.folder)
    with open(arguments.summary, "a", encoding="utf-8") as file:
        file.write("\n".join([*table(changes, len(names)), *unused(named)]) + "\n")
    print(f"changed={len(changes)}")
    print(f"broken={sum(change.status == 'broken' for change in changes)}")


def check_folder(folder):
    """Refuse a folder with files of the repository, whose links may lead anywhere."""
    listed = subprocess.run(["git", "ls-files", "--", folder], capture_output=True).stdout
    is_linked = not folder.is_absolute() and os.path.realpath(folder) != os.path.abspath(folder)
    if listed or is_linked:
        raise SystemExit(f"models: name another folder: files of the repository are in {folder}")


def size(text):
    """Return the numbers of a text such as 480x360."""
    width, height = map(int, text.split("x"))
    if not 16 <= min(width, height) <= max(width, height) <= 4096:
        raise ValueError(text)
    return width, height


def lines(text):
    """Return the lines of a text that are not blank."""
    return [line for line in text.splitlines() if line.strip()]


def drawn(names, arguments):
    for name in names:
        paths = [Path(tree, name) for tree in (arguments.before, Path())]
        before, after = (path if is_there(path) else None for path in paths)
        if before is not None or after is not None:
            yield compare(name, before, after, arguments.size)


def clear(folder):
    """Make a folder, without what an earlier run left there, of which its models.json tells."""
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / "models.json").exists():
        return
    for name in SIDES:
        shutil.rmtree(folder / name, ignore_errors=True)
    for name in ("models.png", "report.html"):
        (folder / name).unlink(missing_ok=True)


def write_pictures(changes, folder):
    """Write the pictures of both sides, a report that compares them, and all in one picture."""
    for side in ("before", "after"):
        Path(folder, side).mkdir(parents=True, exist_ok=True)
        for change in changes:
            pixels = getattr(change, side).pixels
            if pixels is not None:
                path = picture_path(folder, side, change)
                path.parent.mkdir(parents=True, exist_ok=True)
                Image.fromarray(pixels).save(path)
    if not changes:
        return
    command = [sys.executable, "-m", "engine3d", "diff", "after", "before", "different"]
    done = subprocess.run([*command, "-R", "report.html"], cwd=folder, stdout=sys.stderr)
    if done.returncode not in (0, 1):  # 1: pictures differ
        raise SystemExit("models: engine3d diff failed")
    sheet(changes[:ROWS], folder).save(folder / "models.png")


def picture_path(folder, side, change):
    """Return where a picture of a model lies: under its name, as far as every system takes it."""
    *folders, name = map(portable_part, change.name.split("/"))
    return Path(folder, side, *folders, f"{name}.png")


def sheet(changes, folder):
    """Return one picture: a row for each model, of before, after and what differs."""
    pixels = next(
        (p for c in changes for p in (c.before.pixels, c.after.pixels) if p is not None), None
    )
    height, width = (1, 360) if pixels is None else pixels.shape[:2]
    step = height + LINE + EDGE
    page = Image.new("RGB", (3 * (width + EDGE) + EDGE, step * len(changes) + EDGE), PAPER)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default()
    for row, change in enumerate(changes):
        top = EDGE + row * step
        text = f"{change.name}: {change.status}. Before, after, different"
        pen.text((EDGE, top + 4), printable(text), fill=(0, 0, 0), font=font)
        for column, side in enumerate(SIDES):
            path = picture_path(folder, side, change)
            if path.exists():
                with Image.open(path) as picture:
                    page.paste(picture.convert("RGB"), (EDGE + column * (width + EDGE), top + LINE))
    return page


def printable(text):
    """Return a text in letters that every font has."""
    return text.encode("ascii", "backslashreplace").decode()


def write_json(changes, path):
    content = [
        {
            "name": printable(change.name),
            "status": change.status,
            "deviation": change.deviation,
            "before": figures(change.before),
            "after": figures(change.after),
        }
        for change in changes
    ]
    path.write_text(json.dumps({"models": content}, indent=2) + "\n", "utf-8")


def figures(side):
    return {
        name: getattr(side, name) for name in ("error", "warnings", "triangles", "size", "volume")
    }


def table(changes, count):
    """Yield the lines of the summary. count: how many models may differ."""
    counts = {}
    for change in changes:
        counts[change.status] = counts.get(change.status, 0) + 1
    said = ", ".join(f"{number} {status}" for status, number in sorted(counts.items()))
    yield f"### Models: {said or 'none differs'}"
    yield ""
    if changes:
        yield HEAD
    for change in changes:
        yield f"| {' | '.join(map(cell, columns(change)))} |"
    for change in changes:
        yield from warned(change)
    if count > MOST:
        yield f"\n{count - MOST} more files of models changed, and were not drawn."
    if changes:
        yield "\nThe pictures are among the artifacts of this run: models.png, report.html."


def warned(change):
    """Yield a line of what the reader of a model warns of, if it does."""
    first, *others = change.after.warnings or [""]
    more = f", and {len(others)} more warnings" if others else ""
    if first:
        yield f"\n{cell(printable(change.name))}: {cell(first)}{more}"


def unused(named):
    """Yield a line for each pattern without a file, such as one with a slip of the pen."""
    for pattern, names in named.items():
        if pattern and not names:
            yield f"\nNo file is named by the pattern {cell(pattern)}."


def columns(change):
    """Return the cells of a model's row."""
    sides = change.before, change.after
    yield printable(change.name)
    yield f"{change.status}: {change.reason}" if change.reason else change.status
    yield step([side.triangles for side in sides], "{:,}".format)
    yield step([side.size for side in sides], lambda lengths: " x ".join(map(short, lengths)))
    yield step([side.volume for side in sides], short)
    yield "" if change.deviation is None else short(change.deviation)


def step(values, text):
    """Return a text of what was and what is, once if that is the same."""
    was, now = ("" if value is None else text(value) for value in values)
    return was if was == now else f"{was or 'none'} → {now or 'none'}"


def short(number):
    return f"{np.float64(number):.6g}"


if __name__ == "__main__":
    main()
