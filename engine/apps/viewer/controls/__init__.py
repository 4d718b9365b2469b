"""What the viewer has beside the picture: bar, time line, statistics; and the ball of axes."""
