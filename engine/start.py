"""The entry point of the command ``engine3d``: it makes Ctrl-C quiet from the start.

Before a command begins there is nothing to clean up, and NumPy, which loads meanwhile, may swallow
an interrupt or print a traceback. So the process simply exits then. Nothing else is imported here.
"""

import os

INTERRUPTED = 130


def main() -> int:
    """Run the command line of the process; return the exit status."""
    try:
        import signal

        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, _leave)
        from .apps.cli import main as run
    except KeyboardInterrupt:
        return INTERRUPTED
    return run(begin=_heed_interrupts)


def _leave(number: int, frame: object) -> None:
    os._exit(INTERRUPTED)


def _heed_interrupts() -> None:
    """Make Ctrl-C raise `KeyboardInterrupt` again, now that a command begins."""
    import signal

    if signal.getsignal(signal.SIGINT) is _leave:
        signal.signal(signal.SIGINT, signal.default_int_handler)
