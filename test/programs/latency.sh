#!/usr/bin/env bash
# scripts/latency writes one table with a row for each transport and rate, whose figures can be. BUILD_DIR SOURCE_DIR
set -euo pipefail
page=$(mktemp)
trap 'rm -f "$page"' EXIT
BUILD=$1 "$2/scripts/latency" --minutes 0.02 "$page"
cat "$page"
awk -F ' *\\| *' '
  /^\| (TCPROS|nodelet)/ {
    ++rows
    seen[$2 "," $3] = 1
    if (!($5 > 0 && $6 >= 0 && $6 < $5 && $7 > 0 && $7 <= $8 && $8 <= $9)) { print "cannot be: " $0; exit bad = 1 }
    if ($3 == "1000 Hz" && $2 !~ /markers/ && !($5 > 100 && $5 <= 1201)) { print "not 1.2 s of 1 kHz: " $0; exit bad = 1 }
  }
  END {
    if (bad) exit 1
    exit !(rows == 7 && seen["TCPROS,40 Hz"] && seen["TCPROS,1000 Hz"] && seen["TCPROS,as fast as it goes"] &&
           seen["nodelet,40 Hz"] && seen["nodelet,1000 Hz"] && seen["nodelet,as fast as it goes"])
  }' "$page" || { echo "failed: the table is not whole"; exit 1; }
