"""The eye in the page: from the pixels of a photo to the box of a shuttlecock, in the browser.

Modules here do what `vmc_lib.where`, `vmc_lib.what` and `vmc_lib.loop.see` do, each named after the
module whose twin it is, and tests hold them to the Python. What has been learnt comes from `brain`.
"""
