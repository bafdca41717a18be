"""A whole arm of 63 muscles, planned and calibrated by the same functions as the arm of six."""
