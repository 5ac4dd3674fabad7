"""The table of docs/comparison.md."""
import math

from . import formulas
from .cases import OURS, AtLeast

NAMES = [OURS, *formulas.ALL]
BEGIN, END = "<!-- by tools/compare_simulators -->\n", "<!-- end -->\n"


def written(figure):
    """Two decimals below 10, none above; "none" where there is nothing to measure."""
    if figure is None or math.isinf(figure):
        return "none"
    if isinstance(figure, AtLeast):
        return f"&ge; {figure:g}"
    text = f"{figure:.2f}" if abs(figure) < 9.995 else f"{figure:.0f}"
    return text.replace("-0.00", "0.00")


def error(real, figure):
    """How far a figure is from the recording's; infinite where there is none."""
    if figure is None or math.isinf(figure):
        return math.inf
    return max(real - figure, 0) if isinstance(real, AtLeast) else abs(figure - real)


def nearest(row):
    """Names of the simulators that are nearest to the recording, up to rounding."""
    _, real, figures = row
    if real is None:
        return []
    errors = {name: error(real, figure) for name, figure in figures.items()}
    least = min(errors.values())
    return [name for name, e in errors.items() if e <= least + 0.005 and not math.isinf(e)]


def table(rows):
    lines = ["| metric | recording | " + " | ".join(NAMES) + " |", "|---|---" + "|---" * len(NAMES) + "|"]
    for row in rows:
        title, real, figures = row
        best = nearest(row)
        cells = [f"**{written(figures[n])}**" if n in best else written(figures[n]) for n in NAMES]
        lines.append(f"| {title} | {'no figure' if real is None else written(real)} | " + " | ".join(cells) + " |")
    judged = [row for row in rows if row[1] is not None]
    wins = [str(sum(name in nearest(row) for row in judged)) for name in NAMES]
    lines.append(f"| nearest to the recording, of {len(judged)} | | " + " | ".join(wins) + " |")
    return "\n".join(lines) + "\n"


def table_in(text):
    return text[text.index(BEGIN) + len(BEGIN):text.index(END)]


def with_table(text, new):
    return text[:text.index(BEGIN) + len(BEGIN)] + new + text[text.index(END):]


def figures_in(text):
    """The numbers of a table, cell by cell, row by row; NaN for words."""
    def number(cell):
        try:
            return float(cell.strip(" *").replace("&ge; ", ""))
        except ValueError:
            return math.nan

    return [[number(cell) for cell in line.strip("|").split("|")[1:]] for line in text.splitlines()[2:]]
