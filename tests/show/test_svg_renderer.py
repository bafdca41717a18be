import io

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG

from vmc_lib.show import svg_renderer
from vmc_lib.show.palette import plot_style


@pytest.mark.parametrize("layout", ["constrained", "none"])
def test_renderer_equals_matplotlibs(layout):
    def plot():
        fig, axes = plt.subplots(1, 3, layout=layout)
        axes[0].semilogy([1, 20, 300], label="two\nlines, and $\\theta_1$")
        axes[0].legend(title="a legend")
        axes[0].set_title("long words $W_{ij}$", fontsize=14, weight="bold")
        axes[1].set_yticks([0, 1], ["first\nname", "second"], rotation=30)
        axes[2].imshow(np.eye(3))
        fig.suptitle("over all")
        return fig

    usual = io.StringIO()
    with plot_style(**{"svg.hashsalt": "same"}):
        FigureCanvasSVG(plot()).print_svg(usual, metadata={"Date": None})
        assert svg_renderer.figure_svg(plot()) == usual.getvalue()
    plt.close("all")


def test_font_without_metrics_is_left_to_matplotlib(monkeypatch):
    class Font:
        def get_sfnt_table(self, _):
            return None

    monkeypatch.setattr(svg_renderer, "get_font", lambda path: Font())
    svg_renderer._height.cache_clear()
    fig = plt.figure()
    fig.text(0.5, 0.5, "words")
    assert "words" in svg_renderer.figure_svg(fig)
    plt.close("all")
    svg_renderer._height.cache_clear()
