"""The cerebellum: calibration off-line and online, adaptation, forward models."""
