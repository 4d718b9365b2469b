"""The public name of `engine3d.base.linalg`, which takes this module's place."""

import sys

from .base import linalg
from .base.linalg import *  # noqa: F403

sys.modules[__name__] = linalg
