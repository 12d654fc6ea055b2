#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Builds the components that need no GPU, gpu and frame for Windows with mingw-w64, and runs their tests under wine.
# usage: scripts/windows.sh [options of ctest]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/common.sh
for tool in x86_64-w64-mingw32-g++-posix wine; do
  command -v "$tool" >/dev/null || {
    echo "windows.sh needs $tool: apt-get install g++-mingw-w64-x86-64-posix wine wine64 googletest" >&2
    exit 1
  }
done
export WINEPREFIX="$PWD/build-windows/wine" WINEDEBUG=-all
configure windows build-windows
build build-windows all
# The first program creates wine's folder, which several at once would do in each other's way.
wineboot --init >/dev/null 2>&1 || true
ctest --preset windows "$@"
