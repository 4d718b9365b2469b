"""Shared code of writers: names, side files, losses."""
