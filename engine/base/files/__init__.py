"""File utilities for any content: atomic writing, hashing, listing, change detection.

Readers and writers of models and images are in io/.
"""
