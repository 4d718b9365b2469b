"""The public name of `engine3d.model.navigation`, which takes this module's place."""

import sys

from .model import navigation
from .model.navigation import *  # noqa: F403

sys.modules[__name__] = navigation
