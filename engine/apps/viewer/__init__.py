"""The window: its loop, keys, actions and panels, and what shows a picture in one.

Nothing is imported here: SDL loads only when a window opens.
"""
