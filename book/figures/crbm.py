"""Figures of a CRBM: whitened crops, explanations, a block's chances, dreams and learning."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from book.figures.panels import legend_above, panels
from book.figures.what import grey, tiles, with_words
from reproduce.experiments.crbm_ablation import corner_share, even_tone
from vmc_lib.show import dot_plot, photo_view
from vmc_lib.show.palette import COLOURS

MIDDLE = slice(80, 120)  # of a crop
FREE = slice(7, 14)  # of a patch of 21 pixels: what a clamp of n_w - 1 = 7 leaves free


def bitmap(rows):
    """A picture (1, 1, height, width): rows of "." for 0 and "#" for 1."""
    return np.array([[[[float(c == "#") for c in row] for row in rows.split()]]])


def whitening_view(crop, white):
    """A crop (200, 200), and beside it what whitening leaves, with the mean of its middle."""
    square = MIDDLE.start, MIDDLE.start, MIDDLE.stop, MIDDLE.stop
    mean = f"{white[MIDDLE, MIDDLE].mean():+.2f}"
    return crop, photo_view(np.uint8(255 * grey(white)), [(square, mean, "orange")])


def wave_spectra(crop, white):
    """How strong the waves of a crop (200, 200) are by frequency, and of what whitening leaves."""
    fig, ax = panels(size=(4.3, 2.8))
    for pixels, label in ((crop, "the crop"), (white, "whitened")):
        frequency, amplitude = mean_amplitudes(pixels)
        ax.loglog(frequency, amplitude / amplitude[0], label=label)
    ax.set(xlabel="frequency f (cycles a pixel)", ylabel="strength (broadest: 1)")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    legend_above(fig, 0.6)
    return fig


def mean_amplitudes(pixels):
    """Frequencies and mean amplitudes of the waves of pixels (n, n), by half octaves, of six."""
    f = np.hypot(*np.meshgrid(*[np.fft.fftfreq(len(pixels))] * 2))
    window = np.outer(*[np.hanning(len(pixels))] * 2)  # opposite edges do not meet
    amplitude = np.abs(np.fft.fft2((pixels - pixels.mean()) * window))
    limits = 0.5 * 2.0 ** np.arange(-6, 0.1, 0.5)
    bins = [(low <= f) & (f < high) for low, high in itertools.pairwise(limits)]
    return np.sqrt(limits[1:] * limits[:-1]), np.array([amplitude[b].mean() for b in bins])


def explanations_of(v, energies, chances, names, most):
    """A small picture v (height, width), and the energy and chance of each explanation of it.

    The energies' axis holds `most`.
    """
    fig, (left, right) = plt.subplots(1, 2, figsize=(6.8, 2.3), layout="none")
    fig.subplots_adjust(left=0.32, right=0.97, bottom=0.13, top=0.88, wspace=0.75)
    picture = left.inset_axes((-1.48, 0.2, 0.72, 0.6))
    picture.pcolormesh(v, vmin=-2.1, vmax=2.1, edgecolor=COLOURS["grey"], cmap="gray")
    picture.set(title="v", xticks=[], yticks=[], aspect="equal")
    picture.invert_yaxis()
    bars = left.barh(names, energies, color=COLOURS["orange"])
    left.bar_label(bars, fmt="{:z.1f}", padding=2)  # no minus zero
    left.set(title="energy E(v, h)", xlim=(0, 1.25 * most))
    bars = right.barh(names, chances, color=COLOURS["blue"])
    right.bar_label(bars, fmt="%.2f", padding=2)
    right.set(title="p(h | v)", xlim=(0, 1.25))
    for ax in (left, right):
        ax.invert_yaxis()
    return fig


def block(chances):
    """The chances of a pooling block's units and of its off state, the last, as bars."""
    colours = [COLOURS["blue"]] * 4 + [COLOURS["grey"]]
    fig, ax = _bars()
    ax.bar_label(ax.bar(range(5), chances, color=colours), fmt="%.2f")
    ax.set_title(f"pooled unit on: {1 - chances[-1]:.3f}")
    return fig


def block_in_page():
    """The same for the page to work out (see `explore`)."""
    return "block", lambda: _bars()[0], None


def _bars():
    fig, ax = plt.subplots(figsize=(4.3, 2.6))
    ax.set(xlim=(-0.6, 4.6), ylim=(0, 1.12), ylabel="probability", title=" ")
    ax.set_xticks(range(5), [*(f"unit {i}" for i in (1, 2, 3, 4)), "all off"])
    return fig, ax


def correlation(patch, dream):
    """The correlation of a patch and its dream (1, 1, 21, 21), FREE pixels; 0 with an even grey."""
    middles = [np.ravel(x[0, 0, FREE, FREE]) for x in (patch, dream)]
    return 0.0 if is_grey(dream) else float(np.corrcoef(*middles)[0, 1])


def correlations(patch, dreams):
    """The `correlation` (n,) of a patch (1, 21, 21) with each of its dreams (n, 1, 21, 21)."""
    return np.array([correlation(patch[None], dream[None]) for dream in dreams])


def is_grey(dream):
    """Whether the FREE pixels of a dream (1, 1, 21, 21) are one even grey, but for rounding."""
    return float(np.std(np.asarray(dream)[0, 0, FREE, FREE])) < 1e-6


def dream_beside(patch, dream, limit):
    """A patch, its dream, and the first less the second; black at -limit, white at limit."""
    square = 10 * np.array([FREE.start, FREE.start, FREE.stop, FREE.stop])
    words = "", f"{correlation(patch, dream):.2f}", ""
    greys = [grey(x[0, 0], limit, 10) for x in (patch, dream, patch - dream)]
    return tuple(
        photo_view(np.uint8(255 * np.array(picture)), [(square, label, "orange")])
        for picture, label in zip(greys, words, strict=True)
    )


def dream_in_words(patch, dream):
    """The same in words."""
    alike = "" if is_grey(dream) else f"; correlation {correlation(patch, dream):.2f}"
    return f"A patch, its dream, and the first less the second{alike}."


def modulation(hidden, pooled):
    """F1/F0 of hidden and of pooled units by contrast, and the border of simple and complex."""
    series = {"hidden units": hidden, "pooled units": pooled}
    fig = dot_plot(series, "complex < 1 < simple: F1/F0", xlim=(0, None))
    fig.axes[0].axvline(1, color="grey")
    return fig


def gradients(ks, distances, cosines):
    """How far CD-k is from the true gradient, and the cosine with it, over the rounds k."""
    fig, ax = panels(size=(4.3, 2.9))
    ax.plot(distances, "o-", label="distance from the true gradient")
    ax.plot(cosines, "s-", label="cosine with it (1: same direction)")
    ax.set_xticks(range(len(ks)), ks)
    ax.set(xlabel="rounds k", ylim=(0, 1.05))
    legend_above(fig, 0.6, columns=1)
    return fig


def filters(stack):
    """Filters (n, width, width), with their shares of an even tone and in the corners."""
    return with_words(tiles(stack, zoom=8), _shares(stack))


def filters_in_words(stack):
    """The same in words."""
    return f"{len(stack)} filters: {_shares(stack)}."


def _shares(stack):
    return f"even tone {even_tone(stack):.0%}, corners {corner_share(stack):.0%}"
