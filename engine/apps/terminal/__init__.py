"""Pictures in a terminal, also at the other end of an SSH connection, and the viewer there.

In: pixels. Out: the terminal's own graphics: kitty's, sixels or, where it has none, half blocks of
coloured text. POSIX alone: a terminal of another system has no termios.
"""
