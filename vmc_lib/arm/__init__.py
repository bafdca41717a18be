"""The arm: muscles, geometry, dynamics, movement."""
