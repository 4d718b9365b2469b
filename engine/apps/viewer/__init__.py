"""The viewer: its window, loop, keys, actions and panels; also a picture window.

This package imports nothing: SDL loads only when a window opens.
"""
