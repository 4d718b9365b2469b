"""
A data set with annotations
===========================

This makes pictures of things in random places, and writes them with COCO's boxes and masks.

Everything random follows from a seed, so the data set has the same bytes on every machine.
"""

import json
import tempfile
from pathlib import Path

import numpy as np

import engine3d as e3d
from engine3d.datasets import CocoWriter, Generator, Sample, random_camera, random_pose

things = {"ring": e3d.torus(0.5, 0.2), "box": e3d.box(0.7), "ball": e3d.uv_sphere(0.4)}


def samples(writer, count):
    """Scenes with one of each thing, drawn."""
    with e3d.Renderer(160, 120) as renderer:
        for seed in range(count):
            scene, generator = e3d.Scene(), Generator(seed)
            for name, mesh in things.items():
                pose = random_pose(generator.fork(name), (-1, -1, -1), (1, 1, 1))
                scene.add(mesh, name=name, pose=pose)
            camera, pose = random_camera(generator, scene)
            frame = renderer.render(scene, (camera, pose), outputs=writer.outputs)
            frames.append(frame.color.copy())
            yield Sample(f"{seed:04}", seed, frame, scene, camera, pose, renderer)


frames = []
with tempfile.TemporaryDirectory() as folder:
    writer = CocoWriter(list(things))
    e3d.datasets.write_dataset(folder, writer, samples(writer, 3))
    written = json.loads((Path(folder) / "annotations.json").read_text())
print(len(written["images"]), "pictures,", len(written["annotations"]), "annotations")
picture = e3d.Canvas(np.hstack(frames))
