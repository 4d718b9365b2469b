"""Viewpoints of a model, and the controllers that move them."""
