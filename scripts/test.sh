#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Builds and runs all tests: first all tests in the release build, then the suites labelled `sanitize` under ASan and UBSan.
# To run the suites labelled `sanitize_long` under sanitizers too: cmake --build --preset asan; ctest --preset asan-long
# usage: scripts/test.sh [arguments of ctest, e.g. -R ecs]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/common.sh
scripts/setup.sh --tests

jobs=${CTEST_PARALLEL_LEVEL:-$(nproc)}
reports=()

# run_tests PRESET FOLDER NAME [ctest arguments]: runs the tests and leaves FOLDER/junit.xml and the log for the report.
run_tests() {
  local preset=$1 folder=$2 name=$3
  shift 3
  echo "testing: $name" >&2
  rm -f "$folder/junit.xml" "$folder/Testing/Temporary/LastTest.log"
  # Ignores the exit status of ctest: the report counts failing tests.
  ctest --preset "$preset" -j "$jobs" --output-junit "$PWD/$folder/junit.xml" "$@" >"$folder/ctest.log" 2>&1 </dev/null || true
  if grep -q 'No tests were found' "$folder/ctest.log"; then
    echo "no test of the $name run was asked for" >&2
    return 0
  fi
  if [ ! -f "$folder/junit.xml" ]; then
    tail -n 20 "$folder/ctest.log" >&2
    echo "ctest failed: see $folder/ctest.log" >&2
    exit 1
  fi
  reports+=("$name=$folder")
}

configure release build
build build
run_tests release build release "$@"

# The shaders are those of the release build: compiling them again would take a minute.
configure asan build-asan -DGLOAM_SHADERS_FROM="$PWD/build"
build build-asan gloam_sanitize_tests
GLOAM_FUZZ_SECONDS=${GLOAM_FUZZ_SECONDS:-30} run_tests asan build-asan asan "$@"

exec python3 -B scripts/test_report.py "${reports[@]}"
