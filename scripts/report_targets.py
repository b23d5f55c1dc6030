"""The goals of the project beside what was measured."""
from report_data import largest_error, library, method, us, small

# Relative error of pose and both compliances: us warm with AVX2, cold with AVX2, warm on plain x86-64.
TIMES = {1e-3: (1.0, 2.5, 3.0), 1e-6: (2.5, 5.0, 8.0), 1e-9: (4.0, 8.0, 15.0)}


def verdict(met):
    return "met" if met else "**missed**"


def by_accuracy(rows):
    lines = []
    for accuracy, times in TIMES.items():
        measured = (library(rows, accuracy), library(rows, accuracy, start="cold"),
                    library(rows, accuracy, family="library (plain x86-64)"))
        for row, target, what in zip(measured, times, ("warm, AVX2", "cold, AVX2", "warm, plain x86-64")):
            name = "error %g, %s" % (accuracy, what)
            if row is None:
                lines.append((name, "%g us" % target, "not measured", verdict(False)))
                continue
            error = largest_error(row)
            lines.append((name, "%g us" % target, "%s us, error %s" % (us(row["median_us"]), small(error)),
                          verdict(row["median_us"] <= target and error <= accuracy)))
    return lines


def others(rows, stations, distribution, shares):
    lines = []

    def add(name, target, measured, met):
        lines.append((name, target, measured, verdict(met)))

    fast = library(rows, 1e-6)
    free = library(rows, 1e-6, gravity=0)
    add("nothing external, closed form, warm", "0.3 us", us(free["median_us"]) + " us", free["median_us"] <= 0.3)
    two = library(rows, 1e-6, segments=2)["median_us"] / fast["median_us"]
    add("two segments with link, over one", "2.2", "%.2f" % two, two <= 2.2)
    more = {}
    for accuracy in (1e-3, 1e-6, 1e-9):
        at = {row["stations"]: row["median_us"] for row in stations if row["accuracy"] == accuracy}
        more[accuracy] = at[25] - at[5]
    add("20 more stations of compliance, accuracy 1e-6", "0.5 us",
        "%.2f us (1e-3: %.2f; 1e-9: %.2f)" % (more[1e-6], more[1e-3], more[1e-9]), more[1e-6] <= 0.5)
    every, medians, repeats = (distribution[which] for which in ("updates", "updates by their medians", "repeats"))
    for key, name, target in (("p99", "p99", 1.5), ("p999", "p99.9", 4.0)):
        ratio = every[key + "_over_median"]
        add("%s of %d single warm updates, over the median" % (name, every["updates"]), "%g" % target,
            "%.2f (each update by its median: %.2f; one update again and again: %.2f)" % (
                ratio, medians[key + "_over_median"], repeats[key + "_over_median"]), ratio <= target)
    for family, target in (("common practice", 150), ("textbook (Till)", 1000)):
        ratio = method(rows, family)["median_us"] / fast["median_us"]
        add("times faster than the %s, accuracy 1e-6, warm" % family, target, "%.0f" % ratio, ratio >= target)
    for key, name, target in (("within_ten_estimates_share", "10 x the estimate", 0.999),
                              ("within_requested_share", "the requested accuracy", 0.99)):
        add("random scenes with error below " + name, "%.4g %%" % (100 * target),
            "%.2f %% of %d" % (100 * shares[key], shares["solved"]), shares[key] >= target)
    return lines
