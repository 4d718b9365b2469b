"""Writing of animations and videos."""
