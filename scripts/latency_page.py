#!/usr/bin/env python3
"""docs/latency.md, or docs/latency_drawn.md, from the rows of latency_report: ROWS BUILD."""
import csv
import os
import platform
import re
import sys

ROWS, BUILD = sys.argv[1:3]
TARGETS_US = {"TCPROS": 1000.0, "nodelet": 200.0}  # of the 99th percentile
DRAWN, BARE_WAKE, ECHO = "drawn", "bare wake", "echo"
# median to max: received
COLUMNS = "transport rate reached sent lost delivered delivered_p99 delivered_p999 median p99 p999 max solve error stolen".split()


def processor():
    with open("/proc/cpuinfo") as info:
        names = re.findall(r"model name\s*: (.*)", info.read())
    return "%d x %s" % (len(names), names[0] if names else platform.machine())


def asked(row):
    return "%g Hz" % float(row["rate"]) if float(row["rate"]) else "as fast as it goes"


def main():
    with open(ROWS) as file:
        lines = list(csv.reader(file))
    measured = [dict(zip(COLUMNS, line)) for line in lines if line[0] != BARE_WAKE]
    for row in measured:
        row["kind"], _, row["label"] = row["transport"].partition(" ")
    rows = [row for row in measured if row["kind"] != ECHO]
    echoes = {(row["label"], row["rate"]): float(row["delivered_p99"]) for row in measured if row["kind"] == ECHO}
    wakes = {float(line[1]): tuple(map(float, line[2:])) for line in lines if line[0] == BARE_WAKE}
    with open(BUILD + "/CMakeCache.txt") as cache:
        build_type = re.search(r"CMAKE_BUILD_TYPE:\w+=(\w*)", cache.read()).group(1)
    drawn = [row for row in rows if row["label"] == DRAWN]
    awake = any(row["label"].startswith("awake") for row in rows)
    if drawn:
        print("# Latency while markers are drawn\n\nWritten by `scripts/latency --drawn`, how long is in the table (`--minutes`, "
              "`--seconds`); [latency.md](latency.md) has longer\nruns without.")
    else:
        print("# Latency\n\nWritten by `scripts/latency`; `scripts/latency --minutes 10` for the long run. "
              "[latency_drawn.md](latency_drawn.md) is\nwhile markers are drawn.")
    print("From the stamp of a pressure message, taken just before it is published, to the published estimate: *delivered*, when "
          "it is\nin a subscriber's queue (in the same process, as a nodelet), and *received*, when that subscriber's own thread, "
          "which the system\nhas to wake first, has it in hand. Every message is solved (`paper_one_segment.yaml`, NCM, accuracy "
          "1e-9). Back to the\n[reference](reference.md).\n")
    print("Machine: %s, Linux %s, no real-time priority%s. Build: %s.\n"
          "Load average when this was written: %.1f; with more than 1 or so, other work shared the processors, and the tails are its%s.\n"
          % (processor(), platform.release(), " but where it says *awake*" if awake else "", build_type, os.getloadavg()[0],
             " (but for the\nloops of `keep_awake`, measured last, and what took part with them)" if awake else ""))
    print("Just before, on this machine, with no node: a thread that waits is woken in " + "; ".join(
        "%.0f us at %g Hz (p99 %.0f, p99.9 %.0f; stolen %.1f ms/s)" % (wake[0], rate, *wake[1:])
        for rate, wake in sorted(wakes.items())) +
          ".\n*Stolen*: processor time that this machine wanted and its host gave to others, of all processors together "
          "(`/proc/stat`). It is in\nthe tails, of the node as of the bare wakes. *Echo*: `topic_tools relay` in place of the node, which sends the "
          "pressures back as\nthey are: what TCPROS and this machine take to a node that does nothing, and from there. (Its queues hold ten messages.)"
          + ("" if drawn else "\n*Pinned*: all that takes part on one processor (`taskset`, see [reference](reference.md)): what one "
             "thread hands to the next\nneeds no other processor, which would have to wake first.") +
          ("\n*Awake*: processors kept from idling (`rosrun live_stiffness keep_awake`), and all that takes part with real-time "
           "priority\n(`chrt --rr 10`), driver and subscriber included. From threads of such priority that never rest the kernel still "
           "takes 50 ms of each\nsecond for the others: hence the maxima of *as fast as it goes*." if awake else "") + "\n")
    print("| transport | asked | reached, Hz | sent | lost | delivered: median, us | p99, us | p99.9, us | received: median, us | p99, us | "
          "p99.9, us | max, us | mean solve, us | delivered / solve | largest estimated error | stolen, ms/s |\n" + "|---" * 16 + "|")
    for row in measured:
        solved = ("| | |" if row["kind"] == ECHO else "| %s | %.1f | %s" % (
            row["solve"], float(row["delivered"]) / float(row["solve"]), row["error"]))
        print("| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s %s | %s |" % (
            row["transport"], asked(row), row["reached"], row["sent"], row["lost"], row["delivered"], row["delivered_p99"],
            row["delivered_p999"], row["median"], row["p99"], row["p999"], row["max"], solved, row["stolen"]))
    print("\n| target | measured | |\n|---|---|---|")
    for row in rows:
        limit, p99 = TARGETS_US[row["kind"]], float(row["delivered_p99"])
        wake, times = wakes.get(float(row["rate"])), ""
        if (row["label"], row["rate"]) in echoes and row["kind"] == "TCPROS":
            echo = echoes[row["label"], row["rate"]]
            times = ", %.2f of an echo's %.1f us" % (p99 / echo, echo)
        elif wake and row["label"] in ("", DRAWN):  # the bare wakes were as these were
            times = ", %.1f bare wakes" % (p99 / wake[1])
        print("| %s, %s: p99 of delivered below %g us | %.1f us%s (received: %s us) | %s |" % (
            row["transport"], asked(row), limit, p99, times, row["p99"], "met" if p99 < limit else "**missed**"))
    for row in rows:
        if float(row["rate"]) == 1000.0:
            seconds = int(row["sent"]) / float(row["reached"])
            kept = row["lost"] == "0" and float(row["reached"]) > 999.0
            print("| %s, 1 kHz for %.1f minutes with nothing lost | %s lost, %s Hz | %s |" % (
                row["transport"], seconds / 60.0, row["lost"], row["reached"], "met" if kept else "**missed**"))
    if not drawn:
        return
    print("\n*Drawn*: markers at 100 Hz, ten times the default, read by another process (`rostopic hz`), which needs "
          "processor time\nof its own. Received, against the rows without:\n\n| | median | p99 | p99.9 |\n|---|---|---|---|")
    for row, more in zip([row for row in rows if row not in drawn], drawn):
        ratios = ["%.2f x" % (float(more[name]) / float(row[name])) for name in ("median", "p99", "p999")]
        print("| %s, %s | %s |" % (row["transport"], asked(row), " | ".join(ratios)))


main()
