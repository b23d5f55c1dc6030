#!/usr/bin/env bash
# keep_awake runs one loop of the lowest class (SCHED_IDLE) on each processor, and none is left when it ends, however. KEEP_AWAKE
set -euo pipefail
log=$(mktemp)
keeper=''
trap 'kill $keeper 2>/dev/null || true; rm -f "$log"' EXIT

fail() { echo "$1"; cat "$log"; exit 1; }
# MESSAGE COMMAND...: waits until COMMAND succeeds, 20 s at most.
await() {
  local message=$1 end=$((SECONDS + 20))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || fail "not within 20 s: $message"
    sleep 0.05  # between two looks
  done
}
all_gone() { ! kill -0 $loops 2>/dev/null; }
processors() { for loop in $loops; do taskset --cpu-list --pid $loop; done | sed 's/.*: //' | sort -u; }
on_each_processor() { [ "$(processors | wc -l)" = "$(nproc)" ]; }
all_idle_class() { for loop in $loops; do chrt --pid $loop | grep -q SCHED_IDLE || return 1; done; }

for signal in TERM KILL; do
  /usr/bin/python3 "$1" --loops __name:=keep_awake >"$log" 2>&1 &
  keeper=$!
  await "says what it does" grep -q 'loops on processors' "$log"
  loops=$(cat /proc/$keeper/task/$keeper/children)
  [ "$(wc -w <<<"$loops")" = "$(nproc)" ] || fail "not $(nproc) loops: $loops"
  await "one on each processor" on_each_processor
  await "of the lowest class" all_idle_class
  kill -$signal $keeper
  wait $keeper || true
  await "no loop is left after SIG$signal" all_gone
done
