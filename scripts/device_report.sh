#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes one folder that says how gloam works on this machine's device: the self-test, a picture of every built-in scene
# and how much it differs from the stored one, and the benchmarks. usage: device_report.sh OUT [DEVICE]
set -uo pipefail
[ $# -ge 1 ] || {
  echo "usage: device_report.sh OUT [DEVICE]" >&2
  exit 2
}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
gloam=$here/gloam
[ -x "$gloam" ] || gloam=$here/../build/bin/gloam
out=$1 device=${2:-auto} failed=0
mkdir -p "$out/pictures"

# part NAME command…: runs a part of the report, and notes its time and exit code.
part() {
  local name=$1 begin=$SECONDS
  shift
  "$@" >"$out/$name.txt" 2>&1
  local code=$?
  echo "$name: exit $code, $((SECONDS - begin)) s" | tee -a "$out/parts.txt"
  [ $code -eq 0 ] || failed=1
}

: >"$out/parts.txt"
{ uname -srm; "$gloam" --version; } >"$out/machine.txt"
part selftest timeout 240 "$gloam" selftest --quick --device "$device" --out "$out/selftest"
for scene in $("$gloam" scenes | awk '{print $1}'); do
  name=${scene#builtin:}
  part "picture_$name" timeout 60 "$gloam" render "$scene" --device "$device" --size 640x360 --frames 8 \
    --out "$out/pictures/$name.png" --stats "$out/pictures/$name.json"
  # Blades of grass are about a pixel wide, so a device with another grid of subpixels draws other ones of their pixels.
  case $name in meadow* | dusk) most=0.045 ;; *) most=0.015 ;; esac
  [ ! -f "$here/pictures/$name.png" ] ||
    part "compare_$name" "$gloam" compare "$out/pictures/$name.png" "$here/pictures/$name.png" --most $most
done
part validation timeout 60 "$gloam" render builtin:dusk --device "$device" --size 320x180 --frames 3 --validate \
  --out "$out/pictures/validated.png"
size=1920x1080
grep -q '"type": *"cpu"' "$out/pictures/plain.json" && size=320x180
part bench timeout 150 "$gloam" bench lights shadows.frame frame.wall --device "$device" --size $size --json "$out/bench.json"
exit $failed
