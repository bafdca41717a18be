"""Object detection and localisation: the "where" pathway (dorsal)."""
