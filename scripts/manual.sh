#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Writes the manual pages gloam.1 and gloam-COMMAND.1 from what the program says with --help.
# usage: scripts/manual.sh PROGRAM FOLDER
set -euo pipefail
program=$1 folder=$2
rm -rf "$folder" && mkdir -p "$folder"
version=$("$program" --version)
# page FILE NAME COMMAND…: one page.
page() {
  local file=$1 name=$2 summary
  shift 2
  summary=$("$@" --help | sed -n 1p)
  help2man --no-info --section=1 --manual="gloam" --version-string="$version" --name="${summary%.}" "$*" |
    sed -e "s/^\.TH [^ ]*/.TH ${name^^}/" -e "s/^gloam \\\\- /${name//-/\\\\-} \\\\- /" >"$folder/$file"
}
page gloam.1 gloam "$program"
commands=$("$program" --help | awk '/^Subcommands:/ {on = 1; next} on && /^  [a-z]/ {print $1}')
for command in $commands; do
  page "gloam-$command.1" "gloam-$command" "$program" "$command"
done
{
  echo '.SH "SEE ALSO"'
  for command in $commands; do echo ".BR gloam-$command (1),"; done | sed '$s/,$//'
} >>"$folder/gloam.1"
