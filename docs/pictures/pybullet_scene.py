"""Draws the picture of docs/pybullet.md; needs the package pybullet.

    python docs/pictures/pybullet_scene.py

In: models of pybullet_data. Out: pybullet.webp in this folder: colours, depths, bodies and links.
"""

from pathlib import Path

import numpy as np
import pybullet
import pybullet_data
from PIL import Image

from engine3d.compat.pybullet import install

SIZE = 300, 320
THINGS = (
    ("plane.urdf", (0, 0, -0.63), 1.0),
    ("table/table.urdf", (0.4, 0, -0.63), 1.0),
    ("duck_vhacd.urdf", (0.6, -0.1, 0.0), 2.5),
    ("soccerball.urdf", (0.75, 0.25, 0.08), 0.16),
)
POSE = (0.4, 0.5, 0.0, -1.4, 0.0, 1.2, 0.0)


def main() -> None:
    install()
    pybullet.connect(pybullet.DIRECT)
    pybullet.setAdditionalSearchPath(pybullet_data.getDataPath())
    for name, place, scale in THINGS:
        pybullet.loadURDF(name, place, globalScaling=scale)
    arm = pybullet.loadURDF("kuka_iiwa/model.urdf", (0, 0, 0), useFixedBase=True)
    for joint, angle in enumerate(POSE):
        pybullet.resetJointState(arm, joint, angle)
    view = pybullet.computeViewMatrix((1.5, 1.1, 0.9), (0.25, 0, 0.3), (0, 0, 1))
    projection = pybullet.computeProjectionMatrixFOV(52, SIZE[0] / SIZE[1], 0.02, 12)
    links = pybullet.ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX
    _, _, colors, depths, masks = pybullet.getCameraImage(
        *SIZE, view, projection, shadow=1, lightDistance=6, flags=links
    )
    near, far = 0.02, 12.0
    metres = far * near / (far - (far - near) * depths)
    shown = np.clip(255 * (1.1 / metres) ** 0.9, 0, 255).astype(np.uint8)
    numbers, places = np.unique(masks, return_inverse=True)
    palette = np.random.default_rng(8).integers(60, 255, (len(numbers), 3)).astype(np.uint8)
    palette[numbers == -1] = 24
    objects = palette[places.reshape(masks.shape)]
    row = np.hstack([colors[..., :3], np.repeat(shown[..., None], 3, axis=2), objects])
    Image.fromarray(row).save(Path(__file__).with_name("pybullet.webp"), lossless=True, method=6)


if __name__ == "__main__":
    main()
