"""The cerebellum: calibration off-line and online, and adaptation."""
