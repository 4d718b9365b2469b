"""A solution of the checked exercise of lesson 1, lists."""

from importlib.resources import files

faces, vertices = [], 0
house = files("engine3d.lessons") / "house.obj"
for line in house.read_text().splitlines():
    words = line.split("#")[0].split()
    if words and words[0] == "v":
        vertices += 1
    if words and words[0] == "f":
        numbers = [int(corner.split("/")[0]) for corner in words[1:]]
        faces.append([n if n > 0 else vertices + 1 + n for n in numbers])
edges = set()
for face in faces:
    for a, b in zip(face, face[1:] + face[:1], strict=True):
        edges.add((min(a, b), max(a, b)))
print(len(edges))
