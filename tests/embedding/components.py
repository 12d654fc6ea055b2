# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Builds hosts that use parts of the installed package, where the packages of other parts cannot be found.
usage: components.py COMPILER CMAKE PREFIX WORK [CMAKE_ARGUMENT…]

Exit status 77: the compiler is absent."""
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
GPU_PACKAGES = ("Vulkan", "draco", "OpenMesh", "embree", "OpenEXR", "meshoptimizer", "nlohmann_json")
NO_GPU = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=TRUE" for name in GPU_PACKAGES]
NO_GLM = ["-DCMAKE_DISABLE_FIND_PACKAGE_glm=TRUE"]
# Programs with their arguments. host_threads: the number of threads that it may have.
HOSTS_WITHOUT_GLM = (("host_jobs",), ("host_ecs",), ("host_static",), ("host_threads", "1"), ("host_threads", "2"), ("host_threads", "4"),
                     ("host_plugin", "plugin.so"))

# A find_package call, options for CMake, what CMake must say if the call must fail, and code that runs after it.
PROBES = (
    ("gloam REQUIRED COMPONENTS ecs lamps", [],
     ("gloam has no component lamps", "Its components are", "lights_cpu", "schedule", "shadows"), ""),
    ("gloam REQUIRED COMPONENTS lights", NO_GPU, ("Component lights of gloam needs the package",), ""),
    ("gloam REQUIRED COMPONENTS gpu", NO_GPU, ("Component gpu of gloam needs the package Vulkan",), ""),
    ("gloam REQUIRED", NO_GPU, ("Component gloam of gloam needs the package",), ""),
    ("gloam COMPONENTS ecs lamps", [], (), "if(gloam_FOUND OR NOT gloam_ecs_FOUND OR gloam_lamps_FOUND)\n  message(FATAL_ERROR wrong)\nendif()"),
    ("gloam REQUIRED COMPONENTS ecs OPTIONAL_COMPONENTS lights lights_cpu", NO_GPU, (),
     "if(gloam_lights_FOUND OR TARGET gloam::lights OR NOT TARGET gloam::ecs OR NOT TARGET gloam::lights_cpu OR TARGET gloam::gpu)\n"
     "  message(FATAL_ERROR wrong)\nendif()"),
    ("gloam REQUIRED", [], (), "if(NOT TARGET gloam::gloam OR NOT TARGET gloam::accuracy OR NOT TARGET gloam::shaders_shadows)\n  message(FATAL_ERROR wrong)\nendif()"),
)


def run(*command):
    print("$", *command, flush=True)
    subprocess.run(command, check=True)


def run_program(*command):
    """Runs a host. Exit status 77: it cannot do here what it tests."""
    print("$", *command, flush=True)
    done = subprocess.run(command, check=False)
    if done.returncode == 77:
        print("SKIPPED:", *command, flush=True)
    elif done.returncode != 0:
        sys.exit(f"{command[0].name} failed with status {done.returncode}")


def probe_faults(cmake, prefix, work, arguments):
    faults = []
    for number, (call, options, sentences, code) in enumerate(PROBES):
        source = work / f"probe{number}"
        shutil.rmtree(source, ignore_errors=True)
        source.mkdir(parents=True)
        (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(probe LANGUAGES C CXX)\n"
                                               f"find_package({call})\n{code}\n", encoding="utf-8")
        done = subprocess.run([cmake, "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={prefix}", *options, *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        said = " ".join(done.stdout.split())
        if (done.returncode == 0) == bool(sentences) or not all(sentence in said for sentence in sentences):
            faults.append(f"find_package({call}) with {options}: {done.stdout}")
    return faults


def stripped_size(program):
    stripped = program.with_suffix(".stripped")
    run("strip", "-o", stripped, program)
    return stripped.stat().st_size


def main(compiler, cmake, prefix, work, *arguments):
    program = shutil.which(compiler) or shutil.which(f"{compiler}-14")  # Debian's package clang-14 installs clang++-14 only
    if not program:
        print(f"{compiler} is absent")
        sys.exit(77)
    work = Path(work) / compiler.rstrip("+")
    arguments = [*arguments, f"-DCMAKE_CXX_COMPILER={program}"]
    faults = probe_faults(cmake, prefix, work, arguments) if compiler == "g++" else []
    if faults:
        sys.exit("\n".join(faults))
    for host, options, programs in (("host_ecs", NO_GPU + NO_GLM, HOSTS_WITHOUT_GLM),
                                    ("host_cpu", NO_GPU, (("host_cpu",), ("host_cpu_unsectioned",)))):
        build = work / host
        shutil.rmtree(build, ignore_errors=True)
        run(cmake, "-S", HERE / host, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", *options, *arguments)
        run(cmake, "--build", build, "--parallel", "2")
        for name, *parameters in programs:
            run_program(build / name, *(build / p if p.endswith(".so") else p for p in parameters))
    sectioned, whole = (stripped_size(work / "host_cpu" / name) for name in ("host_cpu", "host_cpu_unsectioned"))
    print(f"host_cpu has {sectioned} bytes; {whole} without --gc-sections")
    if sectioned >= whole:
        sys.exit("--gc-sections drops nothing: the library's objects have no section for each function")


if __name__ == "__main__":
    main(*sys.argv[1:])
