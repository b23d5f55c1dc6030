#!/usr/bin/env python3
"""What stiffness_node asks the master while nothing changes: the whole graph at most once in ten looks, after those at
the start. BUILD_DIR SOURCE_DIR. The master is rosmaster's, in this process, so that its calls can be counted."""
import collections
import os
import pathlib
import socket
import subprocess
import sys
import time

import rosmaster.master
import rosmaster.master_api

BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
SETTLED, LOOKS, PATIENCE_S = 3, 25, 60.0
calls = collections.Counter()  # by method; lookupService: for the service by which a process knows itself, once a look


def count(method):
    original = getattr(rosmaster.master_api.ROSMasterHandler, method)

    def counted(handler, *arguments):
        if method != "lookupService" or arguments[1].endswith("/get_loggers"):
            calls[method] += 1
        return original(handler, *arguments)

    setattr(rosmaster.master_api.ROSMasterHandler, method, counted)


def wait_for_looks(number):
    end = time.monotonic() + PATIENCE_S
    while calls["lookupService"] < number:
        if time.monotonic() > end or node.poll() is not None:
            sys.exit("only %d of %d looks within %g s" % (calls["lookupService"], number, PATIENCE_S))
        time.sleep(0.05)  # between two of ours
    return calls.copy()


for counted_method in ("getSystemState", "getTopicTypes", "lookupService"):
    count(counted_method)
with socket.socket() as probe:
    probe.bind(("", 0))
    port = probe.getsockname()[1]
os.environ.update(ROS_MASTER_URI="http://localhost:%d" % port, ROS_HOSTNAME="localhost")
master = rosmaster.master.Master(port=port)
master.start()  # waits until it answers
node = subprocess.Popen([str(BUILD / "devel/lib/live_stiffness/stiffness_node"),
                         "_scene_file:=%s" % (SOURCE / "config/scenes/paper_one_segment.yaml")])
try:
    before = wait_for_looks(SETTLED)
    after = wait_for_looks(SETTLED + LOOKS)
finally:
    node.terminate()
    node.wait()
    master.stop()
for method in ("getSystemState", "getTopicTypes"):
    asked = after[method] - before[method]
    print("%s: %d times in %d looks" % (method, asked, LOOKS))
    if not LOOKS // 10 <= asked <= LOOKS // 10 + 1:
        sys.exit("%s: must be once in ten looks" % method)
