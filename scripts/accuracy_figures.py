"""Figures of docs/accuracy.md."""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "live_stiffness", "font.size": 9, "axes.grid": True,
                     "grid.color": "#e6e6e6", "axes.axisbelow": True, "axes.spines.top": False,
                     "axes.spines.right": False, "legend.frameon": False, "font.family": "sans-serif"})
PAIRS = ("#8d6b94", "#e0a458", "#2a9134")


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name + ".svg"), bbox_inches="tight", metadata={"Date": None}, facecolor="white")
    plt.close(figure)


def over_time(fits, samples, title, folder, name):
    """Pressures, and the tip error of some fits below. fits: label, colour, Fit."""
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(9.2, 4.6), sharex=True, layout="constrained",
                                         gridspec_kw={"height_ratios": [1, 2]})
    for k, colour in enumerate(PAIRS):
        top.plot(samples.time, [1e-5 * float(row["pressure_%d_pa" % (k + 1)]) for row in fits[0][2].rows], color=colour,
                 label="pair %d" % (k + 1))
    top.set_ylabel("pressure, bar")
    top.legend(ncol=3, loc="upper right")
    for label, colour, fit in fits:
        bottom.plot(samples.time, [1e3 * e for e in fit.errors(samples.all)], color=colour, linewidth=1.1, label=label)
    for i, loaded in enumerate(samples.loaded[:-1]):
        if loaded:
            bottom.axvspan(samples.time[i], samples.time[i + 1], color="#f4f0e6", linewidth=0, zorder=0)
    bottom.set_ylim(0, 6)
    bottom.set_xlabel("time, s" + (" (shaded: pushed)" if any(samples.loaded) else ""))
    bottom.set_ylabel("tip error, mm")
    bottom.legend(loc="upper right")
    top.set_title(title, fontsize=10)
    save(figure, folder, name)


def deflections(series, folder):
    """Size of the deflection over that of the lateral force. series: label, [(N, observed mm, predicted mm)]."""
    figure, axes = plt.subplots(1, len(series), figsize=(2.7 * len(series), 3.2), sharex=True, sharey=True, layout="constrained")
    for ax, (label, points) in zip(axes, series):
        force, observed, predicted = zip(*points)
        ax.plot(force, observed, ".-", color="#222222", markersize=4, linewidth=0.5, label="observed")
        ax.plot(force, predicted, ".-", color="#c1121f", markersize=4, linewidth=0.5, label="predicted")
        ax.set_title(label, fontsize=10)
        ax.set_xlabel("measured lateral force, N")
    axes[0].set_ylabel("deflection, mm")
    axes[0].legend(loc="upper left")
    save(figure, folder, "accuracy_deflections")


def forces(rows, folder):
    """Measured and estimated force over time, base axes, with the estimate's own standard deviations."""
    time = [float(row["time_s"]) for row in rows]
    figure, axes = plt.subplots(3, 1, figsize=(9.2, 6.0), sharex=True, sharey=True, layout="constrained")
    for ax, axis in zip(axes, "xyz"):
        estimated, deviation, measured = ([float(row["%s_force_%s_n" % (kind, axis)]) for row in rows]
                                          for kind in ("estimated", "deviation", "measured"))
        for i, row in enumerate(rows[:-1]):
            if row["contact"] == "1":
                ax.axvspan(time[i], time[i + 1], color="#f4f0e6", linewidth=0, zorder=0)
        ax.fill_between(time, [e - 2.0 * d for e, d in zip(estimated, deviation)],
                        [e + 2.0 * d for e, d in zip(estimated, deviation)], color="#f4978e", alpha=0.5, linewidth=0,
                        label="two standard deviations")
        ax.plot(time, measured, color="#222222", linewidth=1.0, label="measured")
        ax.plot(time, estimated, color="#c1121f", linewidth=1.0, label="estimated")
        ax.set_ylabel("force along %s, N" % axis)
    axes[0].set_xlim(14.0, 50.0)
    axes[0].legend(ncol=3, loc="upper right")
    axes[0].set_title("load_1, base axes; lateral channels of the force sensor (shaded: contact reported)", fontsize=10)
    axes[2].set_xlabel("time, s")
    save(figure, folder, "accuracy_forces")


def tables(entries, folder):
    """Error (42) of each row of the tables. entries: label, paper's, fitted, left out (%)."""
    figure, ax = plt.subplots(figsize=(9.2, 3.4), layout="constrained")
    for k, (_, paper, fitted, left_out) in enumerate(entries):
        for offset, value, colour in ((-0.27, paper, "#888888"), (0.0, fitted, "#f4978e"), (0.27, left_out, "#c1121f")):
            if not math.isnan(value):
                ax.bar(k + offset, value, width=0.25, color=colour)
    ax.set_xticks(range(len(entries)), [entry[0] for entry in entries], fontsize=7)
    ax.set_ylabel("error of the norm (42), %")
    for label, colour in (("paper's NCM", "#888888"), ("fitted", "#f4978e"), ("row left out", "#c1121f")):
        ax.bar(0, 0, color=colour, label=label)
    ax.legend()
    save(figure, folder, "accuracy_tables")
