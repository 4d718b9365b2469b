"""The version of engine3d, and of its pictures, stated here alone.

The package's metadata reads the version from here. docs/versions.md says when each number grows.
"""

__version__ = "0.1.0"

#: Grows with every release that draws a picture with other bytes than the release before.
PICTURES = 2
