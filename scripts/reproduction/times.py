"""Table 7: computational times."""
import numpy

import report_page
from report_data import small, table

from .bending import PANELS, TABLE_4
from .ellipsoids import FIGURE_8, FIGURE_9
from .robot import MODELS, PATTERN, sweep
from .section import Section


def configurations(context):
    """Row of Table 7: scene (None: that of the model) and pressures, the largest last."""
    one = {"Figure 6(a)": sweep(PATTERN["one pair"], 1.5, 0.3),
           "Figure 6(b)": sweep(PATTERN["two pairs, +x"], 1.5, 0.3)}
    for panel, (pattern, largest) in FIGURE_8.items():
        one["Figure 8(%s)" % panel] = sweep(PATTERN[pattern], largest, 0.3)
    for panel, (pattern, largest) in PANELS.items():
        one["Figure " + panel] = sweep(PATTERN[pattern], largest, 0.15)
    for panel, rows in TABLE_4.items():  # the rise to the largest pressure of the last pattern, every second step
        one["Figure " + panel] = rows[-41:-20:2]
    ends = (0.0, 0.5, 1.0)
    one["Figure 10"] = [[p, p, q, q, r, r] for p in ends for q in ends for r in ends]
    two = {"Figure 9(%s)" % panel: sweep(pattern, 1.2, 0.3) for panel, pattern in FIGURE_9.items()}
    for name, into in (("table_5", one), ("table_6", two)):
        into["Table " + name[-1]] = [[case["bar"] * share for share in case["pattern"]] for case in context.paper[name]]
    found = {name: (None, rows) for name, rows in one.items()}
    found.update({name: ("paper_two_segments", rows) for name, rows in two.items()})
    found["Table 6"] = ("paper_two_segments_table6", found["Table 6"][1])
    return found


def measure(context, model, scene, rows, seconds):
    """Method: (mean us, us of the last row, largest error)."""
    measured = context.programs.run(
        "model_times", [context.programs.scene(scene or MODELS[model]), model.lower(), "%g" % seconds],
        context.programs.table(rows))
    found = {}
    for method in ("library", "common_practice"):
        lines = [line for line in measured if line["method"] == method]
        good = [line for line in lines if line["us"]]
        if good:
            found[method] = (float(numpy.mean([float(line["us"]) for line in good])),
                             float(lines[-1]["us"]) if lines[-1]["us"] else float("nan"),
                             max(float(line["error"]) for line in good), len(lines) - len(good))
    return found


def table7(context):
    section = Section("table7", "Table 7: computational times", text=(
        "One cold solve with pose and compliance, averaged over the pressures of the figure or table, and at its "
        "largest pressure. The paper: MATLAB R2019 on an Intel i7, with 50 elements. Ours: this machine, single "
        "thread, processor time, default accuracy, median of many; the error is the largest over the pressures, of "
        "pose and both compliances, relative to a solve at 1e-12. Since times on two machines say little, the paper's "
        "own method is measured in the same run, in turns with ours: RK4 with 50 steps, shooting on the base wrench "
        "with finite differences, in C++ (`common practice`, NCM only; it also solves six times again for the "
        "tangent, which ours includes and the paper's does not have). %s. Table 6 is without "
        "weight here, so that ours takes the closed form." % report_page.machine()))
    lines, ratios, slower, largest_error = [], [], [], 0.0
    work = configurations(context)
    for name, models in context.paper["table_7"].items():
        scene, rows = work[name]
        context.progress("table7: " + name)
        for model, (average, at_largest) in models.items():
            found = measure(context, model, scene, rows, 0.002 if context.quick else 0.04)
            mean, last, error, failed = found["library"]
            largest_error = max(largest_error, error)
            ratios.append(average / (1e-6 * mean))
            common = found.get("common_practice")
            if common:
                slower.append(common[0] / mean)
            lines.append((name, model, "%g" % average, "%g" % at_largest, "%.2f" % mean, "%.2f" % last, small(error),
                          "%.1e" % ratios[-1],
                          "%.0f us, error %s%s" % (common[0], small(common[2]),
                                                   ", %d failed" % common[3] if common[3] else "") if common else "",
                          "%.0f" % slower[-1] if common else ""))
            section.statement("%s, %s: pressures without a result" % (name, model), "", "%d of %d" % (
                failed, len(rows)), failed == 0)
    section.tables.append(table(
        ("", "model", "paper: average, s", "at the largest, s", "ours: average, us", "at the largest, us", "error",
         "paper over ours", "common practice here", "over ours"), lines))
    section.comparisons = [c for c in section.comparisons if c.holds is False]
    section.statement("largest error of ours", "", small(largest_error), largest_error < 1e-8)
    section.statement("paper over ours", "", "%.1e to %.1e" % (min(ratios), max(ratios)), min(ratios) > 1.0)
    section.statement("common practice over ours, same machine, same run", "",
                      "%.0f to %.0f" % (min(slower), max(slower)), min(slower) > 1.0)
    section.bounds = (
        "The error's bound is 1e-8: the accuracy asked for, 1e-9, is an estimate that may be off by ten. Times have no "
        "bound but that ours be the shorter ones. `docs/speed_against_error.md` has the full comparison of speed and "
        "error.")
    return section
