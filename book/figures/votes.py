"""The population vector: every neuron votes for the direction that it prefers, and they are summed.

The page works it out too, for any place of the reader's hand (`votes` in
page/demos/votes.js).
"""

import matplotlib.pyplot as plt
import numpy as np

from book.figures.reaching import arrows
from vmc_lib.show.markup import minus
from vmc_lib.show.palette import COLOURS


def preferred_directions(neurons, evenly):
    """Directions (neurons, 2) round the circle, evenly spread or bunched."""
    share = np.arange(neurons) / neurons
    angle = 2 * np.pi * (share if evenly else share**2)  # squared: bunched
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def votes(target, prefer):
    """A vote (n, 2) from each neuron for a reach to target (2,): its cosine along its arrow."""
    return (prefer @ np.asarray(target))[:, None] * prefer


def population_vector(target, neurons, evenly):
    """The votes' sum (2,), so scaled that it is the reach itself if they are evenly spread."""
    return 2 / neurons * votes(target, preferred_directions(neurons, evenly)).sum(axis=0)


def lean(target, neurons, evenly):
    """How far the sum points from the reach to target (2,), in degrees."""
    total = population_vector(target, neurons, evenly)
    along = total @ target / (np.linalg.norm(total) * np.linalg.norm(target))
    return np.degrees(np.arccos(min(1, along)))


def votes_plot(target=None, neurons=4, evenly=True):
    """A figure of the votes (grey), the reach (green) and the votes' sum (red); or it is empty."""
    fig, ax = plt.subplots(figsize=(4.3, 3.4))
    ax.set(xlim=(-1.9, 1.9), ylim=(-1.5, 1.5), aspect="equal")
    ax.axis("off")
    if target is not None:
        total = population_vector(target, neurons, evenly)
        over = total[1] > target[1] + 1e-6  # then its name is the upper one
        arrows(ax, [0, 0], votes(target, preferred_directions(neurons, evenly)), "grey")
        for tip, colour, words, above in (
            (target, "green", "the reach", -30 if over else 22),
            (total, "red", "the sum", 22 if over else -30),
        ):
            arrows(ax, [0, 0], tip, colour)
            look = dict(textcoords="offset points", ha="center", color=COLOURS[colour])
            ax.annotate(words, tip, (0, above), **look)
        ax.text(-1.5, 1.25, f"{lean(target, neurons, evenly):.0f}° off", ha="center")
    return fig


def votes_in_words(target, neurons, evenly):
    """The same for those who cannot see it."""
    reach = minus(", ".join(f"{x:z.2f}" for x in target))
    off = f"{lean(target, neurons, evenly):.0f}° off"
    return f"Votes of {neurons} neurons for a reach to {reach}; their sum is {off}."


def votes_in_page():
    """The same for the page to work out (see `explore`)."""
    return "votes", votes_plot, {}
