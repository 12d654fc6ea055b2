#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Installs the packages of scripts/packages.txt that are missing. usage: scripts/setup.sh [--tests]
# --tests: those of scripts/packages-tests.txt, too; tests that need one of these are skipped where it cannot be installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup: this is no Debian system: install what scripts/packages.txt names in your system's way" >&2
  exit 0
fi

# install_missing FILE: installs those of its packages that are missing.
install_missing() {
  # Asks for all packages in one call. A package that dpkg does not know counts as missing.
  local wanted missing=() as_root=() installed
  mapfile -t wanted <"$1"
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)
  for package in "${wanted[@]}"; do
    grep -qxF "$package installed" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  echo "setup: installing ${missing[*]}" >&2
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "setup: you are not root and there is no sudo: have these installed: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  local install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}")
  # The package lists may be old or absent: update them once if the first try fails.
  if ! "${install[@]}" </dev/null >/dev/null 2>&1; then
    "${as_root[@]}" apt-get update -q </dev/null >&2 || true
    "${install[@]}" </dev/null >&2 || {
      echo "setup: apt-get could not install ${missing[*]}" >&2
      return 1
    }
  fi
}

install_missing scripts/packages.txt
if [ "${1:-}" = --tests ]; then
  install_missing scripts/packages-tests.txt || echo "setup: tests that need these packages are skipped" >&2
fi
