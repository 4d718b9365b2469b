"""
Depths, normals and identities
==============================

This asks one frame for several arrays. Beside colour, a frame has distances, normals, positions,
and which object, material or triangle each pixel shows. They are never blended at edges.
"""

import math

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background=(230, 233, 238), ambient=(149, 149, 149))
scene.add(e3d.plane(8.0), name="floor")
scene.add(e3d.uv_sphere(0.8), name="ball", translation=(-0.9, 0.8, 0.0))
block = scene.add(e3d.box(1.2), name="box", translation=(1.0, 0.6, 0.4))
scene.add(e3d.DirectionalLight((-0.4, -1.0, -0.5), intensity=0.6 * math.pi))
camera = e3d.PerspectiveCamera(0.6), e3d.look_at((2.5, 3.0, 6.0), (0.0, 0.5, 0.0))
outputs = ("color", "depth", "world_normal", "object_id")
frame = e3d.render(scene, camera, size=(360, 240), outputs=outputs)

# %%
# Depth is the distance along the camera's axis, and 0 where nothing is. In the picture, near is
# light:

seen = frame.depth > 0
near, far = frame.depth[seen].min(), frame.depth[seen].max()
light = np.where(seen, 255 * (far - frame.depth) / (far - near), 0).astype(np.uint8)
depth_picture = e3d.Canvas(np.stack([light, light, light, np.full_like(light, 255)], axis=-1))

# %%
# An identity selects the pixels of one object. Here they give its bounding box in pixels:

rows, columns = np.nonzero(frame.object_id == block.id)
print("box:", columns.min(), rows.min(), columns.max(), rows.max())
