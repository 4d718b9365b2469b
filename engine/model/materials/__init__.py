"""What surfaces look like: materials, textures, and how colours are given and shown."""
