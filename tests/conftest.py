"""What holds for every test: Ctrl-C works, whatever started pytest."""

import signal


def pytest_configure():
    # A shell starts its background jobs with SIGINT ignored, and their children inherit that: the
    # tests that interrupt a frame or a command would wait for its end.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
