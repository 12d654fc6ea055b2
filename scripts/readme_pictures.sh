#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Draws those pictures of the README again that show one frame of one scene. usage: scripts/readme_pictures.sh [NAME…]
# Without names: all of them. The commands are those beside the pictures, without dithering, whose noise does not
# compress. Look at the pictures before you commit them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
courtyard=../shared/scenes/courtyard
helmet=$(mktemp --suffix .glb)
trap 'rm -f "$helmet"' EXIT
python3 tests/support/helmet.py "$helmet"

picture() { # NAME SCENE [options]
  local name=$1 scene=$2
  shift 2
  [ "$chosen" = all ] || [[ " $chosen " == *" $name "* ]] || return 0
  if [[ $scene == ../* && ! -f $scene ]]; then
    echo "$name: there is no $scene" >&2
    return 0
  fi
  build/bin/gloam render "$scene" "$@" --set lighting.dither=off --quiet --out "docs/$name.png"
  local bytes
  bytes=$(stat -c %s "docs/$name.png")
  echo "docs/$name.png $((bytes / 1024)) KiB"
  [ "$bytes" -le 307200 ] || echo "docs/$name.png is over 300 KiB" >&2
}

chosen=${*:-all}
picture dusk builtin:dusk --size 576x324
picture helmet "$helmet" --size 720x480
picture meadow builtin:meadow_day --camera near --size 560x315 --frames 12
picture light_lists $courtyard/courtyard-1024.gltf --camera court --size 640x360 --view lights_accurate
picture visibility_slots $courtyard/courtyard.gltf --camera court --size 640x360 --set shadows.mode=deferred --view visibility_slots
picture shadows builtin:shadows --size 960x540
picture backlight builtin:backlight --size 704x396
picture wet_street builtin:wet_street --size 640x360
picture smoke builtin:smoke --size 640x360
picture lens builtin:lens --size 640x360
