#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Makes the release in out/: an archive of everything (.tar.zst), a Debian package of the program and one of the library
# (.deb), and the documentation as a site. usage: scripts/package.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/common.sh
scripts/setup.sh
for tool in help2man zstd dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || {
    echo "package.sh needs $tool: apt-get install help2man zstd dpkg-dev" >&2
    exit 1
  }
done
# Without the tests: they are not in the packages.
configure release build-package -B build-package -DGLOAM_TESTS=OFF
build build-package all
scripts/manual.sh build-package/bin/gloam build-package/manual
python3 -B tests/hygiene/linked_notes.py . build-package build-package/gloam.spdx.json
mkdir -p out
(cd build-package && cpack --config CPackConfig.cmake)
scripts/site.sh out/site
ls -l out
