# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Functions shared by run.sh and test.sh. Sourced with the root as working directory and under `set -euo pipefail`.

# configure PRESET FOLDER [options of cmake]: configures the build in FOLDER once; after that the build reconfigures itself
# when needed. Also configures again if FOLDER was moved here from another place, or if other sources are edited than before.
configure() {
  local preset=$1 folder=$2 options=("${@:3}") home="" edited alone=""
  if [ -f "$folder/CMakeCache.txt" ]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
    alone=$(sed -n 's/^GLOAM_SOURCES_ALONE:STRING=//p' "$folder/CMakeCache.txt")
  fi
  edited=$(edited_sources)
  [ -f "$folder/build.ninja" ] && [ "$home" = "$PWD" ] && [ "$alone" = "$edited" ] && return 0
  [ -z "$home" ] || [ "$home" = "$PWD" ] || rm -f "$folder/CMakeCache.txt"
  command -v ccache >/dev/null || options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=)
  mkdir -p "$folder"
  echo "configuring $folder" >&2
  if ! cmake --preset "$preset" -DGLOAM_SOURCES_ALONE="$edited" "${options[@]}" >"$folder/configure.log" 2>&1 </dev/null; then
    tail -n 30 "$folder/configure.log" >&2
    echo "configuring failed: see $folder/configure.log" >&2
    return 1
  fi
}

# edited_sources: the sources that differ from the last commit, as a CMake list. They are compiled alone: a change to one
# of them then takes a compiler run of one source, not of its group, and shows that the source includes what it uses.
edited_sources() {
  git diff --name-only HEAD -- '*.cpp' 2>/dev/null </dev/null | tr '\n' ';' | sed 's/;$//' || true
}

# build FOLDER TARGET…: builds the targets; prints how far it is, and the errors if the build fails.
build() {
  local folder=$1
  shift
  if ! NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" 2>&1 </dev/null | tee "$folder/build.log" | show_progress; then
    grep -aE -A8 '^FAILED|error:|undefined reference' "$folder/build.log" | head -n 60 >&2 || tail -n 30 "$folder/build.log" >&2
    echo "the build failed: see $folder/build.log" >&2
    return 1
  fi
}

# show_progress: reads ninja's output and prints "building: n of m". A terminal shows one line that is rewritten; otherwise
# a line follows at each tenth of the way and every 30 seconds, but none within 5 seconds of the last one.
show_progress() {
  local line done total tenth=0 shown=$SECONDS
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  ]] || continue
    done=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    [ "$done" -gt 0 ] || continue
    if [ -t 2 ]; then
      printf '\rbuilding: %d of %d' "$done" "$total" >&2
    elif ((SECONDS - shown >= 30 || (SECONDS - shown >= 5 && done * 10 / total > tenth))); then
      echo "building: $done of $total" >&2
      tenth=$((done * 10 / total)) shown=$SECONDS
    fi
  done
  [ ! -t 2 ] || printf '\r\033[K' >&2
}
