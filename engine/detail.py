"""The public name of `engine3d.extras.lod`, which takes this module's place."""

import sys

from .extras import lod
from .extras.lod import *  # noqa: F403

sys.modules[__name__] = lod
