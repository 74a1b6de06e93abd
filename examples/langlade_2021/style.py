"""What the figures share. Colours of Okabe and Ito, which can be told apart with any kind of colour vision."""
import io

import matplotlib
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib import ticker  # noqa: E402

BLACK, GREY = "#000000", "#7f7f7f"
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"


def legend_below(panel, columns):
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncol=columns, frameon=False, handlelength=2.6)


def figure_legend(figure, panel, columns, below=0.02):
    """Of one panel, below all of them."""
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, below), ncol=columns, frameon=False, handlelength=2.6)


def plain_logarithmic(axis):
    """Ticks at 1, 2 and 5 of every decade, as numbers without powers of ten."""
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def save(figure, folder, name):
    """A PNG of 64 colours: a fourth of the bytes, and none of them says which matplotlib made it."""
    buffer = io.BytesIO()
    figure.tight_layout()
    figure.savefig(buffer, dpi=110, bbox_inches="tight", format="png")
    plt.close(figure)
    picture = Image.open(buffer).convert("RGB").quantize(64, dither=Image.Dither.NONE)
    picture.save(folder / f"{name}.png", optimize=True)
