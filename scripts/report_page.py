#!/usr/bin/env python3
"""Writes speed_against_error.md and its figures: report_page.py DATA_FOLDER OUTPUT_FOLDER.

Every number in the page comes from the CSV files in DATA_FOLDER; what a file that is not there would say is left out.
"""
import csv
import os
import subprocess
import sys

import report_figures as figures

DATA, OUTPUT = sys.argv[1], sys.argv[2]


def read(name, delimiter=","):
    """Rows of a CSV file as dictionaries, numbers as numbers; empty when there is no such file."""
    def value(text):
        try:
            return float(text)
        except (TypeError, ValueError):
            return text
    path = os.path.join(DATA, name + ".csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file, delimiter=delimiter)]


def us(x):
    return "%.2f" % x if x < 10 else "%.1f" % x if x < 100 else "%.0f" % x


def small(x):
    return "%.1e" % x if x > 0 else "0"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def method(rows, family, variant=None, segments=1, gravity=1, start="warm"):
    """The one row of a method in a panel, or None."""
    for row in figures.panel(rows, segments, gravity, start):
        if row["family"] == family and variant in (None, row["variant"]):
            return row
    return None


def library(rows, accuracy, family="library", **where):
    return method(rows, family, "accuracy %g" % accuracy, **where)


# --- Targets ----------------------------------------------------------------------------------------------------------
def verdict(met):
    return "met" if met else "**missed**"


def accuracy_targets(rows):
    """Target times in us by error class: warm AVX2, cold AVX2, warm plain x86-64."""
    targets = {1e-3: (1.0, 2.5, 3.0), 1e-6: (2.5, 5.0, 8.0), 1e-9: (4.0, 8.0, 15.0)}
    lines = []
    for accuracy, times in targets.items():
        measured = (library(rows, accuracy), library(rows, accuracy, start="cold"),
                    library(rows, accuracy, family="library (plain x86-64)"))
        for row, target, what in zip(measured, times, ("warm, AVX2", "cold, AVX2", "warm, plain x86-64")):
            name = "error %g, %s" % (accuracy, what)
            if row is None:
                lines.append((name, "%g us" % target, "not built", "**missed**"))
                continue
            error = figures.largest_error(row)
            lines.append((name, "%g us" % target, "%s us at error %s" % (us(row["median_us"]), small(error)),
                          verdict(row["median_us"] <= target and error <= accuracy)))
    return lines


def other_targets(rows, stations, distribution, shares):
    fast = library(rows, 1e-6)
    lines = []

    def add(name, target, measured, met):
        lines.append((name, target, measured, verdict(met)))

    free = library(rows, 1e-6, gravity=0)
    add("nothing external, closed form, warm", "0.3 us", us(free["median_us"]) + " us", free["median_us"] <= 0.3)
    two = library(rows, 1e-6, segments=2)["median_us"] / fast["median_us"]
    add("two segments with link, against one", "2.2", "%.2f" % two, two <= 2.2)
    at = {row["stations"]: row["median_us"] for row in stations if row["accuracy"] == 1e-6}
    more = at[25] - at[5]
    add("20 more stations of compliance", "0.5 us", "%.2f us" % more, more <= 0.5)
    alone, every = distribution["not preempted"], distribution["all"]
    add("p99 of single warm updates, over the median", "1.5", "%.2f (%.2f without preempted blocks)" % (
        every["p99_over_median"], alone["p99_over_median"]), every["p99_over_median"] <= 1.5)
    add("p99.9 of %d warm updates, over the median" % every["updates"], "4", "%.2f (%.2f without preempted blocks)" % (
        every["p999_over_median"], alone["p999_over_median"]), every["p999_over_median"] < 4)
    for family, target in (("common practice", 150), ("textbook", 1000)):
        ratio = method(rows, family)["median_us"] / fast["median_us"]
        add("times faster than " + family + ", accuracy 1e-6, warm", target, "%.0f" % ratio, ratio >= target)
    ten, asked = shares["within_ten_estimates_share"], shares["within_requested_share"]
    count = "%.2f %% of " + "%d" % shares["solved"]
    add("random scenes with error below 10 x estimate", "99.9 %", count % (100 * ten), ten >= 0.999)
    add("random scenes with error below the requested accuracy", "99 %", count % (100 * asked), asked >= 0.99)
    return lines


# --- Text -------------------------------------------------------------------------------------------------------------
def machine():
    model, flags = "unknown processor", ""
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
            if line.startswith("flags"):
                flags = line
    vector = [name for name in ("avx2", "fma", "avx512f") if " " + name in flags]
    return "%s, %d cores visible (%s)" % (model, os.cpu_count(), ", ".join(vector) or "no AVX2")


def commit():
    def git(*arguments):
        return subprocess.run(("git",) + arguments, capture_output=True, text=True).stdout.strip()
    # The report itself is written after the commit that it measures.
    changed = git("status", "--porcelain", "--", "src", "include", "test", "CMakeLists.txt")
    return (git("rev-parse", "--short=10", "HEAD") or "unknown") + (" with uncommitted changes" if changed else "")


def quickest(rows, start):
    """A sentence per error class: who is quickest below it."""
    lines = []
    for bound in (1e-3, 1e-6, 1e-9):
        good = sorted((row for row in figures.panel(rows, 1, 1, start) if figures.largest_error(row) <= bound),
                      key=lambda row: row["median_us"])
        others = [row for row in good if not row["family"].startswith("library")]
        best = good[0]
        cells = ["%g" % bound, "%s, %s" % (best["family"], best["variant"]), us(best["median_us"]),
                 small(figures.largest_error(best))]
        other = others[0] if others else None
        cells += ["%s, %s" % (other["family"], other["variant"]), us(other["median_us"])] if other else ["none", ""]
        lines.append([start] + cells)
    return lines


def method_table(rows, segments, gravity, start):
    return table(
        ("method", "median us", "p90", "p99", "error: pose", "tangent C", "material C", "against common practice"),
        [("%s, %s" % (row["family"], row["variant"]), us(row["median_us"]), us(row["p90_us"]), us(row["p99_us"]),
          small(row["pose_max"]), small(row["tangent_max"]), small(row["material_max"]),
          "%.3g x" % row["times_common_practice"]) for row in figures.panel(rows, segments, gravity, start)])


def figure(name, caption):
    return "![%s](figures/%s.svg)\n\n*%s*\n" % (caption.split(".")[0], name, caption)


def hard_case_section():
    page = ""
    hard, draws, drift = read("hard_cases"), read("random_draws"), read("drift")
    if hard:
        passed = sum(1 for row in hard if row["ok"] in (1.0, "true", "yes", "ok"))
        page += "\n## Hard cases\n\n%d of %d cases as they should be. An honest status counts as success.\n\n" % (
            passed, len(hard))
        page += table(("case", "class", "status", "error", "estimate", "passes", "us", "as it should be", "note"),
                      [(row["case"], row["class"], row["status"], number(row["error"]), number(row["estimate"]),
                        number(row["iterations"], "%d"), number(row["time_us"], "%.1f"),
                        "yes" if row["ok"] in (1.0, "true", "yes", "ok") else "**no**", row["note"]) for row in hard])
    if draws:
        page += "\n### Random draws\n\nEvery result is accurate or carries a status; `inaccurate` counts the ones that " \
                "are neither.\n\n"
        keys = ("class", "draws", "ok", "out_of_range", "not_converged", "unstable", "invalid_input", "inaccurate",
                "max_error", "max_iterations")
        page += table([key.replace("_", " ") for key in keys] + ["solved"],
                      [[number(row[key], "%.1e" if key == "max_error" else "%d") for key in keys] +
                       ["%.2f %%" % (100 * row["ok"] / max(row["draws"], 1))] for row in draws])
    if drift:
        figures.drift(drift, os.path.join(OUTPUT, "figures"))
        page += "\n## Drift\n\n" + figure("drift", "Drift over pressure cycles that end at zero, by stepping policy.")
        ends = {(row["policy"], row["threshold_pa"]): row for row in drift}
        page += "\n" + table(("policy", "threshold, Pa", "cycles", "tip, m", "curvature, 1/m"),
                             [(policy, number(threshold, "%g"), number(row["cycle"], "%d"), number(row["tip_drift_m"]),
                               number(row["curvature_drift_per_m"])) for (policy, threshold), row in ends.items()])
    return page


def number(x, form="%.1e"):
    return form % x if isinstance(x, float) else x


def main():
    rows, segments, stations = read("methods"), read("segments"), read("stations")
    shares, build = read("estimate_summary")[0], read("build", ";")[0]
    distribution = {row["which"]: row for row in read("distribution_summary")}
    folder = os.path.join(OUTPUT, "figures")
    for start in ("warm", "cold"):
        figures.error_against_time(rows, start, folder)
    figures.histogram(read("distribution"), distribution["all"], folder)
    figures.against_segments(segments, folder)
    figures.against_elements(rows, folder)
    figures.estimates(read("estimates"), folder)

    targets = accuracy_targets(rows) + other_targets(rows, stations, distribution, shares)
    met = sum(1 for line in targets if line[3] == "met")
    every, alone = distribution["all"], distribution["not preempted"]
    common, tuned, fast = method(rows, "common practice"), method(rows, "common practice (tuned)"), library(rows, 1e-6)
    pages = [
        "# Speed against error\n",
        "Written by `scripts/report`; do not edit. %s. Compiled by %s with `%s`. Commit %s.\n" % (
            machine(), build["compiler"], build["flags"].strip(), commit()),
        "An *update* is load stepping, statics, tip pose, 6x6 tangent and material compliance, and for the library "
        "material compliance at five stations. *Warm*: the pressures moved by 1 % since the last update; *cold*: nothing is "
        "known. Errors are the largest over a path of 128 pressures, relative to the library at accuracy 1e-12 (pose: "
        "position over length, or angle; compliance: Frobenius norm with moments scaled by length).\n",
        "## Targets\n\n%d of %d met. One segment with gravity unless said otherwise.\n" % (met, len(targets)),
        table(("what", "target", "measured", ""), targets),
        "## Which method\n",
        "Quickest method below each error, one segment with gravity, and the quickest that is not the library:\n",
        table(("", "error below", "quickest", "us", "its error", "quickest opponent", "us"),
              quickest(rows, "warm") + quickest(rows, "cold")),
        figure("error_against_time_warm", "Error against time, warm. Down and left is better; a method on the edge of the "
               "shaded region is beaten by none in both."),
        figure("error_against_time_cold", "The same, cold."),
        "The common practice (RK4 with 50 steps on rotation matrices, shooting on the base wrench with a Jacobian of forward "
        "differences, compliance by solving again under six wrenches) takes %s us warm and %s us when one Jacobian a solve "
        "serves all (\"tuned\"); the library at accuracy 1e-6 is %.0f and %.0f times faster, with a compliance that errs by "
        "%s instead of %s. All opponents use the library's load stepping, its rest-strain formulation and warm starts, and "
        "are spared the stations.\n" % (
            us(common["median_us"]), us(tuned["median_us"]), common["median_us"] / fast["median_us"],
            tuned["median_us"] / fast["median_us"], small(fast["tangent_max"]), small(common["tangent_max"])),
        "## All methods\n",
    ]
    for count, gravity in ((1, 1), (2, 1), (1, 0), (2, 0)):
        for start in ("warm", "cold"):
            pages.append("<details%s><summary>%s, %s, %s</summary>\n\n%s\n</details>\n" % (
                " open" if (count, gravity, start) == (1, 1, "warm") else "",
                "One segment" if count == 1 else "Two segments", "gravity" if gravity else "nothing external", start,
                method_table(rows, count, gravity, start)))
    pages += [
        "## Times of single updates\n",
        figure("update_times", "%d warm updates one by one, one segment with gravity, accuracy 1e-6." % every["updates"]),
        table(("", "updates", "median us", "p90", "p99", "p99.9", "largest", "p99 / median", "p99.9 / median"),
              [(row["which"], "%d" % row["updates"], us(row["median_us"]), us(row["p90_us"]), us(row["p99_us"]),
                us(row["p999_us"]), us(row["max_us"]), "%.2f" % row["p99_over_median"],
                "%.2f" % row["p999_over_median"]) for row in (every, alone)]),
        "The kernel took the processor away %d times meanwhile; the second row leaves out the blocks of 50 updates in which "
        "it did.\n" % every["preemptions"],
        "## Cost against segments and elements\n",
        figure("against_segments", "Hanging chain of paper segments with links, bending to and fro. Methods are drawn as "
               "far as they converge."),
        figure("against_elements", "Cost of resolution, one segment with gravity."),
        "Stations of material compliance, one segment with gravity, warm, us:\n",
        table(["accuracy"] + ["%d stations" % n for n in (5, 25)],
              [["%g" % accuracy] + [us(row["median_us"]) for row in stations if row["accuracy"] == accuracy]
               for accuracy in (1e-3, 1e-6, 1e-9)]),
        "## Is the error estimate true?\n",
        "%d random scenes (size, stiffness, 1 to 3 segments, links, tip offset and mass, gravity of any direction, tip "
        "wrenches, pressures from vacuum up; requested accuracy 1e-9 to 1e-3), each also solved at accuracy 1e-13: %d solved, "
        "%d of them with loads; %d out of range, %d unstable, %d not converged. The error is at most %.2g times the "
        "estimate beyond the 1e-11 that the reference is good for; it is below ten times the estimate in %.2f %% and below "
        "the requested accuracy in %.2f %% of the solved ones.\n" % (
            shares["cases"], shares["solved"], shares["loaded"], shares["out_of_range"], shares["unstable"],
            shares["not_converged"], shares["worst_ratio"], 100 * shares["within_ten_estimates_share"],
            100 * shares["within_requested_share"]),
        figure("estimates", "True error against the published estimate, scenes with loads."),
        hard_case_section(),
        "## How it is measured\n",
        "Methods of one scene take turns in slices, so that what slows the machine hits all alike. Times are processor time "
        "of the thread, in batches of about 40 us: reading the clock (350 ns) adds less than 1 %, which is not subtracted, "
        "and p90 and p99 of the quick methods are those of means over a batch. Single updates are timed by the monotonic "
        "clock, whose 45 ns are in every time. `test/benchmark/methods` has every method; a test holds each to its order and "
        "to the library's result.\n",
    ]
    with open(os.path.join(OUTPUT, "speed_against_error.md"), "w") as file:
        file.write("\n".join(part for part in pages if part))


main()
