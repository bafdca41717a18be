"""The pipeline: every step that remakes what ships, what it depends on, and how steps run."""
