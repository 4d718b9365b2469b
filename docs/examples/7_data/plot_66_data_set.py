"""
A data set with annotations
===========================

This makes pictures of things in random places, and writes them with COCO's boxes and masks.

All that is random follows from a seed: every machine writes the same bytes.
"""

import json
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

import engine3d as e3d
from engine3d.datasets import CocoWriter, Generator, Sample, random_camera

things = {"ring": e3d.torus(0.5, 0.2), "box": e3d.box(0.7), "ball": e3d.uv_sphere(0.4)}


def samples(writer, renderer, seeds):
    """Scenes with one of each thing, drawn."""
    for seed in seeds:
        scene, generator = e3d.Scene(), Generator(seed)
        for place, (name, mesh) in enumerate(things.items()):
            scene.add(mesh, name=name, translation=(place - 1.0, 0.5 * (place % 2), 0.0))
        camera, pose = random_camera(generator, scene, distance=(1.0, 1.3))
        frame = renderer.render(scene, (camera, pose), outputs=writer.outputs)
        yield Sample(f"{seed:04}", seed, frame, scene, camera, pose, renderer)


with tempfile.TemporaryDirectory() as folder, e3d.Renderer((160, 120)) as renderer:
    writer = CocoWriter(list(things))
    e3d.datasets.write_dataset(folder, writer, samples(writer, renderer, range(3)))
    annotations = json.loads((Path(folder) / "annotations.json").read_text())["annotations"]
    shown = [np.asarray(Image.open(path)) for path in sorted(Path(folder).glob("images/*.png"))]
print(annotations[0]["bbox"])
picture = Image.fromarray(np.hstack(shown))
