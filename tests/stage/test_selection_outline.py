"""Lines over a selected object do not part its outline."""

import numpy as np

from engine3d.stage.overlays.selection_outline import closed


def test_lines_within_an_object_are_filled_and_those_beside_it_stay():
    inside = np.zeros((20, 20), bool)
    inside[5:15, 5:15] = True
    lines = np.zeros_like(inside)
    lines[9:11, :] = lines[:, 12] = True
    parted = inside & ~lines
    assert (closed(parted, lines) == inside).all()
    assert (closed(parted, np.zeros_like(lines)) == parted).all()
    assert not closed(np.zeros_like(inside), lines).any()
