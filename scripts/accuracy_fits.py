"""Runs `calibrate` for scripts/accuracy_report and reads what it wrote."""
import bisect
import csv
import math
import os
import re
import subprocess

import yaml

GEOMETRY = ["youngs_modulus_pa", "chamber_pitch_radius_m", "length_m", "channel_azimuth_2_deg", "channel_azimuth_3_deg"]
CREEP = ["creep_share", "creep_time_s"]
MATERIAL = ["chamber_area_growth_per_pa", "pressure_stiffening"]
ARM = "config/scenes/stiff_flop_recorded.yaml"
# The source's own value; the scene's was tuned by hand on these recordings.
PRIOR = ["--prior", "youngs_modulus_pa=120000:60000"]


class Fit:
    """One run: error of every sample in m (NaN where there is none), and what calibrate printed."""

    def __init__(self, printed, residuals, scene):
        self.printed, self.scene = printed, scene
        self.rows = []
        if residuals and os.path.exists(residuals):
            with open(residuals, newline="") as file:
                self.rows = list(csv.DictReader(file))

    def errors(self, which, key="error_m"):
        return [float(row[key]) for row, wanted in zip(self.rows, which) if wanted and row[key]]

    def left_out(self):
        values = [float(row["left_out_error_m"]) for row in self.rows if row["left_out_error_m"]]
        return sum(values) / len(values) if values else math.nan


class Fitter:
    def __init__(self, program, folder):
        self.program, self.folder, self.count = program, folder, 0
        os.makedirs(folder, exist_ok=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, name, scene, arguments, parameters):
        """None when the model has no solution for these data."""
        self.count += 1
        print("  fit %d: %s" % (self.count, name), flush=True)
        stem = self.path(re.sub(r"\W+", "_", name))
        out, residuals = stem + ".yaml", stem + ".csv"
        done = subprocess.run([self.program, scene, *arguments, "-q", "-o", out, "--residuals", residuals, "-p",
                               *(parameters or ["none"])], capture_output=True, text=True)
        if done.returncode not in (0, 1):
            print("    " + done.stderr.strip().splitlines()[0] + " " + " ".join(done.stderr.split()[-20:]))
            return None
        return Fit(done.stdout, residuals, out)

    def scene_with(self, source, name, keys):
        """A scene file with more keys in every segment."""
        with open(source) as file:
            scene = yaml.safe_load(file)
        for body in scene["chain"]:
            if "segment" in body:
                body["segment"].update(keys)
        path = self.path(name + ".yaml")
        with open(path, "w") as file:
            yaml.safe_dump(scene, file)
        return path


def write_table(rows, path):
    """Measured compliances of paper_tables.yaml as calibrate reads them."""
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        chambers = len(rows[0]["pattern"])
        out.writerow(["pressure_%d_pa" % (k + 1) for k in range(chambers)] +
                     ["c%d%d_m_per_n" % (i, j) for j in (1, 2, 3) for i in (1, 2, 3)])
        for row in rows:
            out.writerow([1e5 * row["bar"] * on for on in row["pattern"]] +
                         ["%.9g" % (c / 100.0) for c in row["rows"]["Experiment"]["c"]])


def summary(errors):
    """Mean, RMS, 95th percentile and maximum in mm, and the number."""
    ordered = sorted(1e3 * e for e in errors)
    count = len(ordered)
    return (sum(ordered) / count, math.sqrt(sum(e * e for e in ordered) / count), ordered[math.ceil(0.95 * count) - 1],
            ordered[-1], count)


def cells(errors):
    return " | ".join("%.2f" % value for value in summary(errors)[:4])


class Samples:
    """Which samples of a recording are quasi-static, and which of them unloaded, as the data's README defines them, on the
    clock of a tracker that is late by `delay` s."""

    def __init__(self, path, delay=0.0):
        with open(path, newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.delay_by(rows, delay)
        self.path, self.rows = path, rows
        self.time = [row["time_s"] for row in rows]
        pressures = [[row["pressure_%d_pa_abs" % k] for k in (1, 2, 3)] for row in rows]
        self.force, self.lateral = ([math.hypot(*(row.get("force_%s_n" % axis, 0.0) for axis in axes)) for row in rows]
                                    for axes in ("xyz", "xy"))
        dropped = [False] * len(rows)
        for i, start in enumerate(self.time):
            j = i + 1
            while j < len(rows) and (j == i + 1 or self.time[j] - start <= 0.25 + 1e-9):
                if max(abs(a - b) for a, b in zip(pressures[i], pressures[j])) > 2000.0:
                    for k, t in enumerate(self.time):
                        dropped[k] = dropped[k] or start - 0.3 <= t <= self.time[j] + 1.0
                j += 1
        self.quiet = [not d and f < 0.06 for d, f in zip(dropped, self.force)]
        self.loaded = [f >= 0.06 for f in self.force]
        self.quiet_loaded = [not d and on for d, on in zip(dropped, self.loaded)]
        self.all = [True] * len(rows)

    @staticmethod
    def delay_by(rows, delay):
        """Pressures, forces and torques of each row become those of `delay` s before it."""
        if delay == 0.0:
            return
        times = [row["time_s"] for row in rows]
        for key in [key for key in rows[0] if key.startswith(("pressure_", "force_", "torque_"))]:
            values = [row[key] for row in rows]
            for row, time in zip(rows, times):
                after = min(max(bisect.bisect_right(times, time - delay), 1), len(times) - 1)
                share = min(max((time - delay - times[after - 1]) / (times[after] - times[after - 1]), 0.0), 1.0)
                row[key] = (1.0 - share) * values[after - 1] + share * values[after]

    def displacement(self, pair, start, end):
        """Of the tip, mm, from the mean before 3 s to the mean over a span, and the pair's gauge pressure there, bar."""
        def mean(key, first, last):
            values = [row[key] for row in self.rows if first <= row["time_s"] < last]
            return sum(values) / len(values)
        pressure = "pressure_%d_pa_abs" % pair
        moved = [mean("tip_%s_m" % axis, start, end) - mean("tip_%s_m" % axis, 0.0, 3.0) for axis in "xyz"]
        return 1e3 * math.hypot(*moved), 1e-5 * (mean(pressure, start, end) - mean(pressure, 0.0, 0.5))
