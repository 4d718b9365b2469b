"""The public name of `engine3d.apps.events`, which takes this module's place."""

import sys

from .apps import events
from .apps.events import *  # noqa: F403

sys.modules[__name__] = events
