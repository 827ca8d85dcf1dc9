"""A panel of error against cost as SVG: readable without scripts, each point with its values."""
import math
from typing import NamedTuple

from studies.report.cost import Line, Panel

WIDTH, HEIGHT = 760, 440
LEFT, RIGHT, TOP, BOTTOM = 66, 18, 16, 50
#: paths of marks around (0, 0); colours are classes c0 to c7 of the style sheet
MARKS = ("M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z", "M-4.5,-4.5h9v9h-9z", "M0,-6L5.5,4.5H-5.5z",
         "M0,-6.5L5.5,0L0,6.5L-5.5,0z", "M0,6L5.5,-4.5H-5.5z",
         "M-2,-5.5h4v3.5h3.5v4h-3.5v3.5h-4v-3.5h-3.5v-4h3.5z", "M-6,0L4.5,-5.5V5.5z",
         "M0,-6.5L1.8,-2H6.2L2.8,1L4,5.8L0,3.2L-4,5.8L-2.8,1L-6.2,-2H-1.8z")
DASHES = ("", "6 3", "8 3 2 3", "2 3", "10 3", "4 2", "1 2", "12 4")


class Scale(NamedTuple):
    """A logarithmic axis from low to high onto pixels."""
    low: float
    high: float
    start: float
    end: float

    def __call__(self, value: float) -> float:
        """Pixels; what lies outside stays on the edge."""
        inside = min(max(value, self.low), self.high)
        share = math.log(inside/self.low)/math.log(self.high/self.low)
        return round(self.start + share*(self.end - self.start), 1)

    @property
    def ticks(self) -> list[tuple[float, float]]:
        """(value, pixel): 1, 2, 5 of each power of ten, powers alone where these are many."""
        first = math.floor(math.log10(self.low))
        last = math.ceil(math.log10(self.high))
        steps = (1, 2, 5) if self.high < 2000*self.low else (1,)
        values = [step*10.0**power for power in range(first, last + 1) for step in steps]
        return [(value, self(value)) for value in values if self.low <= value <= self.high]


class Curve(NamedTuple):
    """A series on the page."""
    line: Line
    colour: int
    mark: str
    dash: str
    path: str


class Chart(NamedTuple):
    """A panel on the page."""
    x: Scale
    y: Scale
    curves: list[Curve]


def chart(panel: Panel) -> Chart:
    """Places of everything; axes hold all seconds and the errors of usual lines, others lie on the edge."""
    seconds = [point.cpu_s for line in panel.lines for point in line.points]
    sizes = sizes_of(panel.lines)
    usual = sizes_of([line for line in panel.lines if line.usual])
    low = max(0.6*min(sizes), 0.2*min(usual))
    high = min(1.6*max(sizes), 2*max(usual))
    x = Scale(0.7*min(seconds), 1.4*max(seconds), LEFT, WIDTH - RIGHT)
    y = Scale(low, high, HEIGHT - BOTTOM, TOP)
    curves = [curve(number, line, x, y) for number, line in enumerate(panel.lines)]
    return Chart(x, y, curves)


def sizes_of(lines: list[Line]) -> list[float]:
    """Errors that a logarithmic axis can show."""
    sizes = [point.size for line in lines for point in line.points]
    return [size for size in sizes if size > 0]


def curve(number: int, line: Line, x: Scale, y: Scale) -> Curve:
    """A line and its look: after eight the marks shift by one against the colours."""
    look = MARKS[(number + number//8) % len(MARKS)]
    dash = DASHES[number % len(DASHES)]
    corners = [f"{x(point.cpu_s)},{y(point.size)}" for point in line.points]
    return Curve(line, number % 8, look, dash, f"M{'L'.join(corners)}")
