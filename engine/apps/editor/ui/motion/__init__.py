"""The editor's motion: fields of spins, orbits, paths and keyframes, and their time line."""
