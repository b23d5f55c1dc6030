#!/usr/bin/env python3
"""Writes speed_against_error.md and its figures: report_page.py DATA_FOLDER OUTPUT_FOLDER.

Every number in the page comes from the CSV files in DATA_FOLDER; the text around them is report_template.md.
"""
import os
import subprocess
import sys

import report_figures as figures
import report_targets
from report_data import chain_methods, largest_error, library, method, named, number, panel, read, small, table, us


def machine():
    model, features = "Unknown processor", []
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
            elif line.startswith("flags"):
                features = line.split()
    vector = [name for name in ("avx2", "fma", "avx512f") if name in features]
    return "%s, %d cores (%s)" % (model, os.cpu_count(), ", ".join(vector) or "no AVX2")


def commit():
    def git(*arguments):
        return subprocess.run(("git",) + arguments, capture_output=True, text=True).stdout.strip()
    changed = git("status", "--porcelain", "--", "src", "include", "test", "CMakeLists.txt")
    return (git("rev-parse", "--short=10", "HEAD") or "unknown") + (" with uncommitted changes" if changed else "")


def quickest(rows):
    lines = []
    for start in ("warm", "cold"):
        for bound in report_targets.TIMES:
            good = sorted((row for row in panel(rows, start=start) if largest_error(row) <= bound),
                          key=lambda row: row["median_us"])
            others = [row for row in good if not row["family"].startswith("library")]
            cells = [text for row in (good[:1] + others[:1]) for text in
                     (named(row), us(row["median_us"]), small(largest_error(row)))]
            lines.append([start, "%g" % bound] + cells)
    return table(("", "error below", "quickest", "us", "its error", "quickest other method", "us", "its error"), lines)


def all_methods(rows):
    parts = []
    for segments, gravity in ((1, 1), (2, 1), (1, 0), (2, 0)):
        for start in ("warm", "cold"):
            title = "%s, %s, %s" % ("One segment" if segments == 1 else "Two segments",
                                    "gravity" if gravity else "nothing external", start)
            lines = [(named(row), us(row["median_us"]), us(row["p90_us"]), us(row["p99_us"]), small(row["pose_max"]),
                      small(row["tangent_max"]), small(row["material_max"]), "%.3g x" % row["times_common_practice"])
                     for row in panel(rows, segments, gravity, start)]
            head = ("method", "median us", "p90", "p99", "error: pose", "tangent", "material", "over common practice")
            parts.append("<details%s><summary>%s</summary>\n\n%s\n\n</details>" % (
                " open" if not parts else "", title, table(head, lines)))
    return "\n\n".join(parts)


def chain_cell(row, is_library):
    if row["solved"] == 0:
        return "fails"
    time = " / ".join(us(row[key]) for key in (("median_us", "p99_us", "max_us") if is_library else ("median_us",)))
    return time if row["solved"] == row["tried"] else "%s (%.0f %%)" % (time, 100 * row["solved"] / row["tried"])


def chain_table(chains):
    """A line for each method and path, a column for each number of segments."""
    counts = sorted({row["segments"] for row in chains})
    lines = []
    for posture, start in dict.fromkeys((row["posture"], row["start"]) for row in chains):
        for name in chain_methods(chains):
            line = [row for row in chains if (row["posture"], row["start"], row["method"]) == (posture, start, name)]
            by_count = {row["segments"]: row for row in line if row["solved"] > 0}
            one, most = by_count.get(counts[0]), by_count.get(counts[-1])
            ratio = "%.2f" % (most["median_us"] / one["median_us"] * counts[0] / counts[-1]) if one and most else ""
            lines.append([posture, start, name] + [chain_cell(row, name == "library") for row in line] +
                         [ratio, small(max(row["error_max"] for row in by_count.values())) if by_count else ""])
    return table(["", "", ""] + ["%d" % count for count in counts] +
                 ["a segment, %d over %d" % (counts[-1], counts[0]), "largest error"], lines)


def chain_failures(chains):
    """How often the library did not solve, how often what it solved missed the accuracy, and of how many."""
    ours = [row for row in chains if row["method"] == "library"]
    tried, solved, accurate = (sum(row[key] for row in ours) for key in ("tried", "solved", "accurate"))
    return {"chain_failed": "%d" % (tried - solved), "chain_missed": "%d" % (solved - accurate), "chain_tried": "%d" % tried}


def quantiles(distribution):
    keys = ("median_us", "p90_us", "p99_us", "p999_us", "max_us")
    return table(("", "updates", "median us", "p90", "p99", "p99.9", "largest", "p99 / median", "p99.9 / median"),
                 [[which, "%d" % row["updates"]] + [us(row[key]) for key in keys] +
                  ["%.2f" % row["p99_over_median"], "%.2f" % row["p999_over_median"]]
                  for which, row in distribution.items()])


def hard_cases(data, folder):
    """What hard_cases_report, drift_report and orthonormality_report found; empty when they were not run."""
    hard, draws, drift = read(data, "hard_cases"), read(data, "random_draws"), read(data, "drift")
    parts = []

    def good(row):
        return row["ok"] in (1.0, "true", "yes", "ok")

    if hard:
        head = ("case", "class", "status", "error", "estimate", "iterations", "us", "as it should be", "note")
        parts.append("## Hard cases\n\n%d of %d come out as they should; an honest status counts." % (
            sum(map(good, hard)), len(hard)))
        parts.append(table(head, [
            (row["case"], row["class"], row["status"], number(row["error"]), number(row["estimate"]),
             number(row["iterations"], "%d"), number(row["time_us"], "%.1f"), "yes" if good(row) else "**no**",
             row["note"]) for row in hard]))
    if draws:
        keys = [key for key in draws[0] if key not in ("class", "max_error")]
        parts.append("### Random draws\n\nEvery result is accurate or carries a status; one that is neither counts as "
                     "inaccurate.")
        parts.append(table(["class", "solved"] + [key.replace("_", " ") for key in keys] + ["largest error"], [
            [row["class"], "%.2f %%" % (100 * row["ok"] / max(row["draws"], 1))] +
            [number(row[key], "%d") for key in keys] + [number(row["max_error"])] for row in draws]))
    if drift:
        figures.drift(drift, folder)
        ends = {(row["policy"], row["threshold_pa"]): row for row in drift}
        parts.append("## Drift\n\n![Drift over pressure cycles](figures/drift.svg)\n\n*Random pressure cycles that end "
                     "at zero, by stepping policy.*")
        parts.append(table(("policy", "threshold, Pa", "cycles", "tip, m", "curvature, 1/m"), [
            (policy, number(threshold, "%g"), number(row["cycle"], "%d"), number(row["tip_drift_m"]),
             number(row["curvature_drift_per_m"])) for (policy, threshold), row in ends.items()]))
    rotations = read(data, "orthonormality")
    if rotations:
        figures.orthonormality(rotations, folder)
        parts.append("## Fig. 17 of the paper\n\n![Orthonormality of rotations](figures/orthonormality.svg)\n\n*How "
                     "far rotations are from orthonormal: at the tip over the number of elements, and along the rod.*")
    return "".join(part + "\n\n" for part in parts)


def main():
    data, output = sys.argv[1], sys.argv[2]
    folder = os.path.join(output, "figures")
    rows, chains, stations = read(data, "methods"), read(data, "chains"), read(data, "stations")
    shares, build = read(data, "estimate_summary")[0], read(data, "build", ";")[0]
    distribution = {row["which"]: row for row in read(data, "distribution_summary")}
    for start in ("warm", "cold"):
        figures.error_against_time(rows, start, folder)
    figures.histogram(read(data, "distribution"), distribution["updates"], folder)
    figures.against_segments(chains, folder)
    figures.against_elements(rows, folder)
    figures.estimates(read(data, "estimates"), folder)

    targets = report_targets.by_accuracy(rows) + report_targets.others(rows, stations, distribution, shares)
    common, tuned, fast = method(rows, "common practice"), method(rows, "common practice (tuned)"), library(rows, 1e-6)
    textbook, optimised = method(rows, "textbook (Till)"), method(rows, "optimised (Till)")
    counts = {key: "%d" % shares[key] for key in
              ("cases", "solved", "loaded", "out_of_range", "unstable", "not_converged")}
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "report_template.md")) as file:
        template = file.read()
    page = template.format(
        machine=machine(), compiler=build["compiler"], flags=build["flags"].strip(), commit=commit(),
        met=sum(line[3] == "met" for line in targets), targets_count=len(targets),
        targets=table(("what", "target", "measured", ""), targets), quickest=quickest(rows),
        common_us=us(common["median_us"]), tuned_us=us(tuned["median_us"]),
        common_ratio="%.0f" % (common["median_us"] / fast["median_us"]),
        tuned_ratio="%.0f" % (tuned["median_us"] / fast["median_us"]),
        library_error=small(fast["tangent_max"]), common_error=small(common["tangent_max"]),
        textbook_us=us(textbook["median_us"]), textbook_ratio="%.0f" % (textbook["median_us"] / fast["median_us"]),
        optimised_us=us(optimised["median_us"]), optimised_ratio="%.0f" % (optimised["median_us"] / fast["median_us"]),
        chains=chain_table(chains), **chain_failures(chains), all_methods=all_methods(rows),
        updates="%d" % distribution["updates"]["updates"], quantiles=quantiles(distribution),
        preemptions="%d" % distribution["updates"]["preemptions"],
        repeat_preemptions="%d" % distribution["repeats"]["preemptions"],
        stations=table(["accuracy", "5 stations", "25 stations"],
                       [["%g" % accuracy] + [us(row["median_us"]) for row in stations if row["accuracy"] == accuracy]
                        for accuracy in report_targets.TIMES]),
        reference="%g" % shares["reference"], worst_ratio="%.2g" % shares["worst_ratio"],
        ten_share="%.2f" % (100 * shares["within_ten_estimates_share"]),
        requested_share="%.2f" % (100 * shares["within_requested_share"]),
        hard_cases=hard_cases(data, folder), **counts)
    with open(os.path.join(output, "speed_against_error.md"), "w") as file:
        file.write(page)


if __name__ == "__main__":
    main()
