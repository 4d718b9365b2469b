"""The golden hashes: what the scalar reference drew when a person last looked at the pictures.

    python tests/images/golden.py --pictures FOLDER   # PNGs and contact sheets, to look at
    python tests/images/golden.py --update            # keep the hashes of what is drawn now

In:  the table of pictures. Out: golden.json, name -> {"color": hash, "others": hash of the other
     outputs}. An update names every picture that changed: look at each of them first.
"""

import argparse
import json
import sys
from pathlib import Path

GOLDEN = Path(__file__).with_name("golden.json")
COLUMNS, ROWS, CELL, CAPTION = 5, 5, (200, 150), 14


def load():
    return json.loads(GOLDEN.read_text("utf-8"))


def draw_all():
    """Yield (name, frame) of every picture, drawn by the reference."""
    from images.scenes import SCENES

    for name in sorted(SCENES):
        yield name, SCENES[name]().draw("scalar")


def update():
    from images.picture import digests

    old = load() if GOLDEN.exists() else {}
    new = {name: digests(frame) for name, frame in draw_all()}
    for name in sorted(old.keys() | new.keys()):
        if old.get(name) != new.get(name):
            print("changed" if name in old and name in new else "new or gone", name)
    GOLDEN.write_text(json.dumps(new, indent=1) + "\n", "utf-8")


def save_pictures(folder):
    """Write a PNG of each picture, and sheets of many with their names."""
    folder.mkdir(parents=True, exist_ok=True)
    frames = list(draw_all())
    for name, frame in frames:
        frame.save(folder / f"{name}.png")
    for start in range(0, len(frames), COLUMNS * ROWS):
        sheet = contact_sheet(frames[start : start + COLUMNS * ROWS])
        sheet.save(folder / f"sheet_{start // (COLUMNS * ROWS)}.png")


def contact_sheet(frames):
    """Pictures over a grey checkerboard (which shows where they are transparent), with names."""
    from PIL import Image

    import engine3d as e3d

    width, height = CELL[0], CELL[1] + CAPTION
    sheet = Image.new("RGB", (COLUMNS * width, ROWS * height), (128, 128, 128))
    for number, (name, frame) in enumerate(frames):
        x, y = number % COLUMNS * width, number // COLUMNS * height
        image = frame.image().convert("RGBA")
        scale = min(CELL[0] / image.width, CELL[1] / image.height)
        size = [max(1, int(side * scale)) for side in image.size]
        image = image.resize(size, Image.Resampling.NEAREST)
        sheet.paste(image, (x, y + CAPTION), image)
        caption = e3d.Canvas((width, CAPTION))
        caption.clear((0, 0, 0, 255))
        caption.text(1, 2, name[:33], (255, 255, 255))
        sheet.paste(Image.fromarray(caption.pixels).convert("RGB"), (x, y))
    return sheet


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--update", action="store_true", help="write golden.json")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER", help="write PNGs to look at")
    arguments = parser.parse_args()
    sys.path.insert(0, str(Path(__file__).parents[1]))
    if arguments.pictures:
        save_pictures(arguments.pictures)
    if arguments.update:
        update()


if __name__ == "__main__":
    main()
