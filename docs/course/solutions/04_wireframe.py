"""A solution of the checked exercise of lesson 4, wireframe."""

faces = [(i, j, k) for i in (0, 1) for j in (2, 3) for k in (4, 5)]
edges = set()
for face in faces:
    for a, b in zip(face, face[1:] + face[:1], strict=True):
        edges.add((min(a, b), max(a, b)))
print(len(edges))
