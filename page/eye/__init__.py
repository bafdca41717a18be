"""The eye in the page: from the pixels of a photo to the box of a shuttlecock, in the browser.

Scripts in `static` do what `vmc_lib.where`, `vmc_lib.what` and `vmc_lib.loop.see` do, each named
after the module whose twin it is, and tests hold them to the Python. What has been learnt comes
from `brain`.
"""

from pathlib import Path

STATIC = Path(__file__).parent / "static"
SEARCH_SCRIPTS, SIGHT_SCRIPTS, PLACE_SCRIPTS = (  # in the order in which they need one another
    [STATIC / f"{name}.js" for name in names.split()]
    for names in (
        "pieces colours filters segmentation appearance selective_search",
        "boxes camera unpack features product detector stream box_selection see follow",
        "markers camera_calibration marker_sheet localiser "
        "photo_marks photo_words your_photo live_photo",
    )
)
