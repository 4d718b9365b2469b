"""
The same bytes everywhere
=========================

This draws a scene with every backend and several numbers of threads: all pictures are equal, to
the bit. So a test can compare their hashes.
"""

import hashlib
import math

import engine3d as e3d

scene = e3d.Scene(background=(20, 24, 32), ambient=(60, 70, 110))
for number in range(40):
    angle = 0.157 * number
    x, z = 2.0 * e3d.linalg.cos(angle), 2.0 * e3d.linalg.sin(angle)
    scene.add(e3d.icosphere(0.25), translation=(x, 0.05 * number - 1.0, z))
scene.add(e3d.PointLight(color=(255, 231, 188), intensity=5.0 * math.pi))

digests = {}
for backend in e3d.backends():
    for threads in (1, 2):
        frame = e3d.render(scene, size=(320, 200), backend=backend, threads=threads)
        digests[backend, threads] = hashlib.sha256(frame.color.tobytes()).hexdigest()
assert len(set(digests.values())) == 1
print(len(digests), "pictures, one hash")
