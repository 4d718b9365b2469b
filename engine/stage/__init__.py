"""Presentation of a model without a window: loading, lights, framing, labels and ground.

This package imports nothing: Pillow loads only when a file is written.
"""
