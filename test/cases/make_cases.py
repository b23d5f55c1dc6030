#!/usr/bin/env python3
"""make_cases.py DIR SIM.bag [RECORDED.bag RECORDED.yaml]: from a simulated bag (arm.yaml, three channels) the inputs that labs
really have.

Writes DIR/NAME.bag for each of BAGS (some in parts: NAME_1.bag, ...) with DIR/NAME.yaml, the node's private parameters for
it; DIR/NAME.csv for each of TABLES; the scene DIR/two_segments.yaml; and of a recorded bag with its parameters DIR/recorded.bag.
What is right for each stands in offline_cases.py; live_against_offline.py plays the bags to the node."""
import copy
import math
import pathlib
import random
import re
import sys

import genpy
import rosbag
import yaml
from geometry_msgs.msg import TransformStamped, Vector3, WrenchStamped
from sensor_msgs.msg import FluidPressure
from std_msgs.msg import Float64MultiArray
from tf2_msgs.msg import TFMessage

CASES = pathlib.Path(__file__).resolve().parent
REGISTRATION = CASES.parents[1] / "config/registrations/simulated_rig.yaml"
PRESSURES, POSE, WRENCH = "/chamber_pressures", "/aurora_pose", "/tip_wrench"
RECORDED = 1.7e9  # s, when the recording began
POSE_LATENCY = 0.005  # s, from stamp to arrival; a bag does not keep the order at one time (findings/)
ATMOSPHERE = 101325.0  # Pa
LOST = (8.0, 13.0)  # s, when something is silent or not seen
NDI_BAD_FLOAT = -3.697314e28  # what NDI's interface gives for a number that it does not have

# Parameters of the node in all cases. Every change of pressure is solved, so that the sequence of estimates does not depend on
# when a heartbeat comes; heartbeat and diagnostics are quick, since the player waits for what they say.
COMMON = {"scene_file": str(CASES / "arm.yaml"), "registration_file": str(REGISTRATION), "update_threshold_pa": 0.0,
          "heartbeat_hz": 100.0, "diagnostic_period": 0.002, "marker_rate_hz": 0.1, "tip_handle": False}


class Event:
    """A message of a bag: seconds since the recording began, topic, message."""

    def __init__(self, seconds, topic, message):
        self.seconds, self.topic, self.message = seconds, topic, message


def clone(event, seconds=None):
    return Event(event.seconds if seconds is None else seconds, event.topic, copy.deepcopy(event.message))


def stamp(seconds):
    return genpy.Time.from_sec(RECORDED + seconds)


def read(path):
    """Pressures and poses of the bag, stamped by the clock of the recording; each pose is recorded after its pressures."""
    with rosbag.Bag(str(path)) as bag:
        found = [("/" + topic.lstrip("/"), message, time.to_sec()) for topic, message, time in bag.read_messages()]
    events = [Event(time - found[0][2], topic, message) for topic, message, time in found if topic in (PRESSURES, POSE)]
    for event in events:
        event.message.header.stamp = stamp(event.seconds)
        event.seconds += POSE_LATENCY if event.topic == POSE else 0.0
    return sorted(events, key=lambda event: event.seconds)


def each(topic, change):
    """A case in which messages of a topic are changed: change(event, random) may give a list of events instead."""
    def make(events):
        draw, made = random.Random(29), []
        for event in events:
            event = clone(event)
            changed = change(event, draw) if event.topic == topic else None
            made += [event] if changed is None else changed
        return made
    return make


def within(begin, end, topic, change):
    """The same, between two times only."""
    return each(topic, lambda event, draw: change(event, draw) if begin <= event.seconds < end else None)


def stamped(topic, stamp_of):
    """Stamps of another clock; stamp_of(seconds): its time, s."""
    def change(event, _):
        event.message.header.stamp = genpy.Time.from_sec(stamp_of(event.seconds))
    return each(topic, change)


def since_power_on(seconds):
    return 41.0 + seconds


def both(first, second):
    return lambda events: second(first(events))


def position(event):
    return event.message.pose.position


def move(point, x, y, z):
    point.x, point.y, point.z = x, y, z


def turn(quaternion, w, x, y, z):
    quaternion.w, quaternion.x, quaternion.y, quaternion.z = w, x, y, z


def in_millimetres(event, _):
    p = position(event)
    move(p, 1e3 * p.x, 1e3 * p.y, 1e3 * p.z)


def tip_wrench(seconds, frame):
    message = WrenchStamped()
    message.header.stamp, message.header.frame_id, message.wrench.force = stamp(seconds), frame, Vector3(0.3, 0.0, 0.0)
    return Event(seconds, WRENCH, message)


def with_wrench(frame, begin, count):
    """A known wrench with two messages a second, between the samples of the others."""
    return lambda events: sorted(events + [tip_wrench(begin + 0.5 * k, frame) for k in range(count)],
                                 key=lambda event: event.seconds)


def overtaken(events):
    """Twice a second a message of the pressures of 0.6 s ago comes between."""
    made, sent = [], []
    for event in events:
        made.append(clone(event))
        if event.topic == PRESSURES:
            if len(sent) > 12 and len(sent) % 10 == 0:
                made.append(clone(sent[-12], event.seconds))
            sent.append(event)
    return made


def held(begin, end):
    """The tool is lost, and its driver repeats the last pose with new stamps."""
    last = []

    def change(event, _):
        if begin <= event.seconds < end:
            event.message.pose = copy.deepcopy(last[0])
        last[:] = [event.message.pose]
    return each(POSE, change)


def zero_pose(event, _):
    move(position(event), 0.0, 0.0, 0.0)
    turn(event.message.pose.orientation, 0.0, 0.0, 0.0, 0.0)


def second_frame(event, _):
    """A reference disk, 80 mm beside the tool, on the same topic: known by its frame."""
    other = clone(event)
    other.message.header.frame_id = "reference_disk"
    position(other).x += 0.08
    return [event, other]


def transform_of(event, child):
    made = TransformStamped(header=event.message.header, child_frame_id=child)
    p = position(event)
    made.transform.translation, made.transform.rotation = Vector3(p.x, p.y, p.z), event.message.pose.orientation
    return made


def second_child(event, _):
    """The same as transforms: known by its child."""
    other = clone(event)
    position(other).x += 0.08
    return [Event(event.seconds, POSE, transform_of(event, "aurora_tip")),
            Event(event.seconds, POSE, transform_of(other, "reference_disk"))]


def in_tf(event, _):
    """Tool and reference disk in /tf."""
    other = clone(event)
    position(other).x += 0.08
    return [Event(event.seconds, "/tf", TFMessage(transforms=[transform_of(other, "disk"), transform_of(event, "tool")]))]


def of_valves(event, _):
    """Each channel absolute on a topic of its own."""
    return [Event(event.seconds, "/valve_%d" % (k + 1), FluidPressure(event.message.header, p + ATMOSPHERE, 25.0))
            for k, p in enumerate(event.message.pressure)]


def absolute_kilopascals(event, _):
    return [Event(event.seconds, PRESSURES, Float64MultiArray(data=[1e-3 * (p + ATMOSPHERE) for p in event.message.pressure]))]


def absolute(event, _):
    event.message.pressure = [p + ATMOSPHERE for p in event.message.pressure]


def spare_outlets(event, _):
    event.message.pressure = list(event.message.pressure) + [1e3 * k for k in range(9)]


def not_a_number(event, _):
    event.message.pressure = [float("nan")] + list(event.message.pressure)[1:]


def random_orientation(event, draw):
    q = [draw.gauss(0.0, 1.0) for _ in range(4)]
    length = sum(c * c for c in q) ** 0.5
    turn(event.message.pose.orientation, *(c / length for c in q))


def random_roll(event, draw):
    """A coil with five degrees of freedom: how far it is turned about its own axis, z, is not known."""
    q, half = event.message.pose.orientation, draw.uniform(0.0, math.pi)
    turn(q, *product((q.w, q.x, q.y, q.z), (math.cos(half), 0.0, 0.0, math.sin(half))))


def product(a, b):
    """Of quaternions w, x, y, z."""
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def ndi_bad_float(event, _):
    move(position(event), NDI_BAD_FLOAT, NDI_BAD_FLOAT, NDI_BAD_FLOAT)


def far_away(event, _):
    position(event).x += 640.0


def unturned(event, _):
    turn(event.message.pose.orientation, 1.0, 0.0, 0.0, 0.0)


def unchanged(events):
    return events


def drop(_, __):
    return []


class Case:
    """A bag: make(events) gives its events, parameters are those of the node beside COMMON. For the player of
    live_against_offline.py: only the first `seconds` are played; the estimates change without a message after the
    times `changes`, s; the node shows nothing of messages for which unseen(event) is true; of a refused case nothing comes."""

    def __init__(self, make, parameters=None, parts=1, seconds=15.0, changes=(), unseen=lambda event: False,
                 refused=False):
        self.make, self.parameters, self.parts = make, parameters or {}, parts
        self.seconds, self.changes, self.unseen, self.refused = seconds, changes, unseen, refused


def is_disk(event):
    return event.message.header.frame_id == "reference_disk" or getattr(event.message, "child_frame_id", "") == "reference_disk"


def documented(case, place):
    """What docs/troubleshooting.md says of a case: quoted texts, in which ... stands for anything, as patterns. place: 1 of the
    node, 2 of the programs."""
    page = (pathlib.Path(__file__).parents[2] / "docs/troubleshooting.md").read_text()
    patterns = []
    for line in page.split("## What is judged, live and offline")[1].split("\n## ")[0].splitlines():
        cells = line.strip().strip("|").split("|")
        if len(cells) == 3 and "`%s`" % case in cells[0]:
            patterns += [".*".join(map(re.escape, text.split("..."))) for text in re.findall(r"`([^`]+)`", cells[place])]
    return patterns


VALVES = {"pressure_topics": ["valve_1", "valve_2", "valve_3"], "pressure_reference": "absolute"}
WHOLE = 1e9  # s
TWO_SEGMENTS = "two_segments.yaml"  # the scene_file of these is in DIR
BAGS = {
    # The clocks of the devices are not the recorder's.
    "plain": Case(unchanged),
    "pressures_since_power_on": Case(stamped(PRESSURES, since_power_on)),
    "poses_since_power_on": Case(stamped(POSE, since_power_on)),
    "both_since_power_on": Case(both(stamped(PRESSURES, since_power_on), stamped(POSE, since_power_on))),
    "pressures_without_stamps": Case(stamped(PRESSURES, lambda seconds: 0.0)),
    "poses_without_stamps": Case(stamped(POSE, lambda seconds: 0.0)),
    "pressures_an_hour_ahead": Case(stamped(PRESSURES, lambda seconds: RECORDED + 3600.0 + seconds)),
    "pressures_an_hour_behind": Case(stamped(PRESSURES, lambda seconds: RECORDED - 3600.0 + seconds)),
    "poses_an_hour_ahead": Case(stamped(POSE, lambda seconds: RECORDED + 3600.0 + seconds)),
    "pressures_12_s_behind": Case(stamped(PRESSURES, lambda seconds: RECORDED - 12.0 + seconds)),
    "poses_1_s_ahead": Case(stamped(POSE, lambda seconds: RECORDED + 1.0 + seconds)),
    "pressures_frozen": Case(stamped(PRESSURES, lambda seconds: RECORDED - 0.02), changes=(0.47,)),
    # Silence, loss and disorder.
    "silent_pressures": Case(within(*LOST, PRESSURES, drop), changes=(8.44,)),
    "silent_tracker": Case(within(*LOST, POSE, drop)),
    "wrench_ends": Case(with_wrench("base", 3.925, 7), changes=(7.915,)),
    "wrench_of_unknown_frame": Case(with_wrench("ft_link", 3.925, 4)),
    "overtaken": Case(overtaken),
    "held_pose": Case(held(*LOST)),
    "zero_pose": Case(within(*LOST, POSE, zero_pose)),
    "ndi_bad_float": Case(within(*LOST, POSE, ndi_bad_float)),
    "far_away": Case(within(*LOST, POSE, far_away)),
    "not_a_number": Case(within(8.0, 9.0, PRESSURES, not_a_number)),
    # Units, channels and messages of other kinds.
    "millimetres": Case(each(POSE, in_millimetres), {"aurora_position_unit": "mm"}),
    "millimetres_as_metres": Case(each(POSE, in_millimetres)),
    "kilopascals": Case(each(PRESSURES, absolute_kilopascals), {"pressure_unit": "kPa", "pressure_reference": "absolute"}),
    "absolute_as_gauge": Case(each(PRESSURES, absolute), seconds=5.0),
    "unregistered": Case(unchanged, {"registration_file": ""}, seconds=5.0),
    "valves": Case(each(PRESSURES, of_valves), VALVES),
    "outlets": Case(each(PRESSURES, spare_outlets), {"channel_of_chamber": [0, 1, 2]}),
    "three_for_six": Case(unchanged, {"scene_file": TWO_SEGMENTS}, seconds=5.0, refused=True),
    "three_for_six_mapped": Case(unchanged, {"scene_file": TWO_SEGMENTS, "channel_of_chamber": [0, 1, 2, 0, 1, 2]}, seconds=5.0),
    "tf": Case(each(POSE, in_tf), {"aurora_tf_frame": "tool"}, seconds=10.0),
    "parts": Case(unchanged, parts=3, seconds=WHOLE),
    # Two tools, and trackers that do not measure the orientation.
    "two_frames": Case(each(POSE, second_frame), unseen=is_disk),
    "two_children": Case(each(POSE, second_child), unseen=is_disk),
    "two_children_the_first_seen": Case(each(POSE, second_child), {"sensor_frame": ""}, unseen=is_disk),
    "unturned": Case(each(POSE, unturned), {"tracker_measures": "position"}),
    "random_orientation": Case(each(POSE, random_orientation), {"tracker_measures": "position"}),
    "random_roll": Case(each(POSE, random_roll), {"tracker_measures": "position_and_axis"}),
}


def write_bag(folder, name, case, events):
    made = case.make(events)
    length = 1.0 + made[-1].seconds
    names = [name] if case.parts == 1 else ["%s_%d" % (name, part + 1) for part in range(case.parts)]
    for part, path in enumerate(names):
        with rosbag.Bag(str(folder / (path + ".bag")), "w") as bag:
            for event in made:
                if int(event.seconds / length * case.parts) == part:
                    bag.write(event.topic, event.message, stamp(event.seconds))
    parameters = dict(COMMON, **case.parameters)
    parameters["scene_file"] = str(folder / parameters["scene_file"])
    (folder / (name + ".yaml")).write_text(yaml.safe_dump(parameters))


def paths_of(folder, name):
    """The bags of a case, in their order."""
    return [str(path) for path in sorted(folder.glob(name + ".bag")) or sorted(folder.glob(name + "_[0-9].bag"))]


HEADER = ["time_s", "pressure_1_pa", "pressure_2_pa", "pressure_3_pa", "tip_x_m", "tip_y_m", "tip_z_m",
          "tip_qw", "tip_qx", "tip_qy", "tip_qz"]


def rows_of(events):
    rows, pressures = [], None
    for event in events:
        if event.topic == PRESSURES:
            pressures = list(event.message.pressure)
        elif pressures:
            p, q = position(event), event.message.pose.orientation
            rows.append([event.seconds] + pressures + [p.x, p.y, p.z, q.w, q.x, q.y, q.z])
    return rows


def changed(change):
    """The table with change(row) for every row."""
    return lambda rows: [HEADER] + [change(list(row)) for row in rows]


def lost(cells):
    """The table in which the tool is lost for a while, and cells(the last row before) stand for its pose."""
    def make(rows):
        instead = cells(max(row for row in rows if row[0] < LOST[0]))
        return [HEADER] + [row[:4] + instead if LOST[0] <= row[0] < LOST[1] else row for row in rows]
    return make


def whole(rows):
    return [HEADER] + rows


def text_of(table, separator=",", decimal=".", line_end="\n", quote="", row_end=""):
    cell = lambda value: quote + value + quote if isinstance(value, str) else ("%.7g" % value).replace(".", decimal)
    return "".join(separator.join(map(cell, row)) + row_end + line_end for row in table)


def written(encoding="utf-8", before="", **form):
    return lambda rows: (before + text_of(whole(rows), **form)).encode(encoding)


def units_below(rows):
    return [HEADER, ["s"] + ["Pa"] * 3 + ["m"] * 3 + [""] * 4] + rows


def at_rest_before(rows):
    """The same after a second at rest."""
    return [[0.05 * k] + rows[0][1:] for k in range(20)] + [[1.0 + row[0]] + row[1:] for row in rows]


def row_with(row, first, values):
    return row[:first] + list(values) + row[first + len(values):]


# name: rows -> table or bytes
TABLES = {
    # As programs write it.
    "plain": whole,
    "byte_order_mark": written(before="\ufeff"),
    "windows_lines": written(line_end="\r\n"),
    "old_mac_lines": written(line_end="\r"),
    "semicolons": written(separator=";"),
    "semicolons_decimal_commas": written(separator=";", decimal=","),
    "tabs": written(separator="\t"),
    "quotes": written(quote='"'),
    "comma_at_ends": written(row_end=","),
    "units_below": units_below,
    "sep_above": written(before="sep=,\n"),
    "comment_above": written(before="# exported\n"),
    "utf_16": written("utf-16"),
    # The tool is lost for a while.
    "lost_nan": lost(lambda last: ["NaN"] * 7),
    "lost_empty": lost(lambda last: [""] * 7),
    "lost_zeros": lost(lambda last: [0.0] * 7),
    "lost_held": lost(lambda last: last[4:]),
    "lost_ndi": lost(lambda last: [NDI_BAD_FLOAT] * 3 + last[7:]),
    # The numbers are not what the names say.
    "milliseconds": changed(lambda row: [1e3 * row[0]] + row[1:]),
    "kilopascals": changed(lambda row: row_with(row, 1, [1e-3 * p for p in row[1:4]])),
    "millimetres": changed(lambda row: row_with(row, 4, [1e3 * x for x in row[4:7]])),
    "absolute_named_gauge": changed(lambda row: row_with(row, 1, [p + ATMOSPHERE for p in row[1:4]])),
    "absolute": lambda rows: [[name + "_abs" if "_pa" in name else name for name in HEADER]] + [
        row_with(row, 1, [p + ATMOSPHERE for p in row[1:4]]) for row in at_rest_before(rows)],
    "xyzw": changed(lambda row: row[:7] + row[8:] + [row[7]]),
    "conjugated": changed(lambda row: row[:8] + [-q for q in row[8:]]),
    "mirrored": changed(lambda row: row_with(row, 5, [-row[5]])),
    "left_handed": changed(lambda row: row_with(row, 5, [-row[5], row[6], row[7], -row[8], row[9], -row[10]])),
    "unturned": changed(lambda row: row[:7] + [1.0, 0.0, 0.0, 0.0]),
    "no_orientation": lambda rows: [row[:7] for row in whole(rows)],
    "unsorted": lambda rows: [HEADER] + rows[200:] + rows[:200],
    "repeated_times": changed(lambda row: [round(row[0], 1)] + row[1:]),
    "one_row": lambda rows: [HEADER] + rows[:1],
}


def main(folder, simulated, recorded=None, recorded_parameters=None):
    folder = pathlib.Path(folder).resolve()
    scene = yaml.safe_load((CASES / "arm.yaml").read_text())
    scene["chain"].insert(0, copy.deepcopy(scene["chain"][0]))
    (folder / TWO_SEGMENTS).write_text(yaml.safe_dump(scene, sort_keys=False))
    events = read(simulated)
    for name, case in BAGS.items():
        write_bag(folder, name, case, events)
    if recorded:
        write_bag(folder, "recorded", Case(unchanged, yaml.safe_load(open(recorded_parameters))), read(recorded))
    rows = rows_of(events)
    for name, make in TABLES.items():
        made = make(rows)
        (folder / (name + ".csv")).write_bytes(made if isinstance(made, bytes) else text_of(made).encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
