"""A figure or table of the paper, recomputed: text, pictures, and comparisons with what the paper says."""
import dataclasses
import textwrap
import typing

from report_data import table


def wrapped(text):
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False)


@dataclasses.dataclass
class Comparison:
    what: str
    paper: str
    ours: str
    difference: str
    bound: str                      # "" where there is none
    holds: typing.Optional[bool]    # None: not checked


@dataclasses.dataclass
class Section:
    name: str    # "figure8"
    title: str   # "Figure 8: compliance ellipsoids along a segment"
    text: str = ""          # what was computed and what was inferred
    bounds: str = ""        # why the bounds are what they are
    figures: list = dataclasses.field(default_factory=list)      # (name, caption)
    tables: list = dataclasses.field(default_factory=list)       # Markdown
    comparisons: list = dataclasses.field(default_factory=list)

    def number(self, what, paper, ours, bound_percent=None, form="%.2f", unit=""):
        """Checked unless bound_percent is None."""
        difference = 100 * (ours - paper) / abs(paper)
        self.comparisons.append(Comparison(
            what, form % paper + unit, form % ours + unit, "%+.1f %%" % difference,
            "" if bound_percent is None else "%g %%" % bound_percent,
            None if bound_percent is None else bool(abs(difference) <= bound_percent)))

    def statement(self, what, paper, ours, holds, checked=True):
        """What the paper says in words. checked=False: known not to hold; said so, but no failure."""
        self.comparisons.append(Comparison(what, paper, ours, "holds" if holds else "**does not hold**",
                                           "must hold" if checked else "", bool(holds) if checked else None))

    def failures(self):
        return [c for c in self.comparisons if c.holds is False]

    def markdown(self):
        parts = ["## " + self.title, wrapped(self.text)]
        parts += ["![%s](figures/%s.svg)\n\n%s" % (self.title, name, wrapped("*" + caption + "*"))
                  for name, caption in self.figures]
        parts += self.tables
        if self.comparisons:
            parts.append(table(("", "paper", "ours", "difference", "bound"), [
                (c.what, c.paper, c.ours, c.difference, c.bound + (" **exceeded**" if c.holds is False else ""))
                for c in self.comparisons]))
        parts.append(wrapped(self.bounds))
        return "\n\n".join(part for part in parts if part)
