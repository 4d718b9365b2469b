"""Presents a model without a window: opens, lights, frames, labels and grounds it.

Nothing is imported here: Pillow loads only when a file is written.
"""
