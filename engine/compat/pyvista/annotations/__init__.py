"""What lies on pictures of plotters: texts, bars, legends, numbered axes."""
