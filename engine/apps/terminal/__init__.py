"""Pictures and the viewer in a terminal, also over SSH.

In: pixels. Out: the terminal's own graphics: kitty's, sixels or, if it has none, half blocks of
coloured text. It needs POSIX, because other systems lack termios.
"""
