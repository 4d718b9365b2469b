"""The reference draws the pictures that were looked at: golden.json keeps their hashes."""

import numpy as np
import pytest
from images import golden
from images.picture import digests
from images.scenes import SCENES

HOW = "to look: python tests/images/golden.py --pictures FOLDER; if it is meant: --update"


def test_each_picture_has_its_hashes():
    assert set(golden.load()) == set(SCENES), HOW


@pytest.mark.parametrize("name", sorted(SCENES))
def test_picture_is_as_before(name):
    frame = SCENES[name]().draw("scalar")
    assert digests(frame) == golden.load().get(name), f"the picture {name} has changed; {HOW}"


def test_outputs_hold_numbers():
    """No NaN in any output; infinity only as the background's ndc_depth."""
    for name in ("broken_vertices", "broken_normals_and_uvs", "tiny_world", "giant_triangles"):
        frame = SCENES[name]().draw("scalar")
        for output in frame.outputs:
            values = getattr(frame, output)
            if output == "ndc_depth":
                values = values[frame.object_id >= 0]
            assert np.isfinite(values).all(), (name, output)
