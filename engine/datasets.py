"""The public name of `engine3d.apps.datasets`, which takes this module's place."""

import sys

from .apps import datasets
from .apps.datasets import *  # noqa: F403

sys.modules[__name__] = datasets
