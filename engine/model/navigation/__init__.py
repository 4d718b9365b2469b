"""Walking: where one can stand in a scene, and how one moves there.

`NavigationGrid` finds the ground of any mesh or scene; `Walker` walks on it, never through a wall.
"""

from .grid import NavigationGrid
from .walker import Walker

__all__ = ["NavigationGrid", "Walker"]
