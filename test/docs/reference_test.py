#!/usr/bin/env python3
"""docs/reference.md and docs/parameters.md say what the code does: BUILD_DIR SOURCE_DIR.

Topics and services are compared with those that the running nodes register at a master, parameters with what the running
nodes know, launch arguments with the launch files. A new topic, service or launch
argument is a row in docs/reference.md; everything else `scripts/reference` writes.
"""
import os
import pathlib
import re
import socket
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
import xmlrpc.client

BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
IGNORED = ("/rosout", "/get_loggers", "/set_logger_level", "/clock")
# Scene and further private parameters with which a node shows all its names.
NODES = {
    "stiffness_node": {"scene_file": "paper_one_segment.yaml"},
    "parallel_node": {"scene_file": "stewart_gough.yaml"},
    "rig_simulator": {"scene_file": "paper_one_segment.yaml", "contact_force_n": "[0.1, 0.0, 0.0]"},
    "parallel_rig": {"scene_file": "stewart_gough.yaml"},
    "stiffness_monitor": {},
}
TIMEOUT_S = 30.0
failures = []


def compare(what, documented, real):
    for name in sorted(documented - real):
        failures.append("%s: %s is documented but does not exist" % (what, name))
    for name in sorted(real - documented):
        failures.append("%s: %s exists but is not documented" % (what, name))


def documented_tables(node):
    """{kind: {name: type cell}} of the tables under the node's heading; kinds are in, out and service."""
    page = (SOURCE / "docs/reference.md").read_text()
    section = re.search(r"^## `%s`\n(.*?)(?=^## |\Z)" % node, page, re.M | re.S)
    tables = {"in": {}, "out": {}, "service": {}}
    kind = None
    for line in section.group(1).splitlines() if section else ():
        cells = [part.strip() for part in line.split("|")[1:-1]]
        if cells and cells[0] in tables:
            kind = tables[cells[0]]
        elif cells and kind is not None:
            for name in re.findall(r"`([^`]+)`", cells[0]):
                kind["/" + node + "/" + name[1:] if name.startswith("~") else "/" + name.lstrip("/")] = cells[1]
    return tables


def registered(master, node):
    """{kind: set of names} that the node has registered."""
    state = master.getSystemState("/test")[2]
    names = [{name for name, nodes in part if "/" + node in nodes and not name.endswith(IGNORED)} for part in state]
    return {"out": names[0], "in": names[1], "service": names[2]}


def check_node(master, node, log):
    tables = documented_tables(node)
    wanted = {kind: set(names) for kind, names in tables.items()}
    program = BUILD / "devel/lib/live_stiffness" / node
    parameters = SOURCE / "config" / (node + ".yaml")
    if parameters.exists():
        subprocess.run(["rosparam", "load", str(parameters), "/" + node], check=True)
    for key, value in NODES[node].items():
        if key == "scene_file":
            value = str(SOURCE / "config/scenes" / value)
        subprocess.run(["rosparam", "set", "/%s/%s" % (node, key), value], check=True)
    process = subprocess.Popen([str(program)], stdout=log, stderr=subprocess.STDOUT)
    try:
        end = time.monotonic() + TIMEOUT_S
        real = registered(master, node)
        while real != wanted and time.monotonic() < end and process.poll() is None:
            time.sleep(0.05)  # between two looks
            real = registered(master, node)
        if process.poll() is not None:
            failures.append("%s: ended with status %d" % (node, process.returncode))
        for kind in wanted:
            compare("%s, %s" % (node, kind), wanted[kind], real[kind])
        types = dict(master.getTopicTypes("/test")[2])
        for kind in ("in", "out"):
            for name in wanted[kind] & real[kind]:
                kind_of = types.get(name, "*")
                if kind_of != "*" and kind_of.split("/")[1] not in tables[kind][name]:
                    failures.append("%s, %s: %s is a %s" % (node, kind, name, kind_of))
    finally:
        process.terminate()
        process.wait()


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def check_nodes():
    port = free_port()
    os.environ.update(ROS_MASTER_URI="http://localhost:%d" % port, ROS_HOSTNAME="localhost")
    log_path = BUILD / "reference_test.log"
    with open(log_path, "w") as log:
        server = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=log, stderr=subprocess.STDOUT)
        try:
            master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
            while True:
                try:
                    master.getSystemState("/test")
                    break
                except OSError:
                    if server.poll() is not None:
                        sys.exit("no master: see %s" % log_path)
                    time.sleep(0.05)  # between two looks
            for node in NODES:
                check_node(master, node, log)
        finally:
            server.terminate()
            server.wait()
    for line in log_path.read_text().splitlines():
        if "is not known to" in line:
            failures.append("a key of config/ is not known to its node: " + line.split("] ")[-1])


def check_launch_files():
    page = (SOURCE / "docs/reference.md").read_text()
    documented = {}
    for name, arguments in re.findall(r"^\| `(\w+\.launch)` \| (.*?) \|", page, re.M):
        documented[name] = set(re.findall(r"`(\w+)`", arguments))
    real = {}
    for path in (SOURCE / "launch").glob("*.launch"):
        root = ElementTree.parse(path).getroot()
        real[path.name] = {arg.get("name") for arg in root.findall("arg") if arg.get("value") is None}
    compare("launch files", set(documented), set(real))
    for name in set(documented) & set(real):
        compare(name, documented[name], real[name])


def main():
    status = subprocess.run([str(SOURCE / "scripts/reference"), "--check", "--build", str(BUILD)]).returncode
    if status != 0:
        failures.append("scripts/reference --check: out of date")
    check_launch_files()
    check_nodes()
    for failure in failures:
        print(failure)
    if failures:
        sys.exit("%d differences between docs and code" % len(failures))
    print("ok")


main()
