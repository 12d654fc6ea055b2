#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes the documentation as one static site: the pages with their pictures, an example of a ledger's report, and the
# reference of the headers. No page loads anything from the network. usage: scripts/site.sh [FOLDER] (default out/site)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v doxygen >/dev/null || {
  echo "site.sh needs doxygen: apt-get install doxygen" >&2
  exit 1
}
folder=${1:-out/site}
rm -rf "$folder" && mkdir -p "$folder"
{
  cat docs/Doxyfile
  echo "INPUT += README.md CHANGELOG.md docs third_party_notes"
  echo "FILE_PATTERNS += *.md"
  echo "USE_MDFILE_AS_MAINPAGE = README.md"
  echo "FILTER_PATTERNS = *.md=\"python3 -B scripts/site_filter.py\""
  echo "IMAGE_PATH = docs"
  echo "HTML_EXTRA_FILES = docs/example-report.html LICENSE"
  echo "PROJECT_NUMBER = $(sed -n 's/^project(gloam VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
  echo "GENERATE_TREEVIEW = YES"
  echo "DISABLE_INDEX = YES"
  echo "TOC_INCLUDE_HEADINGS = 2"
  echo "HTML_COLORSTYLE_HUE = 30"
  echo "HTML_COLORSTYLE_SAT = 40"
  echo "OUTPUT_DIRECTORY = $folder"
  echo "HTML_TIMESTAMP = NO"
} | doxygen - 2>"$folder.log" || {
  cat "$folder.log" >&2
  exit 1
}
echo "wrote $folder/index.html"
