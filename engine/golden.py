"""The public name of `engine3d.apps.golden`, which takes this module's place."""

import sys

from .apps import golden
from .apps.golden import *  # noqa: F403

sys.modules[__name__] = golden
