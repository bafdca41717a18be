"""Alternative text: what a picture shows, in words, for those who do not see it."""

import html
import re

import numpy as np

from vmc_lib.show.data_table import panels

SERIES, NAMES = 4, 12  # at most so many described one by one


def alt_text(picture):
    """What a draw function returned, in words: the data of its plots, the text in its markup.

    An image array or a scene says nothing by itself: ValueError where nothing stands beside it.
    """
    parts = picture if isinstance(picture, tuple) else (picture,)
    words = [" ".join(filter(None, map(_sentence, panels(p)))) or _labels(p) for p in parts]
    if not any(words):
        raise ValueError("a picture without words or data does not describe itself: give `alt`")
    return " ".join(filter(None, words)).replace("$", "")


def _labels(part):
    """The text in markup, label by label."""
    plain = re.sub(r"</?(?:b|em|strong)>", "", part) if isinstance(part, str) else ""
    labels = re.findall(r">\s*([^<>]*\w[^<>]*?)\s*<", plain)
    kind = "A photo with labels: " if "<image" in plain else ""
    return (kind + html.unescape("; ".join(labels))).rstrip(".") + "." if labels else ""


def _sentence(panel):
    """What a plot shows; empty where there is nothing to say."""
    brief = sum(len(one.keys) for one in panel.series) > NAMES
    clauses = [_words(panel, one, brief) for one in panel.series[:SERIES]]
    clauses += [f"and {len(panel.series) - SERIES} more"] * (len(panel.series) > SERIES)
    measure = panel.value if panel.value != "value" else ""
    subject = ": ".join(dict.fromkeys(filter(None, [panel.title, measure])))
    if not panel.named:
        subject = f"{subject or 'a plot'} against {panel.key}"
    subject = f"{subject}: " if subject else ""
    return f"{subject}{'; '.join(clauses)}." if clauses else ""


def _words(panel, one, brief):
    """What a series does: its values by name; its ends, and what lies beyond them; or its range."""
    low, high = one.values.argmin(), one.values.argmax()
    span = f"from {one.at(low)} to {one.at(high)}"
    ahead, alone = np.diff(one.keys), len(one.keys) == 1

    def point(i):
        key = panel.text(one.keys[i])
        return f"{key} {one.at(i)}" if panel.named else f"{one.at(i)} at {key}"

    if panel.named and len({*map(panel.text, one.keys)}) == 1 and not alone:
        return f"{panel.text(one.keys[0])}: {len(one.keys)} points {span}"
    if panel.named:
        text = f"from {point(low)} to {point(high)}"
        text = text if brief else ", ".join(map(point, range(len(one.keys))))
    elif alone:
        text = point(0)
    elif one.kind.endswith("dots") or not ((ahead >= 0).all() or (ahead <= 0).all()):
        across = "{} to {}".format(*map(panel.text, (one.keys.min(), one.keys.max())))
        text = f"{len(one.keys)} points {span}, {panel.key} {across}"
    else:
        text = f"from {point(0)} to {point(-1)}"
        ends = one.at(0), one.at(-1)
        beyond = [(w, i) for w, i in (("lowest", low), ("highest", high)) if one.at(i) not in ends]
        text += "".join(f", {word} {point(i)}" for word, i in beyond)
    return f"{one.name}: {text}" if one.name != panel.value else text
