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
    """Predicted against observed size of deflection. series: label, colour, observed, predicted (mm)."""
    figure, axes = plt.subplots(1, len(series), figsize=(4.2 * len(series), 3.8), sharex=True, sharey=True,
                                layout="constrained", squeeze=False)
    most = max(max(observed + predicted) for _, _, observed, predicted in series)
    for ax, (label, colour, observed, predicted) in zip(axes[0], series):
        ax.plot([0, most], [0, most], color="#222222", linewidth=0.8)
        ax.plot(observed, predicted, ".", color=colour, markersize=3)
        ax.set_title(label, fontsize=10)
        ax.set_xlabel("observed deflection, mm")
    axes[0][0].set_ylabel("predicted from the measured force, mm")
    save(figure, folder, "accuracy_deflections")


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
