"""Navigation: where one can walk in a scene, and a walker that moves there.

`NavigationGrid` finds the ground of any mesh or scene; `Walker` walks on it, never through walls.
"""

from .grid import NavigationGrid
from .walker import Walker

__all__ = ["NavigationGrid", "Walker"]
