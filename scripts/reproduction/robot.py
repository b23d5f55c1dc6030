"""Running the programs of this package, and reading their tables. SI unless a name says otherwise; pressures in bar."""
import csv
import io
import os
import subprocess
import sys

import numpy

PATTERN = {"one pair": [1, 1, 0, 0, 0, 0], "two pairs, +x": [0, 0, 1, 1, 1, 1], "two pairs": [1, 1, 1, 1, 0, 0],
           "all": [1, 1, 1, 1, 1, 1]}
# The paper's models, and the scene with the parameters inferred for each (LCM: none of its own, those of NCM).
MODELS = {"LPCC": "paper_one_segment_lpcc", "NPCC": "paper_one_segment_npcc", "LCM": "paper_one_segment",
          "NCM": "paper_one_segment"}


def sweep(pattern, largest, step):
    """Rows of pressures, bar, from nothing to the largest."""
    count = round(largest / step)
    return [[largest * i / count * share for share in pattern] for i in range(count + 1)]


def stop(message):
    print("reproduce: " + message, file=sys.stderr)
    sys.exit(2)


class Solved:
    """A row of stiffness_solve or parallel_solve."""

    def __init__(self, row):
        self.row = row

    def numbers(self, names):
        return numpy.array([float(self.row[name]) for name in names])

    def position_cm(self, before=""):
        return 100 * self.numbers([before + axis + "_m" for axis in "xyz"])

    def bending_deg(self):
        """Angle between the tip's axis and z."""
        x, y = self.numbers(["qx", "qy"])
        return float(numpy.degrees(numpy.arccos(1 - 2 * (x * x + y * y))))

    def compliance(self, which="material", before=""):
        """Translational block of material (or tangent: "c") compliance, cm/N."""
        return 100 * self.numbers(["%s%s_%d%d" % (before, which, i, j) for i in (1, 2, 3) for j in (1, 2, 3)]
                                  ).reshape(3, 3)

    def eigenvalues(self, before=""):
        """Of the translational material compliance, ascending, cm/N."""
        return numpy.linalg.eigvalsh(self.compliance(before=before))

    def in_plane_eigenvalues(self, before=""):
        """The two in the x-z plane, in which the robot bends, ascending, cm/N."""
        block = self.compliance(before=before)[numpy.ix_([0, 2], [0, 2])]
        return numpy.linalg.eigvalsh((block + block.T) / 2)


class Programs:
    def __init__(self, folder, scenes):
        self.folder, self.scenes = folder, scenes

    def find(self, name):
        for place in (self.folder, os.path.join(self.folder, "devel/lib/live_stiffness"),
                      os.path.join(self.folder, "test")):
            path = os.path.join(place, name)
            if os.path.isfile(path) and os.access(path, os.X_OK):
                return path
        stop("%s is not built in %s" % (name, self.folder))

    def scene(self, name):
        return os.path.join(self.scenes, name + ".yaml")

    def run(self, name, arguments, table=""):
        done = subprocess.run([self.find(name)] + arguments, input=table, text=True, capture_output=True)
        if done.returncode != 0:
            stop("%s %s failed:\n%s" % (name, " ".join(arguments), done.stderr))
        return list(csv.DictReader(io.StringIO(done.stdout)))

    @staticmethod
    def table(pressures_bar, wrenches=None):
        names = ["p_%d_pa" % (i + 1) for i in range(len(pressures_bar[0]))]
        rows = [["%.17g" % (1e5 * bar) for bar in row] for row in pressures_bar]
        if wrenches:
            names += ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"]
            rows = [row + ["%.17g" % value for value in wrench] for row, wrench in zip(rows, wrenches)]
        return "\n".join(",".join(row) for row in [names] + rows) + "\n"

    def solve(self, pressures_bar, model="NCM", scene=None, wrenches=None, options=()):
        """A Solved for every row of pressures; the scene is that of the model unless named."""
        arguments = [self.scene(scene or MODELS[model]), "--model", model.lower()] + list(options)
        return [Solved(row) for row in self.run("stiffness_solve", arguments, self.table(pressures_bar, wrenches))]

    def stations(self, fractions, **arguments):
        """The same with stations; their columns start with place(segment, fraction)."""
        options = list(arguments.pop("options", ())) + ["--stations", ",".join("%g" % f for f in fractions)]
        return self.solve(options=options, **arguments)


def place(segment, fraction):
    return "s%d_%g_" % (segment, fraction)


def evenly(count):
    """Fractions for drawing a segment."""
    return [round(i / (count - 1), 6) for i in range(count)]
