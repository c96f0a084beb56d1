"""What the rows of a study mean, on one page."""
