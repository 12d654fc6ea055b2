#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Installs a package of the program on a bare Debian 12, as apt does with what it depends on, and draws the default scene
# there. Needs root, mmdebstrap and a Debian mirror. usage: scripts/try_package.sh out/gloam_VERSION_amd64.deb [PICTURE]
set -euo pipefail
package=$(realpath "$1")
picture=$(realpath -m "${2:-out/bare.png}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
root=$folder/debian
mmdebstrap --quiet --variant=apt bookworm "$root"
cp "$package" "$root/gloam.deb"
chroot "$root" sh -c 'apt-get update -qq &&
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /gloam.deb' >"$folder/log" 2>&1 || {
  tail -n 20 "$folder/log" >&2
  exit 1
}
chroot "$root" sh -c 'cd /tmp && gloam --version && gloam render builtin:dusk --size 640x360 --frames 8 --out bare.png'
mkdir -p "$(dirname "$picture")"
cp "$root/tmp/bare.png" "$picture"
echo "wrote $picture"
