"""The names of the workloads, and what each draws; without NumPy, since ``--help`` reads them."""

WORKLOADS = {
    "textured": "a textured model of 6,000 triangles",
    "mesh": "one mesh of 70,200 triangles",
    "grid": "144 instances of it: 10 million triangles",
    "grid-depth": "the same, depth alone",
    "grid-ids": "the same, numbers of instances alone",
    "city-street": "a city of a million triangles at street level",
    "city-above": "the city from above",
    "city-lights": "the street under 256 point lights",
    "fill-front": "32 layers that fill the picture, front to back",
    "fill-back": "the same layers, back to front",
    "spheres": "39,304 spheres, all in view",
    "spheres-inside": "the spheres from among them",
}
