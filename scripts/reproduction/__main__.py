"""Recomputes figures and tables of Shi et al., "Stiffness modelling and analysis of soft fluidic-driven robots using
Lie theory" (IJRR 2024), and compares them with what the paper prints."""
import argparse
import os
import re
import sys
import time

import yaml

from report_data import table

from . import analyses, bending, compliance_tables, ellipsoids, times
from .robot import Programs

SECTIONS = {
    "figure6": bending.figure6, "figure7": analyses.figure7, "figure8": ellipsoids.figure8,
    "figure9": ellipsoids.figure9, "figure10": analyses.figure10, "figure12": bending.figure12,
    "figure17": analyses.figure17, "figure18": ellipsoids.figure18, "table3": bending.table3, "table4": bending.table4,
    "table5": compliance_tables.table5, "table6": compliance_tables.table6, "table7": times.table7,
}
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

PAGE = """# The paper's figures and tables, recomputed

Written by `scripts/reproduce`; do not edit. The paper: J. Shi et al., *Stiffness modelling and analysis of soft
fluidic-driven robots using Lie theory*, IJRR 2024. `scripts/reproduce --only figure8` redoes one figure or table.

What its text determines is recomputed and set beside its numbers. Its text leaves out the modulus, the pitch radius of
the chambers, the shear correction and, here and there, weight and lengths: these were inferred from its Table 5 (a set
for NCM, which LCM shares, one for NPCC, one for LPCC) and are no facts about the robot. Experiments are recordings that
it does not print. A *bound* is checked (by a test, too) and has its reason below its table; what has none is stated as
it came out.

%s

%s
"""


class Context:
    def __init__(self, programs, output, quick):
        self.programs, self.quick = programs, quick
        self.figures = os.path.join(output, "figures")
        self.data = os.path.join(output, "data") if output != os.path.join(ROOT, "docs") else os.path.join(
            ROOT, "build", "reproduction_data")
        for folder in (self.figures, self.data):
            os.makedirs(folder, exist_ok=True)
        with open(os.path.join(ROOT, "test", "data", "paper_tables.yaml")) as file:
            self.paper = yaml.safe_load(file)
        self.start = time.monotonic()

    def progress(self, text):
        print("%6.1f s  %s" % (time.monotonic() - self.start, text), flush=True)


def section_name(text):
    """figure10 for Fig. 10, fig10, "Figure 10"; table5 likewise."""
    match = re.fullmatch(r"(fig(?:ure|\.)?|tab(?:le|\.)?) *(\d+)", text.strip().lower())
    name = ("figure" if match.group(1).startswith("fig") else "table") + match.group(2) if match else text
    if name not in SECTIONS:
        raise argparse.ArgumentTypeError("%s: must be one of %s" % (text, ", ".join(SECTIONS)))
    return name


def overview(sections):
    rows = []
    for section in sections:
        checked = [c for c in section.comparisons if c.holds is not None]
        misses = [c for c in section.comparisons if c.holds is None and "does not hold" in c.difference]
        anchor = re.sub(r"[^a-z0-9 -]", "", section.title.lower()).replace(" ", "-")
        rows.append(("[%s](#%s)" % (section.title, anchor), "%d of %d" % (sum(c.holds for c in checked), len(checked)),
                     len(misses) or ""))
    return table(("", "within their bounds", "words of the paper not reproduced"), rows)


def main():
    parser = argparse.ArgumentParser(
        prog="scripts/reproduce", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="NAME is one of: %s.\nExit status: 0 done, 1 a comparison is outside its bound, 2 nothing could be "
               "done." % ", ".join(SECTIONS))
    parser.add_argument("--only", metavar="NAME", nargs="+", type=section_name,
                        help="only these, into build/reproduction; their text is printed, too")
    parser.add_argument("--quick", action="store_true", help="fewer configurations and short timings (a few seconds), "
                                                             "into build/reproduction_quick")
    parser.add_argument("--output", metavar="FOLDER", help="default: docs")
    parser.add_argument("--programs", metavar="FOLDER", help="use the programs built there instead of building")
    arguments = parser.parse_args()
    folder = "docs" if not (arguments.only or arguments.quick) else \
        "build/reproduction_quick" if arguments.quick else "build/reproduction"
    output = os.path.abspath(arguments.output) if arguments.output else os.path.join(ROOT, folder)
    programs = Programs(os.path.abspath(arguments.programs) if arguments.programs else os.path.join(ROOT, "build"),
                        os.path.join(ROOT, "config", "scenes"))
    context = Context(programs, output, arguments.quick)
    wanted = arguments.only or list(SECTIONS)
    sections = []
    for i, name in enumerate(wanted):
        context.progress("[%d/%d] %s" % (i + 1, len(wanted), name))
        sections.append(SECTIONS[name](context))
    text = "\n\n".join(section.markdown() for section in sections)
    path = os.path.join(output, "reproduction.md")
    with open(path, "w") as file:
        file.write(PAGE % (overview(sections), text))
    if arguments.only:
        print("\n" + text + "\n")
    failures = [(section.name, failure) for section in sections for failure in section.failures()]
    for name, failure in failures:
        print("OUTSIDE ITS BOUND: %s: %s: paper %s, ours %s (%s)" % (name, failure.what, failure.paper, failure.ours,
                                                                     failure.bound), file=sys.stderr)
    context.progress("wrote %s" % os.path.relpath(path))
    return 1 if failures else 0


sys.exit(main())
