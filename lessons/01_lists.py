"""A model is lists: the vertices, texture coordinates, normals and faces of an OBJ file.

The lists are read as a student would read them, and printed as they stand in the file: nothing is
cut into triangles, joined or moved.
"""

import sys

from lesson import FOLDER, listing, main, told

HOUSE = FOLDER / "house.obj"


def read_lists(path):
    """Return the lists of an OBJ file: v, vt and vn as numbers, f as the words of each face."""
    lists = {"v": [], "vt": [], "vn": [], "f": []}
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split("#")[0].split()
            if words and words[0] in lists:
                kind, rest = words[0], words[1:]
                lists[kind].append(rest if kind == "f" else [float(word) for word in rest])
    return lists


def resolve(corner, lists):
    """Return where a corner such as "3/1/2" points: indices from 0 into v, vt, vn, or None."""
    found = []
    for kind, word in zip(("v", "vt", "vn"), [*corner.split("/"), "", ""], strict=False):
        if word == "":
            found.append(None)
        elif int(word) > 0:
            found.append(int(word) - 1)
        else:
            found.append(len(lists[kind]) + int(word))
    return found


def list_lines(lists, kind):
    """Return a list of the file as lines of text, numbered from 1 as OBJ does."""
    rows = [[word if kind == "f" else f"{word:g}" for word in row] for row in lists[kind]]
    widest = max((len(word) for row in rows for word in row), default=0)
    return [
        f"{kind:>2} {number:>3}: " + " ".join(f"{word:>{widest}}" for word in row)
        for number, row in enumerate(rows, 1)
    ]


def numbers(row):
    return " ".join(f"{number:>7g}" for number in row)


def print_lists(model=HOUSE):
    """Print the lists of the file."""
    lists = read_lists(model)
    for kind, rows in lists.items():
        print(f"{len(rows)} {kind}")
        sys.stdout.writelines(f"{line}\n" for line in list_lines(lists, kind))


def steps(width=0, height=0, model=HOUSE, face=1):
    """Show the lists, then three faces from one on backwards; text needs no size."""
    lists = read_lists(model)
    for kind, what in (
        ("v", "vertices: x y z"),
        ("vt", "texture coordinates: u v"),
        ("vn", "normals: x y z"),
        ("f", "faces as given: v, v/vt, v//vn or v/vt/vn of each corner"),
    ):
        yield told(f"{{count}} {what}", count=len(lists[kind])), listing(list_lines(lists, kind))
    for number in (face, face - 1, face - 2):
        row = (number - 1) % len(lists["f"])
        lines = ["f " + " ".join(lists["f"][row]), ""]
        for corner in lists["f"][row]:
            rows = zip(("v", "vt", "vn"), resolve(corner, lists), strict=True)
            found = [f"{kind} {numbers(lists[kind][at])}" for kind, at in rows if at is not None]
            lines += [f"{corner}:", "   " + "  ".join(found)]
        yield told("face {number}, followed to its lists", number=row + 1), listing(lines)


if __name__ == "__main__":
    main(__file__, steps, list=print_lists)
