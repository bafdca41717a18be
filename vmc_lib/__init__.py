"""A book that sees and reaches: vision, planning, an arm and a cerebellum.

The modules stand in the order in which the signal travels: `photos`, `where`, `what`, `arm`,
`motor`, `cerebellum`, and `loop`, which calls them in that order. `show` draws, `paper` holds the
published numbers and `ledger` sets ours beside them.
"""
