# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A host takes gloam by add_subdirectory: its installation holds the host alone, unless it asks for gloam, too.
usage: subdirectory.py CMAKE SOURCE WORK [CMAKE_ARGUMENT…]"""
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def run(*command):
    print("$", *command, flush=True)
    subprocess.run(command, check=True)


def installs_gloam(build):
    """Whether the installation of a build tree reads any install script of gloam's folders."""
    return any("libgloam_core" in script.read_text(encoding="utf-8") for script in build.rglob("cmake_install.cmake"))


def main(cmake, source, work, *arguments):
    work = Path(work)
    shutil.rmtree(work, ignore_errors=True)
    build, prefix = work / "build", work / "prefix"
    configure = (cmake, "-S", HERE / "host_subdirectory", "-B", build, f"-DGLOAM_SOURCE={source}", *arguments)
    run(*configure)
    run(cmake, "--build", build, "--parallel", "2", "--target", "app")
    run(cmake, "--install", build, "--prefix", prefix)
    installed = sorted(path.relative_to(prefix).as_posix() for path in prefix.rglob("*") if path.is_file())
    if installed != ["bin/app"]:
        sys.exit(f"the host installs {installed}")
    run(prefix / "bin" / "app")
    if installs_gloam(build):
        sys.exit("gloam has rules to install itself")
    run(*configure, "-DGLOAM_INSTALL=ON")
    if not installs_gloam(build):
        sys.exit("GLOAM_INSTALL=ON adds no rules to install gloam")


if __name__ == "__main__":
    main(*sys.argv[1:])
