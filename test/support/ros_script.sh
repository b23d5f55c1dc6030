# For tests with real nodes on a master of their own; to be sourced with BUILD_DIR SOURCE_DIR. Sets build, source, programs,
# work (a folder for logs) and ROS_MASTER_URI on a free port; whatever is in pids is ended at the exit.
set -euo pipefail
build=$1 source=$2 programs=$1/devel/lib/live_stiffness
set +u; source "$build/devel/setup.bash"; set -u
export ROS_HOSTNAME=localhost
port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://localhost:$port
work=$(mktemp -d)
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait || true
  rm -rf "$work"
}
trap cleanup EXIT

fail() { echo "failed: $1"; tail -n 20 "$work"/*.log; exit 1; }
now() { date +%s.%N; }
since() { awk -v a="$1" -v b="$(now)" 'BEGIN { printf "%.2f s", b - a }'; }
# within SECONDS WHAT COMMAND...: waits until the command succeeds.
within() {
  local end=$((SECONDS + $1)) what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do [ $SECONDS -lt $end ] || fail "$what"; sleep 0.05; done
}
