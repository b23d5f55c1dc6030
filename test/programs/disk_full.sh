#!/usr/bin/env bash
# Programs on a disk that is full: they say so, exit non-zero, leave no half file under the final name, and what stood
# there before still does. The disk is a small tmpfs of its own mount namespace. BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
if [ "${3:-}" != inside ]; then
  if ! unshare --map-root-user --mount true 2>/dev/null; then
    echo "skipped: unshare --mount is not permitted here (needs root or user namespaces)"
    exit 77
  fi
  exec unshare --map-root-user --mount "$0" "$1" "$2" inside
fi
work=$(mktemp -d)
disk=$work/disk
mkdir "$disk"
trap 'umount "$disk" 2>/dev/null || true; rm -rf "$work"' EXIT
mount -t tmpfs -o size=128k tmpfs "$disk"
programs=$build/devel/lib/live_stiffness
scene=$source/config/scenes/paper_one_segment.yaml

# fails FILE COMMAND...: as above. FILE is what it would have written.
fails() {
  local file=$1 status=0 output
  shift
  echo "- ${1##*/} to ${file##*/}"
  output=$("$@" 2>&1) || status=$?
  [ $status -ne 0 ] || { echo "$output"; echo "exit status 0"; exit 1; }
  [ $status -lt 128 ] || { echo "$output"; echo "crashed with status $status"; exit 1; }
  grep -q "written" <<<"$output" || { echo "$output"; echo "does not say so"; exit 1; }
  grep "written" <<<"$output"
  [ ! -e "$file.part" ] || { echo "$file.part is left"; exit 1; }
  if [ -e "$work/before" ]; then cmp "$work/before" "$file"; else
    [ ! -e "$file" ] || { ls -l "$disk"; echo "a half file is left"; exit 1; }
  fi
}

"$programs/simulate_bag" "$scene" "$work/session.bag" --seconds 60 --channels 3 2>/dev/null
fails "$disk/out.bag" "$programs/simulate_bag" "$scene" "$disk/out.bag" --seconds 60
fails "$disk/out.bag" "$programs/replay" "$work/session.bag" --scene "$scene" --channel-of-chamber 0 0 1 1 2 2 -o "$disk/out.bag"
awk 'BEGIN { print "time_s,pressure_1_pa,pressure_2_pa,pressure_3_pa,tip_x_m,tip_y_m,tip_z_m,tip_qw,tip_qx,tip_qy,tip_qz"
  for (i = 0; i < 4000; ++i) print i / 40 ",1e4,0,0," 1e-6 * i ",0,0.05,1,0,0,0" }' >"$work/recording.csv"
fails "$disk/recording.bag" "$programs/recording_to_bag" "$work/recording.csv" "$disk/recording.bag"
fails "$disk/map.csv" "$programs/stiffness_map" "$scene" --pressures 0:1e5:4 -o "$disk/map.csv"
"$programs/register_recording" "$scene" "$work/session.bag" "$work/registration.yaml" >/dev/null 2>&1
fails "$disk/wrench.csv" "$programs/estimate_wrench" "$scene" "$work/session.bag" --registration "$work/registration.yaml" \
  -o "$disk/wrench.csv"

# Small files: on a disk without a byte left, over one that is there.
echo "what stood there before" >"$work/before"
cp "$work/before" "$disk/out.yaml"
cat /dev/zero >"$disk/filling" 2>/dev/null || true
fails "$disk/out.yaml" "$programs/register_recording" "$scene" "$work/session.bag" "$disk/out.yaml"
fails "$disk/out.yaml" "$programs/calibrate" "$scene" "$work/session.bag" --parameters youngs_modulus_pa --blocks 0 \
  --quiet -o "$disk/out.yaml"
rm "$work/before"

fails "$work/none" sh -c "printf 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n0,0,0,0,0,0\n' | '$programs/stiffness_solve' '$scene' >/dev/full"
fails "$work/none" sh -c "printf 'l_1_m,l_2_m,l_3_m,l_4_m,l_5_m,l_6_m\\n0.41,0.4,0.4,0.4,0.4,0.4\\n' | '$programs/parallel_solve' '$source/config/scenes/stewart_gough.yaml' >/dev/full"
