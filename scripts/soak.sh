#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Soaks the engine: draws frames of a host that changes everything it may, and checks that live memory stays flat, that the
# validation layer is silent and that ten pictures equal those of fresh processes. Writes out/soak/memory.csv.
# usage: scripts/soak.sh [FRAMES] [options of gloam_soak, e.g. --seed 2]    (default: 20000 frames)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/common.sh
frames=${1:-20000}
shift || true
scripts/setup.sh --tests
configure release build
build build gloam_soak
MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$PWD/build/shader_cache} \
  exec python3 -B tests/soak/soak.py build/bin/gloam_soak out/soak --frames "$frames" --validate "$@"
