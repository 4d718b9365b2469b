"""How a model is presented: opened, lit, framed, labelled and grounded, without a window.

Nothing is imported here: Pillow loads only when a file is written.
"""
