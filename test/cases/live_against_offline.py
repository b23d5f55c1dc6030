#!/usr/bin/env python3
"""live_against_offline.py PROGRAMS DIR [NAME...]: the node says of messages that are played to it what replay says of their bag.

Each case DIR/NAME.bag (also in parts) with DIR/NAME.yaml is played into a stiffness_node of its own on the present master, in
simulated time: /clock is the bag's time, and after every message the player waits until the node shows that it has taken it, so
that the order between topics is certain. Compared with `replay`: the sequence of estimates (without what the heartbeat
repeats), tracking errors, contact, and the counts of messages. Times of arrival and of solving are not compared."""
import collections
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time
import warnings

import rosbag
import rospy
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from live_stiffness.msg import StiffnessEstimate, TipContact, TrackingError
from rosgraph_msgs.msg import Clock

import make_cases
from offline_cases import counts_of

PATIENCE = 20.0  # s, for what must happen
REPORTS = 100    # diagnostics after which a message has had no effect
SAME = 1e-6      # relative: below the tenfold of what two solutions of one state differ by, far below any wrong message
NODE = "/stiffness_node"
OUTPUTS = {"estimate": StiffnessEstimate, "tracking_error": TrackingError, "tip_contact": TipContact}
COUNTED = ("Pressures", "Tracker")


class Node:
    """A stiffness_node and all that it publishes."""

    def __init__(self, programs, parameters):
        self.changed = threading.Condition()
        self.heard = {name: [] for name in OUTPUTS}
        self.said = ()          # of the newest estimate
        self.reports = 0        # diagnostics
        self.words = set()      # of all of them
        self.clock = None       # the node's, of its newest report
        self.counts = {}        # of its newest report: (entry, key): text
        self.subscribers = [rospy.Subscriber("%s/%s" % (NODE, name), kind, self.hear, name, queue_size=None, tcp_nodelay=True)
                            for name, kind in OUTPUTS.items()]
        self.subscribers.append(rospy.Subscriber("/diagnostics", DiagnosticArray, self.hear_report, tcp_nodelay=True))
        rospy.set_param(NODE, parameters)
        self.process = subprocess.Popen([programs + "/stiffness_node"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def hear(self, message, name):
        with self.changed:
            self.heard[name].append(message)
            if name == "estimate":
                self.said = key_of(message)
            self.changed.notify_all()

    def hear_report(self, message):
        with self.changed:
            self.reports += 1
            self.clock = message.header.stamp
            for status in message.status:
                self.words.add(" ".join([status.message] + ["%s: %s" % (pair.key, pair.value) for pair in status.values]))
                entry = status.name.split(": ")[-1]
                if entry in COUNTED:
                    self.counts.update({(entry, pair.key): pair.value for pair in status.values if "rate" not in pair.key})
            self.changed.notify_all()

    def wait(self, condition, what):
        """Until the condition holds; RuntimeError that says what did not come if it never does."""
        end = time.time() + PATIENCE
        with self.changed:
            while not condition():
                if self.process.poll() is not None:
                    raise RuntimeError("the node has ended with status %d" % self.process.returncode)
                if time.time() > end:
                    raise RuntimeError("in vain for %s" % what)
                self.changed.wait(1.0)

    def wait_for_reports(self, count):
        with self.changed:
            reports = self.reports
        self.wait(lambda: self.reports >= reports + count, "reports")

    def number(self, entry, *keys):
        """The sum of counts."""
        return sum(int(self.counts.get((entry, key), 0)) for key in keys)

    def taken(self, topic):
        """What changes when a message of the topic has been taken, whatever became of it."""
        entry = "Tracker" if topic in (make_cases.POSE, "/tf") else "Pressures"
        return (len(self.heard["tracking_error"]) if entry == "Tracker" else self.said,
                tuple(self.counts.get((entry, key)) for key in ("accepted", "rejected", "out of order")))

    def end(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.process.send_signal(signal.SIGINT)
        status = self.process.wait(PATIENCE)
        rospy.delete_param(NODE)
        return status


def raw_type(kind):
    """A message type whose messages are published as the bytes that were recorded, sequence numbers too."""
    class Raw(kind):
        __slots__ = ["data"]
        _has_header = False

        def __init__(self, data):
            self.data = data

        def serialize(self, buff):
            buff.write(self.data)
    return Raw


def messages_of(bags, seconds):
    """(topic, type, bytes, message, time) of the bags, one after the other; at most so many seconds."""
    begin = None
    for path in bags:
        with rosbag.Bag(path) as bag:
            decoded = bag.read_messages()
            for (topic, (_, data, _, _, kind), now), (_, message, _) in zip(bag.read_messages(raw=True), decoded):
                begin = begin or now
                if (now - begin).to_sec() < seconds:
                    yield "/" + topic.lstrip("/"), kind, data, message, now


def play(node, case, bags):
    """How many messages were played, and how many had no visible effect."""
    clock = rospy.Publisher("/clock", Clock, queue_size=None, tcp_nodelay=True)
    messages = list(messages_of(bags, case.seconds))
    begin, now = messages[0][4], None
    kinds, publishers = {}, {}
    for topic, kind, _, _, _ in messages:
        if topic not in publishers:
            kinds[topic] = raw_type(kind)
            publishers[topic] = rospy.Publisher(topic, kinds[topic], queue_size=None, tcp_nodelay=True)

    def set_clock(moment):
        end = time.time() + PATIENCE
        while True:  # the first ones may come before the node subscribes
            clock.publish(moment)
            with node.changed:
                if node.changed.wait_for(lambda: node.clock == moment, 0.5):
                    return
            if time.time() > end or node.process.poll() is not None:
                raise RuntimeError("the node does not follow /clock")

    set_clock(begin)
    for topic, publisher in publishers.items():
        end = time.time() + PATIENCE
        while publisher.get_num_connections() < 1:
            node.wait_for_reports(1)
            if time.time() > end:
                raise RuntimeError("the node does not subscribe to " + topic)
    changes, without_effect = list(case.changes), 0
    for topic, kind, data, message, moment in messages:
        if moment != now:
            before, now = node.said, moment
            set_clock(moment)
            if changes and (moment - begin).to_sec() > changes[0]:
                node.wait(lambda: node.said != before, "a change %g s after the begin" % changes.pop(0))
        else:  # the newest report may be of before the last message
            node.wait_for_reports(2)
        with node.changed:
            before, reports = node.taken(topic), node.reports
        publishers[topic].publish(kinds[topic](data))
        if not case.unseen(make_cases.Event(0.0, topic, message)):
            node.wait(lambda: node.taken(topic) != before or node.reports > reports + REPORTS, "reports")
            without_effect += node.taken(topic) == before
    node.wait_for_reports(2)
    for publisher in list(publishers.values()) + [clock]:
        publisher.unregister()
    return len(messages), without_effect


def key_of(estimate):
    """What tells estimates apart: what they are of, and what is said of them."""
    f = estimate.tip_wrench.force
    return (tuple(estimate.pressure), (f.x, f.y, f.z), estimate.status, bool(estimate.stale), estimate.message)


def without_repeats(estimates):
    kept = []
    for estimate in estimates:
        if not kept or key_of(estimate) != key_of(kept[-1]):
            kept.append(estimate)
    return kept


def numbers_differ(a, b):
    a, b = list(a), list(b)
    scale = max([abs(x) for x in a] + [1e-9])
    return len(a) != len(b) or any(not abs(x - y) <= SAME * scale for x, y in zip(a, b))


def xyz(vector):
    return [vector.x, vector.y, vector.z]


def estimate_difference(a, b):
    if key_of(a)[2:] != key_of(b)[2:]:
        return "status %s, stale %s, '%s'" % key_of(a)[2:] + " instead of %s, %s, '%s'" % key_of(b)[2:]
    for what in ("pressure", "compliance"):
        if numbers_differ(getattr(a, what), getattr(b, what)):
            return "%s %.9g instead of %.9g" % (what, max(getattr(a, what)), max(getattr(b, what)))
    if numbers_differ(xyz(a.tip_wrench.force), xyz(b.tip_wrench.force)):
        return "wrench"
    return "stamp %s instead of %s" % (a.header.stamp, b.header.stamp) if a.header.stamp != b.header.stamp else ""


def error_difference(a, b):
    if a.header.stamp != b.header.stamp:
        return "stamp %s instead of %s" % (a.header.stamp, b.header.stamp)
    different = abs(a.distance - b.distance) > 1e-9 or numbers_differ(xyz(a.rotation), xyz(b.rotation))
    return "%.6f instead of %.6f mm" % (1e3 * a.distance, 1e3 * b.distance) if different else ""


def contact_difference(a, b):
    if a.header.stamp != b.header.stamp:
        return "stamp %s instead of %s" % (a.header.stamp, b.header.stamp)
    if (a.contact, a.outlier, a.tracked, a.message) != (b.contact, b.outlier, b.tracked, b.message):
        return "contact, outlier, tracked, message %s instead of %s" % (
            (a.contact, a.outlier, a.tracked, a.message), (b.contact, b.outlier, b.tracked, b.message))
    if any(abs(x - y) > 1e-6 for x, y in zip(xyz(a.wrench.force), xyz(b.wrench.force))):
        return "force %s instead of %s" % (xyz(a.wrench.force), xyz(b.wrench.force))
    return ""


def sequence_differences(name, live, offline, difference):
    """A line if the sequences differ: in how many places, and in the first one how."""
    lines = [difference(a, b) for a, b in zip(offline, live)]
    different = [(place, line) for place, line in enumerate(lines) if line]
    if not different and len(live) == len(offline):
        return []
    text = "%s: %d offline, %d live, %d of them differ" % (name, len(offline), len(live), len(different))
    return [text + ("; number %d: %s" % different[0] if different else "")]


def replay(programs, bags, parameters, out):
    """What replay writes and reports; its text if it fails."""
    report = out.with_suffix(".md")
    done = subprocess.run([programs + "/replay"] + bags + ["--parameters", parameters, "-o", str(out), "--report", str(report)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    heard = {name: [] for name in OUTPUTS}
    if done.returncode != 0:
        said = [line for line in done.stdout.splitlines() if not line.endswith(" %")]  # without progress
        return heard, [], " ".join(said) or "exit status %d" % done.returncode
    with rosbag.Bag(str(out)) as bag:
        for topic, message, _ in bag.read_messages():
            name = topic.split("/")[-1]
            if name in heard:
                heard[name].append(message)
    return heard, counts_of(report.read_text()), ""


def count_differences(node, counts):
    """Pressures and tracker are the first two rows."""
    different = [] if len(counts) >= len(COUNTED) else ["no counts in the report"]
    for entry, row in zip(COUNTED, counts):
        for key in ("accepted", "rejected", "out of order"):
            live, offline = node.number(entry, key), row.get(key)
            if offline != live:
                different.append("%s %s: %s offline, %d live" % (entry, key, offline, live))
    return different


def compare(programs, folder, name, case):
    """Plays a case: cells of its row, and lines of what differs."""
    bags, parameters = make_cases.paths_of(folder, name), str(folder / (name + ".yaml"))
    if case.seconds < make_cases.WHOLE:
        bags = [shortened(bags[0], case.seconds, folder / ("short_%s.bag" % name))]
    node = Node(programs, yaml.safe_load(open(parameters)))
    try:
        start = time.time()
        played, without_effect = play(node, case, bags)
        seconds = time.time() - start
    finally:
        status = node.end()
    heard, counts, failure = replay(programs, bags, parameters, folder / ("replayed_%s.bag" % name))
    live = without_repeats(node.heard["estimate"])
    different = ["the node's exit status is %d" % status] if status != 0 else []
    if case.refused:
        different += [] if failure and not live else ["it must be refused"]
    elif failure or not live:
        different.append("replay: " + failure if failure else "no estimates")
    different += sequence_differences("estimates", live, without_repeats(heard["estimate"]), estimate_difference)
    different += sequence_differences("tracking errors", node.heard["tracking_error"], heard["tracking_error"], error_difference)
    different += sequence_differences("contact", node.heard["tip_contact"], heard["tip_contact"], contact_difference)
    if not failure:
        different += count_differences(node, counts)
    different += ["/diagnostics does not say %s, as docs/troubleshooting.md has it" % pattern
                  for pattern in make_cases.documented(name, 1) if not any(re.search(pattern, words) for words in node.words)]
    cells = [played, len(live), len(node.heard["tracking_error"]), len(node.heard["tip_contact"]), without_effect, seconds]
    return cells, different


def shortened(path, seconds, out):
    with rosbag.Bag(str(out), "w") as bag:
        begin = None
        for topic, message, now in rosbag.Bag(path).read_messages(raw=True):
            begin = begin or now
            if (now - begin).to_sec() < seconds:
                bag.write(topic, message, now, raw=True)
    return str(out)


def main(programs, folder, *names):
    folder = pathlib.Path(folder).resolve()
    cases = dict(make_cases.BAGS)
    if (folder / "recorded.bag").exists():
        cases["recorded"] = make_cases.Case(None, seconds=make_cases.WHOLE)
    unknown = set(names) - set(cases)
    if unknown:
        sys.exit("no such cases: %s" % ", ".join(sorted(unknown)))
    warnings.simplefilter("ignore", SyntaxWarning)  # of publishers without a queue: publish() then sends before it returns
    rospy.set_param("/use_sim_time", True)
    rospy.init_node("player", disable_rostime=True, disable_signals=True)
    failed = collections.OrderedDict()
    print("case                             messages estimates   errors  contact no effect     s  differences")
    for name in names or cases:
        try:
            cells, different = compare(programs, folder, name, cases[name])
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            cells, different = [0, 0, 0, 0, 0, 0.0], [str(error)]
        line = "%-32s %8d %9d %8d %8d %9d %5.1f  %s" % (name, *cells, "; ".join(different) or "none")
        print(" ".join(line.split("\n"))[:400], flush=True)
        if different:
            failed[name] = different
    print("%d cases, %d differ%s" % (len(names or cases), len(failed), ": " + ", ".join(failed) if failed else ""))
    return 1 if failed or not (names or cases) else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
