"""Files whatever is in them: written whole or not at all, loaded once, noticed when they change.

Animations are written here as well; models are read in loaders/ and written in writers/.
"""
