"""What all tests share: demos live their test life, and browser tests find a browser."""

import os

os.environ["VMC_LIFE"] = "test"  # chapters run by nbmake inherit it
os.environ.setdefault("MPLBACKEND", "agg")
