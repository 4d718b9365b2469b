"""The public name of `engine3d.extras.worlds`, which takes this module's place."""

import sys

from .extras import worlds
from .extras.worlds import *  # noqa: F403

sys.modules[__name__] = worlds
