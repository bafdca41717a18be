"""What a demo that the page works out shows, taken out of its markup."""

import re

import numpy as np


def move(page, number, *places):
    """Move a demo's controls; what it then shows: its pictures as markup, its words."""
    box = page.locator(".vmc-demo").nth(number)
    for control, place in zip(box.locator("[data-stride]").all(), places, strict=True):
        switch = control.get_attribute("type") == "checkbox"
        control.set_checked(bool(place)) if switch else control.fill(str(place))
    pictures = [picture.inner_html() for picture in box.locator(".vmc-picture").all()]
    return pictures, box.locator(".vmc-pictures").get_attribute("aria-label")


def numbers(markup, tag):
    """The numbers in a mark's attributes, mark by mark."""
    marks = re.findall(rf"<{tag} [^>]*>", markup)
    return [[float(n) for n in re.findall(r'="(-?[\d.]+)', mark)] for mark in marks]


def on(markup, points):
    """Where points (..., 2) of the first axes lie in the picture."""
    x0, x1, y0, y1, left, right, bottom, top = np.float64(
        re.search(r'data-axes="([^"]*)"', markup)[1].split()
    )
    size = np.float64(re.search(r'viewBox="0 0 ([\d. ]+)"', markup)[1].split())
    shares = (np.array(points) - [x0, y0]) / [x1 - x0, y1 - y0]
    return size * ([left, bottom] + shares * [right - left, top - bottom])


def polylines(markup):
    lines = re.findall(r'<polyline points="([^"]*)"', markup)
    return [np.float64([pair.split(",") for pair in line.split()]) for line in lines]


def words(markup):
    return re.findall(r"<text[^>]*>([^<]*)</text>", markup)
