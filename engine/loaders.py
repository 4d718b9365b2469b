"""The public name of `engine3d.io.loaders`, which takes this module's place."""

import sys

from .io import loaders
from .io.loaders import *  # noqa: F403

sys.modules[__name__] = loaders
