# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Compiles the installed headers with a compiler, then builds and runs the embedding hosts.
usage: embed.py COMPILER CMAKE HOST_SOURCE BUILD [CMAKE_ARGUMENT…]

The run with g++ installs the package first. Exit status 77: the compiler is absent."""
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
    """Lists headers and shaders that include files of the project which are not installed, or headers of private libraries."""
    faults = []
    headers = sorted([*include.rglob("*.h"), *include.rglob("*.glsl")])
    for header in headers:
        text = header.read_text(encoding="utf-8")
        name = header.relative_to(include).as_posix()
        faults += [f"{name} includes {path}, which is not installed" for path in OURS.findall(text)
                   if not (include / path).is_file()]
        faults += [f"{name} carries a private library: {line.strip()}" for line in PRIVATE.findall(text)
                   if name != INTEROP]
    return faults if headers else ["no headers were installed"]


WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wno-sign-conversion", "-Wno-missing-field-initializers",
            "-Werror"]


def compile_headers(compiler, include, file, *flags):
    """Compiles all installed headers together, without code. Returns what the compiler says; empty: nothing."""
    file.write_text("".join(f'#include "{header.relative_to(include).as_posix()}"\n' for header in sorted(include.rglob("*.h"))
                            if not header.name.endswith(("_shared.h", "shaders.h")) and header.relative_to(include).as_posix() != INTEROP),
                    encoding="utf-8")
    return subprocess.run([compiler, "-std=c++20", "-fsyntax-only", f"-I{include}", *WARNINGS, *flags, file], check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout


def compiler_faults(compiler, include, work):
    """Headers compile, also without exceptions and type information, and refuse other layouts of GLM's types."""
    faults = []
    source = work / f"headers_{Path(compiler).name}.cpp"
    for flags in ([], ["-fno-exceptions", "-fno-rtti"]):
        said = compile_headers(compiler, include, source, *flags)
        faults += [f"{compiler} {' '.join(flags)}: {said[:2000]}"] if said else []
    for setting in ("GLM_FORCE_DEFAULT_ALIGNED_GENTYPES", "GLM_FORCE_QUAT_DATA_WXYZ"):
        if "compile sources that include gloam without" not in compile_headers(compiler, include, source, f"-D{setting}"):
            faults.append(f"{compiler}: {setting} is not refused in a sentence")
    return faults


FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NOT_BUILT = ("sh",)  # languages of blocks that are commands


def guide_faults(host):
    """Checks that the code on the pages is code that is built: docs/adding-a-module.md shows the files of the veil module and parts
    of CMake lists, README.md the smallest host."""
    root = host.parents[2]
    page = "docs/adding-a-module.md"
    blocks = [(language, code) for language, code in FENCED.findall((root / page).read_text(encoding="utf-8")) if language not in NOT_BUILT]
    whole = [host / "veil_module.h", host / "veil_module.cpp", *sorted((host / "shaders/veil").iterdir())]
    built = [*whole, host / "CMakeLists.txt", root / "modules/fog/CMakeLists.txt", root / "tests/modules/fog/CMakeLists.txt"]
    texts = [without_licence(path) + "\n" for path in built]
    faults = [f"{page} does not show {path.relative_to(host)} as it is" for path in whole
              if without_licence(path) + "\n" not in (code for _, code in blocks)]
    faults += [f"{page} shows code that is in no built file: {code.strip().splitlines()[0]} …" for _, code in blocks
               if not any(code in text for text in texts)]
    minimal = f"```cpp\n{without_licence(host / 'minimal.cpp')}\n```\n"
    if minimal not in (root / "README.md").read_text(encoding="utf-8"):
        faults.append("README.md does not show minimal.cpp as it is")
    return faults


def without_licence(path):
    """The text of a source file without its first two lines."""
    return path.read_text(encoding="utf-8").split("\n", 2)[2].strip()


def main(compiler, cmake, source, build, *arguments):
    program = shutil.which(compiler) or shutil.which(f"{compiler}-14")  # Debian's package clang-14 installs clang++-14 only
    if not program:
        print(f"{compiler} is absent")
        sys.exit(77)
    work = Path(build) / "embedding"
    prefix = work / "prefix"
    include = prefix / "include" / "gloam"
    examples = prefix / "share" / "gloam" / "examples"
    faults = []
    if compiler == "g++":
        shutil.rmtree(prefix, ignore_errors=True)
        run(cmake, "--install", build, "--prefix", prefix, "--component", "gloam")
        faults += header_faults(include) + guide_faults(Path(source))
    faults += compiler_faults(program, include, work)
    if faults:
        sys.exit("\n".join(faults))
    host = work / ("host" if compiler == "g++" else "host_clang")
    shutil.rmtree(host, ignore_errors=True)
    run(cmake, "-S", examples, "-B", host, f"-DCMAKE_PREFIX_PATH={prefix}", *arguments, f"-DCMAKE_CXX_COMPILER={program}")
    run(cmake, "--build", host, "--parallel", "2")
    run(host / "host")
    run(host / "host_module")


if __name__ == "__main__":
    main(*sys.argv[1:])
