"""A projection for matplotlib's 3-D axes: what they draw shares one depth buffer.

``import engine3d.compat.matplotlib`` registers ``projection="engine3d"``. docs/matplotlib.md tells
what it draws, and what it leaves to mplot3d. Needs the extra ``matplotlib``.
"""

from ...base.optional_packages import require

require("matplotlib", __name__, "matplotlib")

import matplotlib  # noqa: E402
from matplotlib.projections import register_projection  # noqa: E402

if matplotlib.__version_info__ < (3, 11):
    raise ImportError(
        f"engine3d.compat.matplotlib needs matplotlib 3.11, not {matplotlib.__version__}"
    )

from .axes import Axes3D  # noqa: E402

__all__ = ["Axes3D"]

register_projection(Axes3D)
