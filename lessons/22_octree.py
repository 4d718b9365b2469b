"""An octree that follows what moves: find what a camera may see without asking everything."""

import numpy as np

import engine3d as e3d
from lesson import blank, earlier, main, told

lines = earlier("03_lines")
frustum = earlier("21_frustum")
SIZE, DEEPEST, THINGS = 16.0, 3, 1500
LENS = e3d.PerspectiveCamera(0.35, znear=0.1, zfar=60.0)
CELL, DOT, SEEN, ASKED = (60, 66, 78), (120, 130, 150), (255, 200, 0), (90, 130, 90)


class Cell:
    """A cube of space: what lies in it, and up to eight cubes of half its size.

    Its box is twice as large as the cube (loose), so that whatever has its middle in the cube and
    is no larger than the cube fits into the box.
    """

    def __init__(self, center, half, parent=None):
        self.center, self.half, self.parent = center, half, parent
        self.children, self.things, self.count = {}, set(), 0

    def child_for(self, place):
        """Return the child around a place; make it if it is not there."""
        key = tuple(p >= c for p, c in zip(place, self.center, strict=True))
        if key not in self.children:
            quarter = self.half / 2
            center = [
                c + (quarter if upper else -quarter)
                for c, upper in zip(self.center, key, strict=True)
            ]
            self.children[key] = Cell(center, quarter, self)
        return self.children[key]

    def holds(self, place):
        return all(abs(p - c) <= self.half for p, c in zip(place, self.center, strict=True))

    def everything(self):
        """Return all things in the cell and below it."""
        found = list(self.things)
        for child in self.children.values():
            found += child.everything()
        return found

    def box(self):
        low = [c - 2 * self.half for c in self.center]
        return low, [c + 2 * self.half for c in self.center]


class Octree:
    """Things with a place and a radius, each in the smallest cell that is as large as it is."""

    def __init__(self, deepest=DEEPEST):
        self.deepest = deepest
        self.root = Cell([0.0, 0.0, 0.0], SIZE / 2)
        self.cell_of = {}

    def insert(self, thing, place, radius):
        cell = self.root
        for _ in range(self.deepest):
            if radius > cell.half / 2:
                break
            cell = cell.child_for(place)
        cell.things.add(thing)
        self.cell_of[thing] = cell
        while cell:
            cell.count += 1
            cell = cell.parent

    def remove(self, thing):
        cell = self.cell_of.pop(thing)
        cell.things.remove(thing)
        while cell:
            cell.count -= 1
            cell = cell.parent

    def move(self, thing, place, radius):
        """Note that a thing has moved; return whether it is in another cell now."""
        if self.cell_of[thing].holds(place):
            return False
        self.remove(thing)
        self.insert(thing, place, radius)
        return True

    def find(self, planes, place_of, radius_of):
        """Return the things in a frustum, the cells that were asked, and the number of tests."""
        found, asked, tests, todo = [], [], 0, [self.root]
        while todo:
            cell = todo.pop()
            if cell.count == 0:
                continue
            tests += 1
            if not frustum.by_p_vertex(planes, *cell.box()):
                continue
            asked.append(cell)
            if entirely_inside(planes, *cell.box()):
                found += cell.everything()
                continue
            for thing in cell.things:
                tests += 1
                if in_frustum(planes, place_of[thing], radius_of[thing]):
                    found.append(thing)
            todo += cell.children.values()
        return sorted(found), asked, tests


def entirely_inside(planes, low, high):
    """Whether no corner of a box is outside: for each plane the one opposite to the p-vertex."""
    return all(
        frustum.distance(plane, frustum.p_vertex([-part for part in plane], low, high)) >= 0
        for plane in planes
    )


def in_frustum(planes, place, radius):
    """Whether the box around a ball has a p-vertex inside of all planes."""
    low = [p - radius for p in place]
    high = [p + radius for p in place]
    return frustum.by_p_vertex(planes, low, high)


def make_things(seed=5):
    """Return the places, speeds and radii of balls."""
    random = np.random.default_rng(seed)
    places = random.uniform(-7.5, 7.5, (THINGS, 3))
    return places, random.uniform(-0.06, 0.06, (THINGS, 3)), random.uniform(0.02, 0.2, THINGS)


def advance(places, speeds):
    """Move everything by its speed; what would leave turns back."""
    outside = np.abs(places + speeds) > 7.8
    speeds[outside] = -speeds[outside]
    places += speeds


def from_above(tree, places, found, asked, side):
    """Draw cells and things from above, y left out."""
    picture = blank(side, side)

    def to_map(x, z):
        return int((x / SIZE + 0.5) * (side - 1)), int((z / SIZE + 0.5) * (side - 1))

    def square(cell, color):
        x, _, z = cell.center
        left, top = to_map(x - cell.half, z - cell.half)
        right, bottom = to_map(x + cell.half, z + cell.half)
        picture[top, left : right + 1] = picture[bottom, left : right + 1] = color
        picture[top : bottom + 1, left] = picture[top : bottom + 1, right] = color

    todo, cells = [tree.root], []
    while todo:
        cell = todo.pop()
        if cell.count:
            cells.append(cell)
            todo += cell.children.values()
    for cell in cells:
        square(cell, CELL)
    for cell in asked:
        square(cell, ASKED)
    shown = set(found)
    for thing, (x, _, z) in enumerate(places):
        column, row = to_map(x, z)
        picture[row : row + 2, column : column + 2] = SEEN if thing in shown else DOT
    return picture


def steps(width=220, height=220, deepest=DEEPEST):
    """Find moving balls in a tree; deepest: how often a cell is divided at most."""
    places, speeds, radii = make_things()
    tree = Octree(deepest)
    for thing in range(THINGS):
        tree.insert(thing, places[thing], radii[thing])
    planes = frustum.planes_of(frustum.clip_from_world(width, height, LENS))
    caption = told("{count} balls in an octree, from above", count=THINGS)
    yield caption, from_above(tree, places, [], [], height)
    changed = 0
    for time in range(41):
        if time in (0, 20, 40):
            found, asked, tests = tree.find(planes, places, radii)
            without = [t for t in range(THINGS) if in_frustum(planes, places[t], radii[t])]
            same = "the same" if found == without else "others"
            picture = from_above(tree, places, found, asked, height)
            caption = "time {time}: {seen} seen by {tests} tests, {same} as by {all}; "
            caption += "{changed:no change|# change|# changes} of cell"
            counts = {"seen": len(found), "tests": tests, "all": THINGS, "changed": changed}
            yield told(caption, time=time, same=same, **counts), picture
        advance(places, speeds)
        for thing in range(THINGS):
            changed += tree.move(thing, places[thing], radii[thing])


if __name__ == "__main__":
    main(__file__, steps)
