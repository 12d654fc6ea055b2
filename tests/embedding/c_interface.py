# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Runs the hosts in C and in Rust, and compares their pictures with that of the smallest host in C++. The host in Rust is
compiled here, with what pkg-config says. usage: c_interface.py HOST_BUILD SOURCE PREFIX

Exit status 77: there is no Vulkan device."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

SKIPPED = 77


def pictures(build, name, *files):
    ran = subprocess.run([Path(build) / name], cwd=build, check=False).returncode
    if ran != 0:
        sys.exit(ran)
    return [(Path(build) / file).read_bytes() for file in files]


def build_rust(build, source, prefix):
    """Whether there is a compiler; the host is then in the folder of the others."""
    if shutil.which("rustc") is None or shutil.which("pkg-config") is None:
        print("SKIPPED: the host in Rust, because rustc or pkg-config is not installed (scripts/packages-dev.txt)")
        return False
    folders = [str(path.parent) for path in Path(prefix).rglob("gloam-c_interface.pc")]
    if not folders:
        sys.exit("the package has no gloam-c_interface.pc")
    env = dict(os.environ, PKG_CONFIG_PATH=os.pathsep.join(folders))
    libraries = subprocess.run(["pkg-config", "--static", "--libs", "gloam-c_interface"], env=env, check=True, text=True,
                               capture_output=True).stdout.split()
    command = ["rustc", "--edition", "2021", "-C", "linker=c++", "-o", str(Path(build) / "rust_host"),
               str(Path(source) / "tests/embedding/host/host.rs")]
    # Static libraries that need each other, and the C++ library.
    link = ["-Wl,--start-group", *libraries, "-Wl,--end-group", "-lstdc++"]
    subprocess.run(command + [f"-Clink-arg={word}" for word in link], check=True)
    return True


def main(build, source, prefix):
    (wanted,) = pictures(build, "minimal", "minimal.ppm")
    first, old, again, *others = pictures(build, "c_host", "minimal_c.ppm", "minimal_c_old.ppm", "minimal_c_again.ppm",
                                          "minimal_c_changed.ppm", "minimal_c_normals.ppm")
    faults = [name for name, picture in (("C", first), ("C of an older header", old), ("C after changes", again))
              if picture != wanted]
    if wanted in others:
        sys.exit("a lamp, a pyramid or the visualizer that the host in C has added is not in its picture")
    if build_rust(build, source, prefix) and pictures(build, "rust_host", "minimal_rust.ppm") != [wanted]:
        faults.append("Rust")
    if faults:
        sys.exit(f"the picture of the host in {' and '.join(faults)} is not that of the host in C++")
    print("all pictures are equal")


if __name__ == "__main__":
    main(*sys.argv[1:])
