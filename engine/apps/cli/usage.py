"""The exception for wrong usage that a command, not the parser, detects."""


class UsageError(Exception):
    """Arguments conflict; the text is one line and the exit status is 2."""
