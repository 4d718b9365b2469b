"""Each camera of a renderer has a memory of its own of what its last frames showed."""

import numpy as np
from plain_picture import Renderer

import engine3d as e3d

COUNTS = ("rounds", "clusters_drawn", "clusters_occluded", "triangles_drawn", "pixels_shaded")


def wall_between_crowds():
    """Two crowds of spheres with a wall between them: each camera sees one, the other not."""
    scene = e3d.Scene()
    across, up, along = np.meshgrid(np.arange(-3.0, 4), np.arange(-2.0, 3), np.arange(1.0, 5))
    places = np.stack([across, up, along], -1).reshape(-1, 3)
    places = np.concatenate([places, places * [1, 1, -1]])
    poses = np.c_[places, np.full(len(places), 0.4)].astype(np.float32)
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(1.0, (32, 24)), poses))
    scene.add(e3d.box((9, 7, 0.2)))
    return scene


def eye_at(z):
    camera = e3d.PerspectiveCamera(yfov=0.9, znear=0.05, zfar=60)
    return camera, e3d.look_at((0, 0, z), (0, 0, 0))


def drawn(renderer, scene, eye, **options):
    frame = renderer.render(scene, eye, culling="always", **options)
    picture = frame.color if "color" in frame.outputs else frame.ndc_depth
    return [frame.stats[name] for name in COUNTS], picture.tobytes()


def test_two_cameras_in_turn_leave_out_what_two_renderers_do():
    scene, front, back = wall_between_crowds(), eye_at(8), eye_at(-8)
    together, one, other = (Renderer((320, 240), threads=1) for _ in range(3))
    depth = {"outputs": ("ndc_depth",)}
    for frame in range(8):
        in_turn = drawn(together, scene, front, **depth), drawn(together, scene, back)
        apart = drawn(one, scene, front, **depth), drawn(other, scene, back)
        assert [picture for _, picture in in_turn] == [picture for _, picture in apart]
        if frame >= 5:  # a new camera begins with what the last one saw, and tests it in turn
            assert [counts for counts, _ in in_turn] == [counts for counts, _ in apart]
    assert all(counts[COUNTS.index("clusters_occluded")] > 100 for counts, _ in in_turn)


def test_a_new_camera_each_frame_begins_with_what_the_last_one_saw():
    scene, kept = wall_between_crowds(), eye_at(8)
    fresh, steady = Renderer((320, 240), threads=1), Renderer((320, 240), threads=1)
    cameras = []
    for _ in range(12):  # more than the renderer remembers
        cameras.append(eye_at(8))
        assert drawn(fresh, scene, cameras[-1]) == drawn(steady, scene, kept)
