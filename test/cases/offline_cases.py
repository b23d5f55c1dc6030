#!/usr/bin/env python3
"""offline_cases.py PROGRAMS DIR [WORD]: what the programs without a master make of the inputs of make_cases.py, each beside what
is right; only those whose line has the WORD. Prints a line for each, and all failures again at the end."""
import collections
import csv
import math
import os
import pathlib
import re
import subprocess
import sys

import numpy
import rosbag
import yaml

import make_cases
from make_cases import BAGS, RECORDED, REGISTRATION

SCENE = str(make_cases.CASES / "arm.yaml")
# The option that gives a program what the node was given; calibrate had --parameters for another thing before.
NODE_PARAMETERS = {"calibrate": "--parameters"}
SAME = 0.05  # mm, by which registrations of the same samples may differ
FEW = 0.5    # mm, of those that have or lack some samples: noise and slow error of the rig
MANY = 1.0   # mm, of those that have or lack a fifth of them, or all orientations
# Tip poses at which registrations are compared: at rest, and bent to three sides; m, rotation vectors in rad.
TIPS = [((0.0, 0.0, 0.0915), (0.0, 0.0, 0.0)), ((-0.0226, -0.0175, 0.0906), (0.336, -0.434, 0.0)),
        ((0.0181, -0.0177, 0.0965), (0.331, 0.337, 0.0)), ((-0.0034, 0.0262, 0.0964), (-0.488, -0.064, 0.0))]


class Run:
    """A finished command: exit status, all that it printed, and the path of what it wrote."""

    def __init__(self, programs, folder, program, name, words, output):
        self.folder, self.output = folder, folder / output
        if self.output.exists():
            self.output.unlink()
        done = subprocess.run(["%s/%s" % (programs, program)] + words(str(self.output)), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, cwd=str(folder), timeout=120)
        self.program, self.name, self.status, self.text = program, name, done.returncode, done.stdout

    def last_words(self):
        lines = [line for line in re.split(r"[\r\n]+", self.text) if line.strip() and not re.search(r"\d %$", line)]
        return "status %d: %s" % (self.status, " / ".join(line.strip() for line in lines[:3]))


# Commands: (program, words(folder, name) -> words(output), output).

def parameters_of(program, folder, name):
    return [NODE_PARAMETERS.get(program, "--parameters"), str(folder / (name + ".yaml"))]


def scene_of(folder, name):
    return yaml.safe_load((folder / (name + ".yaml")).read_text())["scene_file"]


def register(folder, name, told):
    return lambda out: [scene_of(folder, name)] + make_cases.paths_of(folder, name) + [out] + parameters_of(
        "register_recording", folder, told or name)


def calibrate(folder, name, told):
    # With commas: calibrate takes bags without for recordings of their own.
    return lambda out: [scene_of(folder, name), ",".join(make_cases.paths_of(folder, name))] + [
        "-p", "youngs_modulus_pa", "-q", "--blocks", "0", "-o", out] + parameters_of("calibrate", folder, told or name)


def estimate_wrench(folder, name, told):
    return lambda out: [scene_of(folder, name)] + make_cases.paths_of(folder, name) + [
        "--registration", str(REGISTRATION), "-o", out] + parameters_of("estimate_wrench", folder, told or name)


def replay(folder, name, told):
    return lambda out: make_cases.paths_of(folder, name) + parameters_of("replay", folder, told or name) + [
        "-o", out, "--report", out + ".md"]


def register_table(folder, name, _):
    return lambda out: [SCENE, str(folder / (name + ".csv")), out]


OUTPUT = {register: ("register_recording", "registration_of_%s.yaml"), calibrate: ("calibrate", "scene_of_%s.yaml"),
          estimate_wrench: ("estimate_wrench", "wrench_of_%s.csv"), replay: ("replay", "replay_of_%s.bag"),
          register_table: ("register_recording", "registration_of_table_%s.yaml")}


# What is right: functions of a Run that return a fault, or nothing.

def status(*right):
    return lambda run: "" if run.status in right else "exit status %d instead of %s" % (run.status, " or ".join(map(str, right)))


def says(pattern):
    return lambda run: "" if re.search(pattern, run.text, re.I) else "does not say '%s'" % pattern


def says_once(pattern):
    def check(run):
        count = len(re.findall(pattern, run.text, re.I))
        return "" if count == 1 else "says '%s' %d times" % (pattern, count)
    return check


def rotation_of(vector):
    angle = math.sqrt(sum(c * c for c in vector))
    x, y, z = (c / max(angle, 1e-12) for c in vector)
    K = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K


def rotation_of_quaternion(q):
    half = math.acos(max(-1.0, min(1.0, q[0] / numpy.linalg.norm(q))))
    axis = numpy.array(q[1:])
    return rotation_of(2 * half * axis / max(numpy.linalg.norm(axis), 1e-12))


def sensors_of(path):
    """Where a registration says that the tracker sees the sensor for each of TIPS, mm."""
    base, sensor = (yaml.safe_load(open(str(path)))[key] for key in ("base_in_tracker", "sensor_on_tip"))
    R_AB = rotation_of_quaternion(base["quaternion_wxyz"])
    return [1e3 * (numpy.array(base["position_m"]) + R_AB @ (numpy.array(p) + rotation_of(r) @ numpy.array(sensor["position_m"])))
            for p, r in TIPS]


def distance_of_sensors(path, other):
    return max(numpy.linalg.norm(a - b) for a, b in zip(sensors_of(path), sensors_of(other)))


def registered_as(name, within_mm):
    """As of another bag; of "truth": as it is."""
    def check(run):
        other = REGISTRATION if name == "truth" else run.folder / (OUTPUT[register][1] % name)
        if not run.output.exists() or not other.exists():
            return "no registration"
        distance = distance_of_sensors(run.output, other)
        return "" if distance <= within_mm else "the sensor is %.2f mm from where it is by %s" % (distance, name)
    return check


def modulus_of(text):
    found = re.search(r"^youngs_modulus_pa +([\d.e+]+) +([\d.e+]+)", text, re.M)
    return (float(found.group(1)), float(found.group(2))) if found else (float("nan"), float("nan"))


PLAIN = {}  # what the plain bag gave


def modulus_as_plain(relative):
    def check(run):
        modulus, error = modulus_of(run.text)
        PLAIN.setdefault("modulus", (modulus, error))
        right, its_error = PLAIN["modulus"]
        if abs(modulus - right) <= relative * right and error <= 1.5 * its_error:
            return ""
        return "modulus %.0f +- %.0f instead of %.0f +- %.0f" % (modulus, error, right, its_error)
    return check


def modulus_within_its_error(run):
    modulus, error = modulus_of(run.text)
    right = PLAIN["modulus"][0]
    return "" if abs(modulus - right) < 3 * error < 0.2 * right else "modulus %.0f +- %.0f instead of %.0f" % (modulus, error, right)


def modulus_is_true(run):
    modulus, error = modulus_of(run.text)
    return "" if abs(modulus - 100e3) < 5e3 and error < 2e3 else "modulus %.0f +- %.0f instead of 100000" % (modulus, error)


def free(run):
    """Nothing touches the robot; the share of samples in contact."""
    if not run.output.exists():
        return "nothing written"
    rows = list(csv.DictReader(open(str(run.output))))
    share = sum(row["contact"] == "1" for row in rows) / max(1, len(rows))
    return "" if rows and share < 0.02 else "contact in %.0f %% of %d samples" % (100 * share, len(rows))


def nothing_written(run):
    return "%s was written" % run.output.name if run.output.exists() else ""


def published(run, name):
    if not run.output.exists():
        return []
    with rosbag.Bag(str(run.output)) as bag:
        return [message for topic, message, _ in bag.read_messages() if topic.endswith("/" + name)]


def seconds_of(message):
    return message.header.stamp.to_sec() - RECORDED


def counts(**right):
    """pressures_accepted=480, ...: of the first two rows of the report's table."""
    def check(run):
        path = pathlib.Path(str(run.output) + ".md")
        rows = counts_of(path.read_text()) if path.exists() else []
        found = {"%s_%s" % (topic, key.replace(" ", "_")): number
                 for topic, row in zip(("pressures", "tracker"), rows) for key, number in row.items()}
        return ", ".join("%s: %s instead of %d" % (key, found.get(key), number) for key, number in right.items()
                         if found.get(key) != number)
    return check


def counts_of(report):
    """{column: number} for each row of the table of topics in replay's report."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in report.splitlines() if line.startswith("|")]
    header = next((row for row in rows if row[0] == "topic"), [])
    return [{name: int(cell) for name, cell in zip(header, row) if re.fullmatch(r"\d+", cell)}
            for row in rows if len(row) == len(header) and row != header and not row[0].startswith("--")]


def tracking_errors(low, high, gap=None):
    """Their number and mean (below 1.2 mm), and none of stamps between the two times of the gap."""
    def check(run):
        errors = published(run, "tracking_error")
        mean = 1e3 * sum(error.distance for error in errors) / max(1, len(errors))
        within = [error for error in errors if gap and gap[0] < seconds_of(error) < gap[1]]
        if not low <= len(errors) <= high:
            return "%d tracking errors instead of %d to %d" % (len(errors), low, high)
        return "%d tracking errors while there is nothing to compare" % len(within) if within else (
            "" if mean < 1.2 else "mean tracking error %.2f mm" % mean)
    return check


def no_contact(run):
    contacts = published(run, "tip_contact")
    share = sum(bool(message.contact) for message in contacts) / max(1, len(contacts))
    return "" if contacts and share < 0.02 else "contact in %.0f %% of %d messages" % (100 * share, len(contacts))


def lost_between(begin, end):
    def check(run):
        wrong = [message for message in published(run, "tip_contact") if begin < seconds_of(message) < end and message.tracked]
        return "%d messages of tip_contact are tracked" % len(wrong) if wrong else ""
    return check


def stale_estimates(low, pattern):
    def check(run):
        stale = [estimate for estimate in published(run, "estimate") if estimate.stale]
        if len(stale) < low:
            return "%d stale estimates instead of at least %d" % (len(stale), low)
        wrong = [estimate.message for estimate in stale if not re.search(pattern, estimate.message)]
        return "a stale one says '%s'" % wrong[0] if wrong else ""
    return check


def never_stale(run):
    stale = [estimate for estimate in published(run, "estimate") if estimate.stale]
    return "%d stale estimates: %s" % (len(stale), stale[0].message) if stale else ""


def never_back(run):
    stamps = [seconds_of(estimate) for estimate in published(run, "estimate")]
    return "" if stamps and stamps == sorted(stamps) else "%d estimates, and their stamps go back" % len(stamps)


def wrench_between(begin, end):
    """0.3 N along x from the first to the second time, nothing else before and after (s, of the bag; to 0.1 s)."""
    def check(run):
        for estimate in published(run, "estimate"):
            at, force = seconds_of(estimate), estimate.tip_wrench.force.x
            right = 0.3 if begin < at < end else 0.0
            if abs(force - right) > 1e-9 and min(abs(at - begin), abs(at - end)) > 0.1:
                return "at %.2f s: %g N instead of %g" % (at, force, right)
        return "" if published(run, "estimate") else "no estimates"
    return check


ARRIVAL = says("time of arrival")
PASSED, REFUSED = status(0), [status(2), nothing_written]


def same(name, *more, like="plain", within=SAME, relative=1e-3):
    """As of the plain bag, or as of one like it, by all programs that fit or filter."""
    return [(register, name, [PASSED, registered_as(like, within), *more]),
            (calibrate, name, [PASSED, modulus_as_plain(relative), *more]),
            (estimate_wrench, name, [PASSED, free, *more])]


def refused(name, pattern):
    return [(command, name, REFUSED + [says(pattern)]) for command in (register, calibrate, estimate_wrench)]


def cases(pressures, poses, late):
    """(command, name, what is right[, parameters of another case]). pressures, poses: messages of the plain bag; late: those of
    the pressures that were overtaken."""
    lost = make_cases.LOST
    of_all = [PASSED, counts(pressures_accepted=pressures, tracker_accepted=poses, pressures_rejected=0, tracker_rejected=0),
              tracking_errors(poses - 5, poses), never_stale, no_contact]
    yield register, "plain", [PASSED, registered_as("truth", 1.0)]
    yield calibrate, "plain", [PASSED, modulus_is_true, modulus_as_plain(1e-9)]
    yield estimate_wrench, "plain", [PASSED, free]
    yield replay, "plain", of_all

    for name in BAGS:
        if re.search("since_power_on|an_hour|12_s|1_s_ahead", name):
            yield from same(name, ARRIVAL)
            yield replay, name, of_all + [ARRIVAL]
        if "without_stamps" in name:
            yield from same(name)
            yield replay, name, of_all
    # For ten seconds the stamp is believed, and older than the time-out after half a second.
    yield from same("pressures_frozen", within=2 * MANY, relative=0.05)
    yield replay, "pressures_frozen", [PASSED, stale_estimates(150, "no pressures for more than 0.5 s"), no_contact,
                                       tracking_errors(240, 300, gap=(0.49, 9.98))]

    yield from same("silent_tracker", within=MANY, relative=0.02)
    yield replay, "silent_tracker", [PASSED, never_stale, no_contact, tracking_errors(poses - 101, poses - 90, gap=lost)]
    yield from same("silent_pressures", like="silent_tracker", within=FEW, relative=0.02)
    yield replay, "silent_pressures", [PASSED, stale_estimates(1, "no pressures for more than 0.5 s"), no_contact,
                                       tracking_errors(poses - 100, poses - 80, gap=(8.46, 13.0))]
    yield from same("held_pose", like="silent_tracker", within=FEW, relative=0.02)
    yield replay, "held_pose", [PASSED, no_contact, lost_between(9.02, 13.0),
                                tracking_errors(poses - 90, poses - 70, gap=(9.02, 13.0))]
    for name, reason in (("zero_pose", "quaternion is zero"), ("ndi_bad_float", "m away"), ("far_away", "m away")):
        yield from same(name, says_once(reason), like="silent_tracker", relative=0.02)
        yield replay, name, [PASSED, says(reason), no_contact, tracking_errors(poses - 101, poses - 90, gap=lost)]
    yield from same("not_a_number", says_once("must be finite"), within=FEW, relative=0.02)
    yield replay, "not_a_number", [PASSED, stale_estimates(1, "must be finite"), no_contact, counts(
        pressures_accepted=pressures - 20, pressures_rejected=20, tracker_accepted=poses)]
    yield from same("overtaken")
    yield replay, "overtaken", [PASSED, never_back, no_contact, counts(pressures_accepted=pressures, pressures_out_of_order=late)]
    yield replay, "wrench_ends", [PASSED, wrench_between(3.925, 7.925), never_stale]
    yield replay, "wrench_of_unknown_frame", [PASSED, says("unknown frame ft_link"), wrench_between(0.0, 0.0)]

    for name in ("millimetres", "kilopascals", "valves", "outlets", "tf", "parts"):
        yield from same(name)
        yield replay, name, [PASSED, tracking_errors(poses - 5, poses), never_stale, no_contact]
    yield from refused("millimetres_as_metres", "millimetres")
    yield replay, "millimetres_as_metres", [PASSED, says("millimetres"), tracking_errors(0, 0)]
    yield from refused("three_for_six", "channel_of_chamber")
    yield replay, "three_for_six", REFUSED + [says("channel_of_chamber")]
    yield replay, "three_for_six_mapped", [PASSED, counts(pressures_accepted=pressures, pressures_rejected=0)]

    yield replay, "absolute_as_gauge", [says("told gauge, sent absolute")]
    yield replay, "unregistered", [PASSED, says("not registered"), tracking_errors(0, 0)]
    for name in ("two_frames", "two_children", "two_children_the_first_seen"):
        yield from same(name, says("reference_disk"))
        yield replay, name, [PASSED, says("reference_disk"), tracking_errors(poses - 5, poses), no_contact]
    for name in ("unturned", "random_orientation", "random_roll"):
        # The offset of the sensor is less well known without orientations, so that the modulus takes a part of the error.
        yield register, name, [status(0, 1), registered_as("plain", 2 * MANY)]
        yield calibrate, name, [PASSED, modulus_within_its_error]
        yield estimate_wrench, name, [PASSED, free]
        yield replay, name, [PASSED, tracking_errors(poses - 5, poses), no_contact]
        # Nobody has said so: it is chosen, and said.
        chosen = says("tracker_measures|measures position")
        yield register, name, [status(0, 1), registered_as("plain", 2 * MANY), chosen], "plain"
        yield estimate_wrench, name, [PASSED, free, chosen], "plain"

    as_plain = [PASSED, registered_as("plain", SAME)]
    for name in ("plain", "byte_order_mark", "windows_lines", "semicolons", "tabs", "quotes"):
        yield register_table, name, as_plain
    yield register_table, "absolute", [PASSED, registered_as("plain", FEW)]  # less the mean at rest
    # Read, or refused with the reason in a few lines.
    for name in ("old_mac_lines", "semicolons_decimal_commas", "comma_at_ends", "units_below", "sep_above", "comment_above",
                 "utf_16", "unsorted", "repeated_times", "milliseconds"):
        yield register_table, name, [read_or_refused]
    for name in ("lost_nan", "lost_empty", "lost_zeros", "lost_held", "lost_ndi"):
        yield register_table, name, [PASSED, registered_as("silent_tracker", FEW), few_lines]
    yield register_table, "kilopascals", [doubted("unit|kPa")]
    yield register_table, "millimetres", [doubted("millimetres")]
    yield register_table, "absolute_named_gauge", [doubted("absolute")]
    yield register_table, "xyzw", [status(1), says("x, y, z, w")]
    yield register_table, "conjugated", [status(1), says("conjugate|inverse|inverted")]
    yield register_table, "mirrored", [status(1, 2), says("mirror")]
    yield register_table, "left_handed", [status(1, 2), says("mirror|left.handed")]
    for name in ("unturned", "no_orientation"):
        yield register_table, name, [status(0, 1), registered_as("plain", 2 * MANY), says("position")]
    yield register_table, "one_row", [status(1, 2)]


def few_lines(run):
    lines = run.text.count("\n")
    return "" if lines <= 25 else "%d lines of output" % lines


def read_or_refused(run):
    fault = registered_as("plain", MANY)(run) if run.status == 0 else nothing_written(run) or status(2)(run)
    return fault or few_lines(run)


def doubted(pattern):
    """Refused or not determined, or with the right warning: never a clean verdict."""
    return lambda run: says(pattern)(run) or few_lines(run)


def main(programs, folder, word=""):
    programs, folder = os.path.abspath(programs), pathlib.Path(folder).resolve()
    with rosbag.Bag(str(folder / "plain.bag")) as plain, rosbag.Bag(str(folder / "overtaken.bag")) as overtaken:
        pressures, poses = (plain.get_message_count(topic) for topic in (make_cases.PRESSURES, make_cases.POSE))
        late = overtaken.get_message_count(make_cases.PRESSURES) - pressures
    failures, done, said = [], 0, collections.defaultdict(str)
    for command, name, right, *told in cases(pressures, poses, late):
        program, output = OUTPUT[command]
        title = "%s %s%s" % (program, name, ".csv" if command is register_table else " as plain" if told else "")
        if word not in title and name != "plain":
            continue
        output = output % (name + "_untold" if told else name)
        try:
            run = Run(programs, folder, program, name, command(folder, name, told[0] if told else None), output)
            faults = [fault for fault in (check(run) for check in right) if fault]
            words = run.last_words()
            said[name + (".csv" if command is register_table else "")] += run.text
        except subprocess.TimeoutExpired:
            faults, words = ["not done after 120 s"], ""
        done += 1
        line = "%-58s %s" % (title, "ok" if not faults else "; ".join(faults))
        print(line, flush=True)
        if faults:
            failures.append("%s\n    %s" % (line, words[:300]))
    for name, text in said.items():
        for pattern in make_cases.documented(name, 2):
            done += 1
            if not re.search(pattern, text):
                failures.append("%s does not say %s, as docs/troubleshooting.md has it" % (name, pattern))
    print("\n".join(["", "failed:"] + failures if failures else []))
    print("%d cases, %d failed" % (done, len(failures)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
