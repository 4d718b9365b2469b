"""From a scene to a picture: cameras' views, what changed since the last frame, the call of C."""
