#!/usr/bin/env bash
# The bag that all cases are made from: PROGRAMS SOURCE_DIR OUT.bag
set -euo pipefail
"$1/simulate_bag" "$2/test/cases/arm.yaml" "$3" --seconds 24 --rate-hz 20 --program triangle --amplitude-pa 120000 --seed 1 \
  --registration "$2/config/registrations/simulated_rig.yaml" 2>"$3.log" || { cat "$3.log"; exit 1; }
