"""
A scene of one's own
====================

This builds a scene of a ring and a light. Without a camera, the whole scene is shown.
"""

import engine3d as e3d

scene = e3d.Scene(background=(226, 232, 240), ambient=(137, 142, 149))
ring = e3d.torus(1.0, 0.4)
ring.materials = [e3d.Material(color=(243, 179, 124))]
scene.add(ring, rotation=e3d.linalg.euler_to_quaternion((0.6, 0.3, 0.0)))
scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.6)))

frame = e3d.render(scene, size=(480, 300), samples=4, antialiasing="msaa")

# %%
# A frame holds arrays of NumPy, and can be saved: ``frame.save("ring.png")``.

print(frame.color.shape, frame.color.dtype)

# %%
# To choose the view, add a camera: ``look_at`` says where it stands.

camera = e3d.PerspectiveCamera(yfov=0.7)
pose = e3d.look_at(eye=(1.5, 0.6, 5.0), target=(0.0, 0.0, 0.0))
turned = e3d.render(scene, (camera, pose), size=(480, 300), samples=4, antialiasing="msaa")
