"""Colours and shapes of the guide's charts: Okabe and Ito (2008), told apart by colour-blind readers."""

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#8A5A83", "#E69F00", "#56B4E9", "#444444", "#A3A500")
SHAPES = ("circle", "diamond", "square", "triangle")
GREY, RULE, INK = "#666", "#ddd", "#222"


def colour(i):
    return COLOURS[i % len(COLOURS)]


def kind(i):
    return SHAPES[i % len(SHAPES)]


def number(value):
    """Three significant digits, with thousands separated."""
    if value is None:
        return "–"
    size = abs(value)
    if size >= 1e6:
        return f"{value / 1e6:.3g} M"
    if size >= 100 or value == 0:
        return f"{value:,.0f}"
    return f"{value:.1f}" if size >= 10 else f"{value:.2f}" if size >= 0.1 else f"{value:.2g}"
