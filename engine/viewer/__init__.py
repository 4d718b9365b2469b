"""The window, its loop and controllers, and the same pictures without a screen.

Nothing is imported here: SDL loads only when a window opens, Pillow only when a file is written.
"""
