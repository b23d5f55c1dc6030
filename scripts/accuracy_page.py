"""docs/accuracy.md: accuracy_page.py CALIBRATE DATA_FOLDER OUTPUT_FOLDER SCENE_FOLDER, called by scripts/accuracy_report."""
import csv
import math
import os
import re
import shutil
import sys
import tempfile

import yaml

import accuracy_figures as figures
from accuracy_fits import ARM, CREEP, FORCE_SENSOR, GEOMETRY, MATERIAL, PRIOR, Fitter, Samples, summary, write_table

MODELS = ("LPCC", "NPCC", "LCM", "NCM")


def cells(errors):
    return " | ".join("%.2f" % value for value in summary(errors)[:4])


def met(value, target):
    return "met" if value <= target else "**missed**"


class Report:
    def __init__(self, program, data, output, scenes):
        self.fitter = Fitter(program, tempfile.mkdtemp(prefix="accuracy_"))
        self.output, self.scenes = output, scenes
        self.recordings = {name: Samples(os.path.join(data, name + ".csv")) for name in ("no_load", "load_1")}
        self.lines, self.targets = [], []

    def say(self, *lines):
        self.lines += lines

    def target(self, what, wanted, value, unit):
        self.targets.append("| %s | %.2f %s | %.2f %s | %s |" % (what, wanted, unit, value, unit, met(value, wanted)))

    # no_load has no contact and is used whole; load_1 where it is quasi-static and unloaded.
    def choice(self, recording):
        return [] if recording == "no_load" else ["--samples", "quasi_static"]

    def fit(self, name, recording, parameters, options=(), scene=ARM, blocks=8):
        return self.fitter.run(name, scene, [self.recordings[recording].path, "--blocks", str(blocks), *PRIOR, *options,
                                             *self.choice(recording)], parameters)

    # Nothing but the registration is fitted, to positions: what is reported is an error of position.
    def test(self, name, fit, recording, options=()):
        return self.fitter.run(name, fit.scene, [self.recordings[recording].path, "--blocks", "0", "--no-orientation",
                                                 *options, *self.choice(recording)], [])

    def free_motion(self):
        self.say("## Free motion", "",
                 "Tip position error in mm after registration. *Fitted*: parameters and registration from that recording.",
                 "*Tested*: parameters from the other one, only the registration (rigid, positions) refitted. The four models",
                 "have modulus, elastic length, pitch radius and the azimuths of pairs 2 and 3 to fit; *calibrated* has also",
                 "one creep mode, chambers that swell and chambers that stiffen under pressure, on top of NCM in the limit of small",
                 "steps. Published models on `no_load`: mean 2.57 to 3.06 mm.", "",
                 "| model | recording | samples | | mean | RMS | p95 | max |", "|---|---|---|---|---|---|---|---|")
        self.calibrated = {}
        shown = {}
        for model in MODELS + ("calibrated",):
            for source, other in (("no_load", "load_1"), ("load_1", "no_load")):
                if model == "calibrated":
                    fit = self.fit("calibrated on " + source, source, GEOMETRY + CREEP + MATERIAL)
                    self.calibrated[source] = fit
                    options = []
                else:
                    options = ["--model", model.lower()]
                    if model in ("NPCC", "NCM"):
                        options += ["--stepping", "fixed_step"]
                    fit = self.fit("%s on %s" % (model, source), source, GEOMETRY, options, blocks=0)
                tested = fit and self.test("%s of %s tested on %s" % (model, source, other), fit, other, options)
                for run, recording, how in ((fit, source, "fitted"), (tested, other, "tested")):
                    samples = self.recordings[recording]
                    kinds = [("quasi-static unloaded", samples.quiet)]
                    kinds.append(("all" if recording == "no_load" else "all, pushes included", samples.all))
                    for kind, which in kinds:
                        errors = run.errors(which) if run else None
                        self.say("| %s | %s | %s | %s | %s |" % (model, recording, kind, how, cells(errors) if errors
                                                                 else "no solution | | |"))
                    shown[model, recording, how] = run
        no_load, load_1 = self.recordings["no_load"], self.recordings["load_1"]
        best = shown["calibrated", "no_load", "fitted"]
        self.target("`no_load` fitted on itself, mean, all samples", 0.6, summary(best.errors(no_load.all))[0], "mm")
        self.target("`load_1` quasi-static unloaded, parameters from `no_load`, mean", 1.0,
                    summary(shown["calibrated", "load_1", "tested"].errors(load_1.quiet))[0], "mm")
        self.say("", "With each of eight blocks of `no_load` left out of the calibrated fit: mean %.2f mm over all samples."
                 % (1e3 * best.left_out()), "", "![](figures/accuracy_no_load.svg)", "", "![](figures/accuracy_load_1.svg)", "")
        self.say("The two sessions themselves differ. Without any model, from the rest before 3 s to the end of a plateau of one pair",
                 "alone, the tip moved by", "")
        for pair, spans in ((1, (("no_load", 27.3, 27.9), ("load_1", 9.5, 10.3))),
                            (3, (("no_load", 31.0, 31.4), ("load_1", 34.0, 34.8)))):
            self.say("- pair %d: %s." % (pair, "; ".join("%.1f mm at %.3f bar in `%s` (%g to %g s)" % (
                *self.recordings[name].displacement(pair, start, end), name, start, end) for name, start, end in spans)))
        self.say("", "No model with the same parameters can give both; part of the difference goes into the registration.", "")
        for recording, how, file in (("no_load", "fitted", "no_load"), ("load_1", "tested", "load_1")):
            figures.over_time([("NCM", "#888888", shown["NCM", recording, how]),
                               ("calibrated on no_load", "#c1121f", shown["calibrated", recording, how])],
                              self.recordings[recording], "%s, %s" % (recording, how), os.path.join(self.output, "figures"),
                              "accuracy_" + file)
        self.say("What the calibration on `no_load` says:", "", "```", re.sub(r"; [\d.]+ s$", "", best.printed, 1, re.M).replace(os.path.dirname(
            no_load.path) + "/", "").strip(), "```", "")
        self.keep_scene(best.scene, no_load.path)

    # Without the folders of this machine, which nobody else has.
    def keep_scene(self, path, recording):
        with open(path) as file:
            text = file.read()
        for folder in (os.path.dirname(recording), self.fitter.folder):
            text = text.replace(folder + "/", "")
        text = re.sub(r"^(# converged); .* s$", r"\1", text, 1, re.M)  # how long it took differs from run to run
        with open(self.fitter.path("stiff_flop_calibrated.yaml"), "w") as file:
            file.write(text)

    def materials(self):
        self.say("## Which material", "",
                 "Fits to `no_load` (mean error in mm: fitted, and with each of eight blocks left out), then tested on `load_1` with",
                 "nothing refitted but the registration (quasi-static unloaded). All with creep unless stated.", "",
                 "| material | fitted | blocks left out | tested on load_1 |", "|---|---|---|---|")
        growth, stiffening = [MATERIAL[0]], [MATERIAL[1]]
        yeoh = self.fitter.scene_with(ARM, "yeoh", {"stretch_law": "yeoh", "yeoh_c2": 0.0})
        gent = self.fitter.scene_with(ARM, "gent", {"stretch_law": "gent", "gent_limit": 10.0})
        neo_hookean = self.fitter.scene_with(ARM, "neo_hookean", {"stretch_law": "neo_hookean"})
        no_load, load_1 = self.recordings["no_load"], self.recordings["load_1"]
        for name, scene, parameters in (
                ("the paper's, without creep", ARM, []),
                ("the paper's section update", ARM, CREEP),
                ("neo-Hookean", neo_hookean, CREEP),
                ("Gent", gent, CREEP + ["gent_limit"]),
                ("Yeoh", yeoh, CREEP + ["yeoh_c2"]),
                ("the paper's, chambers stiffen", ARM, CREEP + stiffening),
                ("the paper's, chambers swell", ARM, CREEP + growth),
                ("the paper's, swell and stiffen", ARM, None),
                ("neo-Hookean, swell and stiffen", neo_hookean, CREEP + MATERIAL)):
            fit = self.calibrated["no_load"] if parameters is None else self.fit("material " + name, "no_load",
                                                                                  GEOMETRY + parameters, scene=scene)
            if fit is None:
                self.say("| %s | no solution | | |" % name)
                continue
            tested = self.test("material %s tested" % name, fit, "load_1")
            self.say("| %s | %.2f | %.2f | %s |" % (
                name, summary(fit.errors(no_load.all))[0], 1e3 * fit.left_out(),
                "%.2f" % summary(tested.errors(load_1.quiet))[0] if tested else "no solution"))
        self.say("")

    def pushes(self):
        samples = self.recordings["load_1"]
        loads = ["--loads", "predict", *FORCE_SENSOR]
        from_free = self.test("pushes from no_load", self.calibrated["no_load"], "load_1", loads)
        without = self.test("pushes from no_load without force", self.calibrated["no_load"], "load_1")
        fit = self.fitter.run("pushes fitted", ARM, [samples.path, "--loads", "fit", *FORCE_SENSOR, *PRIOR, "--no-orientation",
                                                            "--samples", "quasi_static"],
                              GEOMETRY + CREEP + MATERIAL + ["shear_modulus_pa", "link_mass_kg"])
        own = fit and self.fitter.run("pushes fitted, registered unloaded", fit.scene,
                                      [samples.path, "--blocks", "0", "--no-orientation", *loads, "--samples", "quasi_static"], [])
        own_without = fit and self.test("pushes fitted without force", fit, "load_1")
        self.say("## Pushes", "",
                 "The samples of `load_1` with a measured force of at least 0.06 N. The registration is fitted to quasi-static",
                 "unloaded samples only; then the measured wrench (sensor turned by 180 deg about z, sign reversed) acts on the",
                 "model's tip. Error of the tip position in mm, of all samples under contact. The fit to the pushes is one to positions",
                 "of quasi-static samples, with shear modulus and tip mass free too; its left out errors are those of its samples.", "", "| parameters from | | mean | RMS | p95 | max |",
                 "|---|---|---|---|---|---|")
        series = []
        for label, colour, run, none in (("no_load", "#3a86ff", from_free, without),
                                         ("load_1 with its pushes", "#c1121f", own, own_without)):
            if not run or not none:
                self.say("| %s | no solution | | | | |" % label)
                continue
            self.say("| %s | without the force | %s |" % (label, cells(none.errors(samples.loaded))))
            self.say("| %s | with the force | %s |" % (label, cells(run.errors(samples.loaded))))
            observed, predicted = [], []
            for with_row, none_row, loaded in zip(run.rows, none.rows, samples.loaded):
                if loaded:
                    e0 = [float(none_row["error_%s_m" % axis]) for axis in "xyz"]
                    e1 = [float(with_row["error_%s_m" % axis]) for axis in "xyz"]
                    observed.append(1e3 * math.hypot(*e0))
                    predicted.append(1e3 * math.hypot(*(b - a for a, b in zip(e0, e1))))
            series.append((label, colour, observed, predicted))
        if fit:
            self.say("| load_1, block left out | with the force | %s |" % cells(
                fit.errors(samples.loaded, "left_out_error_m")))
        if series:
            figures.deflections(series, os.path.join(self.output, "figures"))
            self.say("", "![](figures/accuracy_deflections.svg)", "")
        if own:
            self.target("pushes of `load_1` explained by the measured force, mean (fitted on `load_1`)", 1.5,
                        summary(own.errors(samples.loaded))[0], "mm")

    def tables(self):
        with open("test/data/paper_tables.yaml") as file:
            paper = yaml.safe_load(file)
        self.say("## Measured compliances (Tables 5 and 6)", "",
                 "Errors in %: of the norm (42), and of the matrix (norm of the difference over the norm of the measured one).",
                 "*Left out*: the row had no part in the fit. Rows of this copy of the tables only.", "",
                 "| table | model and parameters | norm | norm, left out | matrix | matrix, left out |", "|---|---|---|---|---|---|")
        names = ["youngs_modulus_pa", "chamber_pitch_radius_m", "length_m", "pressure_stiffening"]
        bars = []
        for table, source, wanted in (("table_5", "paper_one_segment", 4.0), ("table_6", "paper_two_segments", 8.0)):
            rows, path = paper[table], self.fitter.path(table + ".csv")
            write_table(rows, path)
            norms = [row["rows"]["NCM"]["error"] for row in rows]
            matrices = []
            for row in rows:
                measured, model = row["rows"]["Experiment"]["c"], row["rows"]["NCM"]["c"]
                matrices.append(100.0 * math.dist(measured, model) / math.hypot(*measured))
            mean = lambda values: sum(values) / len(values)
            title = table.replace("table_", "")
            self.say("| %s | the paper's NCM (printed) | %.1f | | %.1f | |" % (title, mean(norms), mean(matrices)))
            scene = "config/scenes/%s.yaml" % source
            weightless = ["--model", "npcc", "--stepping", "continuous"]
            results = {}
            for label, options, parameters in (
                    ("standing, modulus alone", [], names[:1]),
                    ("standing, modulus, pitch radius, length", [], names[:3]),
                    ("standing, the same and stiffening chambers", [], names),
                    ("weightless, modulus alone", weightless, names[:1]),
                    ("weightless, modulus, pitch radius, length", weightless, names[:3]),
                    ("weightless, the same and stiffening chambers", weightless, names)):
                out = self.fitter.path("%s_rows.csv" % table)
                if os.path.exists(out):
                    os.remove(out)
                self.fitter.run("%s %s" % (table, label), scene, ["--compliance-table", path, "--rows", out, *options],
                                parameters)
                if not os.path.exists(out):
                    continue
                with open(out, newline="") as file:
                    result = [{k: 100.0 * float(v) for k, v in row.items() if k.endswith("error")}
                              for row in csv.DictReader(file)]
                results[label] = result
                self.say("| %s | %s | %.1f | %.1f | %.1f | %.1f |" % (title, label, *(
                    mean([row[key] for row in result])
                    for key in ("norm_error", "left_out_norm_error", "matrix_error", "left_out_matrix_error"))))
            # Chosen by the error of left out rows in the stricter norm.
            best = min(results, key=lambda label: mean([row["left_out_matrix_error"] for row in results[label]]))
            self.say("| %s | chosen by the matrix error left out: **%s** | | | | |" % (title, best))
            self.target("Table %s, mean error (42), rows left out" % title, wanted,
                        mean([row["left_out_norm_error"] for row in results[best]]), "%")
            for row, norm, fitted in zip(rows, norms, results[best]):
                bars.append(("T%s\n%g bar\n%s" % (title, row["bar"], "".join(str(on) for on in row["pattern"][::2])), norm,
                             fitted["norm_error"], fitted["left_out_norm_error"]))
        figures.tables(bars, os.path.join(self.output, "figures"))
        self.say("", "![](figures/accuracy_tables.svg)", "")

    def write(self):
        self.free_motion()
        self.materials()
        self.pushes()
        self.tables()
        head = ["# Accuracy on real robots", "",
                "Written by `scripts/accuracy_report`; do not edit. [calibration.md](calibration.md) explains the method.", "",
                "| target | wanted | measured | |", "|---|---|---|---|", *self.targets, "",
                "Choices were made by leaving blocks or rows out, but these recordings and rows have been seen by whoever made the",
                "model, so that even *tested* is not blind.", ""]
        with open(os.path.join(self.output, "accuracy.md"), "w") as file:
            file.write("\n".join(head + self.lines).rstrip() + "\n")
        shutil.copy(self.fitter.path("stiff_flop_calibrated.yaml"), os.path.join(self.scenes, "stiff_flop_calibrated.yaml"))


if __name__ == "__main__":
    Report(*sys.argv[1:5]).write()
