"""Motion: skins and morph targets that bend meshes, clips of keyframes, and what plays them."""
