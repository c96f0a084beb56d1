"""What was measured beside what the forms say, and whether it is good enough."""
import math
import statistics
from dataclasses import dataclass

UNSURE = "unsure"        # the form's own error is too large to tell
AGREEMENT = 0.95         # least share of cases
MOST_NULL = 0.10         # of cases where the form is defined
MOST_ERROR = 0.02        # median of stated errors, of the figure
MOST_ERRORS = (          # the same of figures that are not judged by their own size: how the measure starts, what is in it, the most, its unit
    ("fov ", "_deg", 0.1, "°"),
    ("likeness ", "_deg", 0.1, "°"),
    ("moire ", "_deg", 1.0, "°"),
    ("", "contrast", 0.01, ""),     # shares of 1: bands of less are not seen
    ("", "_delta_uv_", 0.002, ""),  # 0.004 is just seen
    ("crosstalk ", "worst_view", 0.05, "%"),  # which of many views is the worst is not sure
    ("mtf ", "from_green", 0.05, "%"),  # of a pixel's image: a fringe of less is not seen beside its blur
)
FEW = 20                 # of fewer cases one may disagree: 19 of 20 is the rate that is stated
A_MEDIAN = 5             # of fewer displays the median of the stated errors tells one display, not the measure
FORM_ERRORS = 3          # as many standard errors of the form are added to the stated error


@dataclass
class Case:
    """One figure of one display. form: (value, standard error), perhaps with a third number that sets the scale, None where undefined, or UNSURE. measured: None where null; absent: not in the result."""
    measure: str
    display: int
    form: tuple | str | None
    measured: float | None
    error: float = 0.0
    scale: float = 1.0   # what 2 % are taken of
    noted: bool = True   # a null has its reason
    absent: bool = False

    @property
    def counts(self):
        return self.form != UNSURE

    @property
    def null(self):
        return self.form is not None and self.measured is None

    @property
    def agrees(self):
        """A figure that lies within its stated error of the form, or null where there is none to find. Null where there is one is counted apart."""
        if self.form is None or self.measured is None:
            return self.form is None and self.measured is None
        return self.off <= self.error + FORM_ERRORS * self.form[1]

    @property
    def off(self):
        return abs(self.measured - self.form[0])

    @property
    def over(self):
        """The difference over what it may be."""
        allowed = self.error + FORM_ERRORS * self.form[1]
        return self.off / allowed if allowed > 0 else math.inf if self.off else 0.0


MAY_BE_NULL = ("likeness gradient_edge_deg",)  # a fall in likeness that pictures may not have: where they do, it must be in the right place


class Row:
    """The cases of one measure."""

    def __init__(self, measure, cases):
        self.measure = measure
        self.absent = any(c.absent for c in cases)
        self.cases = [c for c in cases if c.counts]
        self.unsure = len(cases) - len(self.cases)
        told = [c for c in self.cases if not c.null]
        both = [c for c in told if c.form is not None and c.measured is not None]
        self.undefined = sum(c.form is None for c in self.cases)
        self.nulls = sum(c.null for c in self.cases) / max(len(self.cases) - self.undefined, 1)
        self.agreement = sum(c.agrees for c in told) / len(told) if told else 1.0  # nulls alone are counted as such
        self.silent = sum(c.measured is None and not c.noted for c in self.cases)
        self.largest = max((c.over for c in both), default=0.0)
        self.goal, self.unit = next(((most, unit) for start, part, most, unit in MOST_ERRORS if measure.startswith(start) and part in measure), (MOST_ERROR, "%"))
        self.error = statistics.median(c.error / (c.scale if self.unit == "%" else 1) for c in both) if both else 0.0
        self.wrong = [c for c in told if not c.agrees]

    @property
    def faults(self):
        found = []
        if self.absent or not self.cases:
            return ["no such figure" if self.absent else "no case"]
        if self.agreement < AGREEMENT and not (len(self.wrong) == 1 and len(self.cases) < FEW):
            found.append("agreement")
        if self.silent:
            found.append(f"{self.silent} null without a reason")
        if self.measure in MAY_BE_NULL:
            return found
        if self.nulls > MOST_NULL:
            found.append("null")
        if self.error > self.goal and len({c.display for c in self.cases}) >= A_MEDIAN:
            found.append("stated error")
        return found


def rows(cases):
    by_measure = {}
    for case in cases:
        by_measure.setdefault(case.measure, []).append(case)
    return [Row(measure, found) for measure, found in by_measure.items()]


def text(table):
    """The table as Markdown."""
    lines = ["| measure | cases | undefined | agreement | largest error over stated | median stated error | null | |", "|---|---|---|---|---|---|---|---|"]
    for row in table:
        error = f"{100 * row.error:.2g} %" if row.unit == "%" else f"{row.error:.2g}{row.unit}"
        lines.append(f"| {row.measure} | {len(row.cases)} | {row.undefined} | {100 * row.agreement:.1f} % | {row.largest:.2g} | {error} | "
                     f"{100 * row.nulls:.1f} % | {', '.join(row.faults)} |")
    return "\n".join(lines)
