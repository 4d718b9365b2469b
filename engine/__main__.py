"""Run the command line: ``python -m engine3d``."""

import sys

from .start import main

if __name__ == "__main__":
    sys.exit(main())
