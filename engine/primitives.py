"""The public name of `engine3d.model.primitives`, which takes this module's place."""

import sys

from .model import primitives
from .model.primitives import *  # noqa: F403

sys.modules[__name__] = primitives
