"""Figures of docs/speed_against_error.md, from the CSV files of speed_report and drift_report."""
import collections
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from report_data import chain_methods, largest_error, panel, pareto

plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "live_stiffness", "font.size": 9, "axes.grid": True,
                     "grid.color": "#e6e6e6", "axes.axisbelow": True, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False, "font.family": "sans-serif"})

# family: colour, marker, line width. The library stands out; families not listed here are not drawn.
STYLE = {
    "library": ("#c1121f", "o", 2.4),
    "library (plain x86-64)": ("#f4978e", "o", 1.6),
    "library by stages": ("#6a040f", "d", 1.2),
    "Magnus 6": ("#3a86ff", "^", 1.2),
    "Magnus 4": ("#00a6a6", "v", 1.2),
    "RK4 with sensitivities": ("#2a9134", "s", 1.2),
    "common practice (tuned)": ("#8d6b94", "P", 1.2),
    "common practice": ("#222222", "X", 1.2),
    "optimised (Till)": ("#bc6c25", "p", 1.2),
    "textbook (Till)": ("#888888", "*", 1.2),
    "energy minimiser": ("#3a86ff", "^", 1.2),
}


def families(rows):
    grouped = collections.OrderedDict((family, []) for family in STYLE)
    for row in rows:
        if row["family"] in grouped:
            grouped[row["family"]].append(row)
    return [(family, members) for family, members in grouped.items() if members]


def save(figure, folder, name):
    path = os.path.join(folder, name + ".svg")
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None}, facecolor="white")
    plt.close(figure)


def legend_above(figure, axes, columns):
    handles, labels = {}, []
    for ax in axes:
        for handle, label in zip(*ax.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    labels = list(handles)
    figure.legend([handles[label] for label in labels], labels, loc="lower center", bbox_to_anchor=(0.5, 1.0),
                  ncol=columns, columnspacing=1.4, handletextpad=0.5)


def label_points(ax, members, colour, left):
    """Accuracy or stages beside each point; points that lie on one another share a label."""
    spots = []
    for row in members:
        text = row["variant"].replace("accuracy 0.001", "1e-3").replace("accuracy ", "").replace("e-0", "e-")
        text = text.replace(" stages", "")
        time, error = row["median_us"], largest_error(row)
        for spot in spots:
            if abs(math.log(time / spot[0])) < 0.5 and abs(math.log(error / spot[1])) < 1.5:
                spot[2].append(text)
                break
        else:
            spots.append((time, error, [text]))
    for time, error, texts in spots:
        ax.annotate(", ".join(texts), (time, error), fontsize=7, color=colour, xytext=(-6, 0) if left else (6, 1),
                    textcoords="offset points", ha="right" if left else "left", va="center")


def error_against_time(rows, start, folder):
    figure, grid = plt.subplots(2, 2, figsize=(9.2, 7.2), sharex=True, sharey=True, layout="constrained")
    for ax, (segments, gravity) in zip(grid.flat, [(1, 1), (2, 1), (1, 0), (2, 0)]):
        shown = panel(rows, segments, gravity, start)
        front = pareto(shown)
        if front:  # everything up and right of the front is beaten by something
            times, errors = [row["median_us"] for row in front], [largest_error(row) for row in front]
            ax.fill_between(times + [1e6], errors + [errors[-1]], 1e3, step="post", color="#fdf0d5", zorder=0)
            ax.step(times + [1e6], errors + [errors[-1]], where="post", color="#e0a458", linewidth=1.4, zorder=1,
                    label="Pareto front (shaded: beaten in both)")
        for family, members in families(shown):
            colour, marker, width = STYLE[family]
            members = sorted(members, key=lambda row: row["median_us"])
            ax.plot([row["median_us"] for row in members], [largest_error(row) for row in members], color=colour,
                    marker=marker, linewidth=width, markersize=6, label=family, zorder=4 if "library" in family else 3)
            if family in ("library (plain x86-64)", "library by stages"):
                label_points(ax, members, colour, left=family == "library by stages")
        ax.set_title("%s, %s" % ("one segment" if segments == 1 else "two segments",
                                 "gravity" if gravity else "nothing external"), fontsize=10)
        ax.set_xscale("log")
        ax.set_yscale("log")
    low = min(row["median_us"] for row in rows)
    high = max(row["median_us"] for row in rows)
    grid[0, 0].set_xlim(low / 3.0, high * 1.6)
    grid[0, 0].set_ylim(1e-15, 3e-2)
    for ax in grid[1]:
        ax.set_xlabel("time of an update, us (median, %s)" % start)
    for ax in grid[:, 0]:
        ax.set_ylabel("largest relative error of\npose and compliances")
    legend_above(figure, grid.flat, 4)
    save(figure, folder, "error_against_time_" + start)


def histogram(bins, summary, folder):
    figure, ax = plt.subplots(figsize=(7.5, 3.4), layout="constrained")
    updates = [row for row in bins if row["which"] == "updates"]
    repeats = [row for row in bins if row["which"] == "repeats"]
    ax.bar([row["from_us"] for row in updates], [row["count"] for row in updates],
           width=[row["to_us"] - row["from_us"] for row in updates], align="edge", color="#c1121f", label="updates")
    ax.plot([row["from_us"] for row in repeats], [row["count"] for row in repeats], drawstyle="steps-post", color="#222222",
            linewidth=0.9, label="one update again and again: the machine's own tail")
    ax.legend(loc="center right")
    ax.set_xscale("log")
    ax.set_yscale("log")
    top = max(row["count"] for row in updates)
    ax.set_ylim(0.7, 80 * top)
    for key, label, height in (("median_us", "median", 60 * top), ("p99_us", "99 %", 20 * top),
                               ("p999_us", "99.9 %", 60 * top)):
        ax.axvline(summary[key], color="#222222", linewidth=0.8, linestyle="--")
        time = "%.3g" % summary[key] if summary[key] < 1000 else "%.0f" % summary[key]
        ax.text(summary[key], height, " %s: %s us" % (label, time), va="top", fontsize=8)
    ax.set_xlabel("time of one update, us")
    ax.set_ylabel("updates")
    save(figure, folder, "update_times")


def against_segments(chains, folder):
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.6), sharey=True, layout="constrained")
    for ax, posture in zip(axes, ("hanging", "standing")):
        for method in chain_methods(chains):
            colour, marker, width = STYLE[method]
            for start, line in (("warm", "-"), ("cold", "--")):
                rows = [row for row in chains if row["solved"] > 0 and
                        (row["posture"], row["start"], row["method"]) == (posture, start, method)]
                ax.plot([row["segments"] for row in rows], [row["median_us"] for row in rows], color=colour,
                        marker=marker, linewidth=width, linestyle=line, markersize=5, label="%s, %s" % (method, start))
        counts = sorted({int(row["segments"]) for row in chains})
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xticks(counts, [str(count) for count in counts])
        ax.minorticks_off()
        ax.set_xlabel("segments, " + posture)
    axes[0].set_ylabel("time of an update, us (median)")
    legend_above(figure, axes, 3)
    save(figure, folder, "against_segments")


def against_elements(rows, folder):
    figure, ax = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
    for family, members in families(panel(rows, 1, 1, "warm")):
        if family in ("Magnus 4", "Magnus 6", "RK4 with sensitivities", "library by stages"):
            colour, marker, width = STYLE[family]
            label = family.replace("library by stages", "library, one element: stages")
            ax.plot([row["resolution"] for row in members], [row["median_us"] for row in members], color=colour,
                    marker=marker, linewidth=width, label=label)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("steps, elements or stages of the segment")
    ax.set_ylabel("time of an update, us (median, warm)")
    ax.legend()
    save(figure, folder, "against_elements")


def estimates(rows, folder):
    figure, ax = plt.subplots(figsize=(5.6, 4.4), layout="constrained")
    solved = [row for row in rows if row["status"] == "ok" and row["reference_status"] == "ok" and row["loaded"] == 1]
    floor = 1e-16
    some = solved[::1 + len(solved) // 600]
    ax.plot([row["estimate"] for row in some], [max(row["error"], floor) for row in some], ".", markersize=2.5,
            color="#3a86ff", alpha=0.6)
    line = [1e-14, 1e-2]
    ax.plot(line, line, color="#222222", linewidth=0.8)
    ax.plot(line, [10 * x for x in line], color="#222222", linewidth=0.8, linestyle="--")
    ax.text(3e-4, 1.6e-4, "error = estimate", fontsize=8, va="top")
    ax.text(1.5e-4, 3e-3, "10 x", fontsize=8, ha="right")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("numerical_error")
    ax.set_ylabel("true error")
    save(figure, folder, "estimates")


def drift(rows, folder):
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.4), layout="constrained")
    lines = collections.OrderedDict()
    for row in rows:
        lines.setdefault((row["policy"], row["threshold_pa"]), []).append(row)
    for ax, key, label in ((axes[0], "tip_drift_m", "drift of the tip, m"),
                           (axes[1], "curvature_drift_per_m", "drift of the curvature, 1/m")):
        for (policy, threshold), line in lines.items():
            line = line[::max(1, len(line) // 200)]
            ax.plot([row["cycle"] for row in line], [row[key] for row in line], linewidth=1.4,
                    label="%s, threshold %g Pa" % (policy, threshold))
        ax.set_yscale("symlog", linthresh=1e-12)
        ax.set_xlabel("pressure cycles that end at zero")
        ax.set_ylabel(label)
    legend_above(figure, axes, 3)
    save(figure, folder, "drift")


def orthonormality(rows, folder):
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.2), sharey=True, layout="constrained")
    labels = {"rk4_figure_17": "RK4, linear, no weight (Fig. 17)", "rk4_ncm": "RK4, nonlinear, weight",
              "live_stiffness": "this library"}
    for method, label in labels.items():
        line = [row for row in rows if row["method"] == method]
        tip = [row for row in line if row["fraction"] == 1.0]
        if len(tip) > 1:
            axes[0].plot([row["elements"] for row in tip], [row["error"] for row in tip], label=label)
        finest = max((row["elements"] for row in line), default=0)
        along = [row for row in line if row["elements"] == finest]
        axes[1].plot([row["fraction"] for row in along], [max(row["error"], 1e-17) for row in along], label=label,
                     color="#c1121f" if method == "live_stiffness" else None)
    for ax in axes:
        ax.set_yscale("log")
    axes[0].set_xlabel("elements")
    axes[0].set_ylabel("orthonormality error (52)")
    axes[1].set_xlabel("fraction of the arc length")
    legend_above(figure, [axes[1]], 3)
    save(figure, folder, "orthonormality")
