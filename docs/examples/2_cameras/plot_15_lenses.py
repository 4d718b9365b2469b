"""
Lenses
======

This draws a scene through a fisheye of 200 degrees, and finds which thing each pixel's ray meets.

The coefficients are those of ``cv2.fisheye``; ``from_opencv`` adds the half pixel by which OpenCV
counts differently. Identities are those of rays through the pixels, also at the picture's rim.
"""

import numpy as np

import engine3d as e3d

K = np.array([[110.0, 0.0, 199.5], [0.0, 110.0, 149.5], [0.0, 0.0, 1.0]])
camera = e3d.FisheyeCamera.from_opencv(K, (-0.01, 0.002, 0.0, 0.0), max_angle=np.radians(100))
scene = e3d.Scene(background=(205, 215, 225), ambient=(110, 110, 120))
scene.add(e3d.DirectionalLight((-0.4, -1.0, -0.6), intensity=2.4))
scene.add(e3d.box((12, 0.1, 12)), translation=(0, -1, 0))
for turn in np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False):
    ring = e3d.torus(0.45, 0.15)
    ring.materials = [e3d.Material(color=tuple(0.5 + 0.45 * np.cos(turn + np.array([0, 2, 4]))))]
    scene.add(ring, translation=(2.2 * np.sin(turn), 0.1, -2.2 * np.cos(turn)))
pose = e3d.look_at((0, 0.4, 0.3), (0, 0.1, -2))
frame = e3d.render(scene, (camera, pose), size=(400, 300), outputs=("color", "object_id", "depth"))
picture = frame.canvas()

# %%
# Rays, cast into the scene:

pixels = np.stack(np.meshgrid(np.arange(400) + 0.5, np.arange(300) + 0.5), axis=-1)
origins, directions = frame.rays(pixels.reshape(-1, 2))
seen = camera.mask(frame.size)
hits = scene.raycast_many(origins[seen.ravel()], directions[seen.ravel()])
print((hits.object_id != frame.object_id[seen]).sum(), "of", seen.sum(), "pixels differ")
