"""The public name of `engine3d.apps.notebook`, which takes this module's place."""

import sys

from .apps import notebook
from .apps.notebook import *  # noqa: F403

sys.modules[__name__] = notebook
