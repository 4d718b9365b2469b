"""Motion: skins and morph targets that deform meshes, keyframe clips, and their player."""
