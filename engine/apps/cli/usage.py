"""The exception for wrong usage that only a command, not the parser, can see."""


class UsageError(Exception):
    """Arguments that do not go together; its text is one line and the exit status is 2."""
