# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Functions shared by run.sh and test.sh. Sourced with the root as working directory and under `set -euo pipefail`.

# configure PRESET FOLDER: configures the build in FOLDER once; after that the build reconfigures itself when needed.
# Also configures again if FOLDER was moved here from another place.
configure() {
  local preset=$1 folder=$2 options=() home=""
  [ -f "$folder/CMakeCache.txt" ] && home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
  [ -f "$folder/build.ninja" ] && [ "$home" = "$PWD" ] && return 0
  [ -z "$home" ] || [ "$home" = "$PWD" ] || rm -f "$folder/CMakeCache.txt"
  command -v ccache >/dev/null || options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=)
  # In CI every build is a clean one, so build time counts most.
  [ -z "${CI:-}" ] || options+=(-DGLOAM_LAYERS_TOGETHER=ON)
  mkdir -p "$folder"
  echo "configuring $folder" >&2
  if ! cmake --preset "$preset" "${options[@]}" >"$folder/configure.log" 2>&1 </dev/null; then
    tail -n 30 "$folder/configure.log" >&2
    echo "configuring failed: see $folder/configure.log" >&2
    return 1
  fi
}

# build FOLDER TARGET…: builds the targets; prints nothing unless the build fails.
build() {
  local folder=$1
  shift
  if ! ninja -C "$folder" "$@" >"$folder/build.log" 2>&1 </dev/null; then
    grep -aE -A8 '^FAILED|error:|undefined reference' "$folder/build.log" | head -n 60 >&2 || tail -n 30 "$folder/build.log" >&2
    echo "the build failed: see $folder/build.log" >&2
    return 1
  fi
}
