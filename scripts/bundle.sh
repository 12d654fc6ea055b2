#!/usr/bin/env bash
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Makes out/gloam-VERSION-linux-x86_64.tar.zst: the program with its shared libraries beside it, for any x86-64 Linux with
# glibc 2.36 or newer. The Vulkan loader and drivers are those of the machine that it runs on. usage: scripts/bundle.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/common.sh
scripts/setup.sh
command -v zstd >/dev/null || {
  echo "bundle.sh needs zstd: apt-get install zstd" >&2
  exit 1
}
configure release build
build build gloam_program
version=$(build/bin/gloam --version | cut -d' ' -f2)
name=gloam-$version-linux-x86_64
folder=out/$name
rm -rf "$folder"
mkdir -p "$folder/lib" "$folder/licences"
install -m 755 build/bin/gloam "$folder/gloam"
strip "$folder/gloam"
install -m 755 scripts/device_report.sh "$folder/device_report.sh"
# Pictures of the built-in scenes by lavapipe, which device_report.sh compares a device's own with.
mkdir -p "$folder/pictures"
for scene in $(build/bin/gloam scenes | awk '{print $1}'); do
  build/bin/gloam render "$scene" --device llvmpipe --size 640x360 --frames 8 --quiet --out "$folder/pictures/${scene#builtin:}.png"
done
cp LICENSE* "$folder/" 2>/dev/null || true

# The C library and the dynamic loader belong to the machine.
own='^(ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libresolv)\.so'
ldd build/bin/gloam | sed -n 's/^\t\(\S*\) => \(\S*\) .*/\1 \2/p' | while read -r library path; do
  [[ $library =~ $own ]] && continue
  install -m 644 "$(readlink -f "$path")" "$folder/lib/$library"
  strip --strip-unneeded "$folder/lib/$library"
  package=$(dpkg -S "$(readlink -f "$path")" 2>/dev/null | cut -d: -f1 | head -n 1 || true)
  [ -z "$package" ] || cp -L "/usr/share/doc/$package/copyright" "$folder/licences/$package" 2>/dev/null || true
done
# Libraries that are inside the program.
for package in libdraco-dev libtinygltf-dev; do
  cp -L "/usr/share/doc/$package/copyright" "$folder/licences/$package"
done
tar -C out -c "$name" | zstd -q -19 -T0 -f -o "$folder.tar.zst"
ls -l "$folder.tar.zst" | awk '{printf "%s: %.1f MB\n", $9, $5 / 1e6}'
