"""A solution of the checked exercise of lesson 15, asc."""

import re
from importlib.resources import files

FACE = re.compile(
    r"Face \d+: +A: *(\d+) +B: *(\d+) +C: *(\d+)"
    r" +AB: *([01]) +BC: *([01]) +CA: *([01])"
)
house = files("engine3d.lessons") / "house.asc"
every, edges = set(), set()
for line in house.read_text(encoding="latin-1").splitlines():
    if found := FACE.match(line):
        a, b, c, *flags = map(int, found.groups())
        for (p, q), flag in zip(((a, b), (b, c), (c, a)), flags, strict=True):
            every.add((min(p, q), max(p, q)))
            if flag:
                edges.add((min(p, q), max(p, q)))
print(len(every - edges))
