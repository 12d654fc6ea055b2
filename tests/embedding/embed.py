# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Installs, configures, builds and runs the embedding host. usage: embed.py CMAKE HOST_SOURCE BUILD [CMAKE_ARGUMENT…]"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

OURS = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]((?:engine|modules|shaders)/[^">]+)[">]', re.MULTILINE)
INTEROP = "engine/gpu/vulkan_interop.h"  # for hosts that create their own Vulkan device
PRIVATE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[\"<](?:vulkan/|volk|GLFW/|imgui|tiny_gltf|OpenMesh/|nlohmann/)", re.MULTILINE)


def run(*command):
    print("$", *command, flush=True)
    subprocess.run(command, check=True)


def header_faults(include):
    """Lists headers that include project headers which are not installed, or headers of private libraries."""
    faults = []
    headers = sorted(include.rglob("*.h"))
    for header in headers:
        text = header.read_text(encoding="utf-8")
        name = header.relative_to(include).as_posix()
        faults += [f"{name} includes {path}, which is not installed" for path in OURS.findall(text)
                   if not (include / path).is_file()]
        faults += [f"{name} carries a private library: {line.strip()}" for line in PRIVATE.findall(text)
                   if name != INTEROP]
    return faults if headers else ["no headers were installed"]


def guide_faults(host):
    """Checks that docs/adding-a-module.md quotes the class in veil_module.cpp verbatim."""
    text = (host / "veil_module.cpp").read_text(encoding="utf-8")
    shown = text[text.index("class VeilModule"):text.index("}  // namespace\n")].strip()
    guide = (host.parents[2] / "docs/adding-a-module.md").read_text(encoding="utf-8")
    return [] if shown in guide else ["docs/adding-a-module.md does not show veil_module.cpp as it is"]


def main(cmake, source, build, *arguments):
    work = Path(build) / "embedding"
    prefix = work / "prefix"
    shutil.rmtree(prefix, ignore_errors=True)
    shutil.rmtree(work / "host", ignore_errors=True)
    run(cmake, "--install", build, "--prefix", prefix, "--component", "gloam")
    faults = header_faults(prefix / "include" / "gloam") + guide_faults(Path(source))
    if faults:
        sys.exit("\n".join(faults))
    run(cmake, "-S", source, "-B", work / "host", f"-DCMAKE_PREFIX_PATH={prefix}", *arguments)
    run(cmake, "--build", work / "host", "--parallel", "2")
    run(work / "host" / "host")
    run(work / "host" / "host_module")


if __name__ == "__main__":
    main(*sys.argv[1:])
