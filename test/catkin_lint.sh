#!/usr/bin/env bash
# catkin_lint finds no error. SOURCE_DIR
# When it stumbles over a file it says so, finds no problems in the rest and exits with 0: that counts as failed here.
set -euo pipefail
output=$(catkin_lint -W0 "$1" 2>&1) || { echo "$output"; exit 1; }
echo "$output"
if grep -q 'cannot lint' <<<"$output"; then exit 1; fi
grep -q 'checked 1 packages and found 0 problems' <<<"$output"
