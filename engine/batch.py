"""The public name of `engine3d.apps.batch`, which takes this module's place."""

import sys

from .apps import batch
from .apps.batch import *  # noqa: F403

sys.modules[__name__] = batch
