"""Where a view shows points, for tests."""

import numpy as np

from engine3d.stage.views.viewpoint import Sphere


def project(view, points, width, height):
    """Return the points' normalised device coordinates as the view sees them."""
    camera = view.camera(Sphere(tuple(points.mean(axis=0)), 100.0))
    clip_from_world = camera.projection((width, height)) @ np.linalg.inv(view.pose())
    clip = np.c_[points, np.ones(len(points))] @ clip_from_world.T
    return clip[:, :3] / clip[:, 3:]
