#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Builds the program and runs it. usage: scripts/run.sh [arguments of gloam]
# Without arguments: shows builtin:dusk in a window if there is a display, otherwise renders it to out/dusk.png.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
started_in=$PWD
cd "$root"
source scripts/common.sh
scripts/setup.sh
configure release build
[ -x build/bin/gloam ] || echo "the first build takes some minutes" >&2
build build gloam_program

if [ $# -gt 0 ]; then
  cd "$started_in"
  exec "$root/build/bin/gloam" "$@"
fi
if [ -n "${DISPLAY:-}" ] || [ -n "${WAYLAND_DISPLAY:-}" ]; then
  exec build/bin/gloam play builtin:dusk
fi
build/bin/gloam render builtin:dusk --out out/dusk.png --quiet
echo "there is no display: the picture is $root/out/dusk.png"
