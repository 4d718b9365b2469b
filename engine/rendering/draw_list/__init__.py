"""The draw list: the visible objects of a scene as the core draws them, kept between frames."""
