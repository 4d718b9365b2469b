"""What writers share: names, side files, losses."""
