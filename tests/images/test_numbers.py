"""What the reference draws of broken and of very large things holds numbers."""

import numpy as np
from images.scenes import SCENES


def test_outputs_hold_numbers():
    """No NaN in any output; infinity only as the background's ndc_depth."""
    for name in ("broken_vertices", "broken_normals_and_uvs", "tiny_world", "giant_triangles"):
        frame = SCENES[name]().draw("scalar")
        for output in frame.outputs:
            values = getattr(frame, output)
            if output == "ndc_depth":
                values = values[frame.object_id >= 0]
            assert np.isfinite(values).all(), (name, output)
