"""A model that sees and reaches: vision, planning, an arm and a cerebellum.

The modules stand in the order in which the signal travels: `photos`, `boxes`, `camera` and
`marker_sheet`, `where`, `what`, `arm`, `motor`, `cerebellum`, and `loop`, which calls them in that
order. `show` draws, `data` holds what ships, and `compiled` makes plain loops fast.
"""


class NoReach(ValueError):
    """There is nothing to reach for: nothing was recognised, or it lies out of reach."""
