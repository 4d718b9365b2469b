"""The public name of `engine3d.extras.sensors`, which takes this module's place."""

import sys

from .extras import sensors
from .extras.sensors import *  # noqa: F403

sys.modules[__name__] = sensors
