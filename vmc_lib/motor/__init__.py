"""Motor planning: remembered reaches, and how they are mixed."""
