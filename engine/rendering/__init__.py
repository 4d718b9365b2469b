"""Rendering: from a scene to a frame by way of views, draw lists, passes and the C core."""
