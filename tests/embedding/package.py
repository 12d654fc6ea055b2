# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Checks the installed package: its headers are those that docs/public-headers.md lists, no file holds a path of the machine that
built it, and hosts compile and link by pkg-config alone, with any clip-space setting of GLM.
usage: package.py COMPILER SOURCE BUILD PREFIX WORK [PKG_CONFIG]
       package.py --table PREFIX    prints the tables of docs/public-headers.md"""
import os
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

PAGE = "docs/public-headers.md"
ROW = re.compile(r"^\| `([a-z_/0-9]+)` \| (.*) \|$", re.MULTILINE)
WARNINGS = ("-Wall", "-Wextra", "-Wno-missing-field-initializers", "-Werror")

# A host's own projection keeps the depth convention that the host chose, and gloam's is the same with both.
GLM_PROBE = """#include <cstdio>
#include <glm/ext/matrix_clip_space.hpp>
#include "engine/math/frustum.h"
#include "engine/math/packing.h"
#include "engine/math/view_projection.h"
#include "engine/render/draws/caster_source.h"
#include "engine/render/view.h"
int main() {
  const glm::mat4 own = glm::perspective(1.0f, 1.5f, 1.0f, 10.0f);
  const glm::vec4 near = own * glm::vec4(0.0f, 0.0f, -1.0f, 1.0f);
  std::printf("own %.1f\\n", static_cast<double>(near.z / near.w));
  gloam::CasterProjection projection;
  projection.origin = gloam::dvec3(1.0, 2.0, 3.0);
  projection.clip_from_relative = gloam::dmat4(0.5);
  const gloam::mat4 clip = projection.clip_from(gloam::dmat4(2.0));
  for (int i = 0; i < 16; ++i) std::printf("%a ", static_cast<double>(clip[i / 4][i % 4]));
  std::printf("%zu %zu %zu %u\\n", sizeof(gloam::RenderView), sizeof(gloam::ViewProjection), sizeof(gloam::CasterSource),
              gloam::pack_normal_snorm16(gloam::vec3(0.6f, 0.0f, 0.8f)));
}
"""


def run(*command, **options):
    print("$", *command, flush=True)
    return subprocess.run([str(part) for part in command], check=True, text=True, **options)


def installed_headers(include):
    """The headers by folder, without those that only include one which has moved into a room."""
    folders = defaultdict(set)
    for path in include.rglob("*"):
        if path.suffix not in (".h", ".glsl"):
            continue
        if re.fullmatch(r'#pragma once\n#include "[^"]+"\n', path.read_text(encoding="utf-8")):
            continue
        folders[path.parent.relative_to(include).as_posix()].add(path.name)
    return folders


def table(folders):
    rows = [f"| `{folder}` | {', '.join(f'`{name}`' for name in sorted(names))} |" for folder, names in sorted(folders.items())]
    return "\n".join(["| Folder | Headers |", "| --- | --- |", *rows])


def header_faults(source, include):
    listed = {folder: set(re.findall(r"`([^`]+)`", names)) for folder, names in ROW.findall((source / PAGE).read_text(encoding="utf-8"))}
    installed = installed_headers(include)
    faults = []
    for folder in sorted({*listed, *installed}):
        have, want = installed.get(folder, set()), listed.get(folder, set())
        faults += [f"{PAGE} does not list {folder}/{name}, which is installed" for name in sorted(have - want)]
        faults += [f"{PAGE} lists {folder}/{name}, which is not installed" for name in sorted(want - have)]
    return faults


def path_faults(prefix, *folders):
    """Files of the package that name a folder of the machine that built it."""
    faults = []
    for path in sorted(path for path in prefix.rglob("*") if path.is_file()):
        content = path.read_bytes()
        faults += [f"{path.relative_to(prefix)} names {folder}" for folder in folders if os.fsencode(str(folder)) in content]
    return faults


class PkgConfig:
    def __init__(self, program, prefix):
        files = [*prefix.glob("lib*/pkgconfig/gloam*.pc"), *prefix.glob("lib/*/pkgconfig/gloam*.pc")]
        self.names = sorted(path.stem for path in files)
        self.program = program
        self.environment = {**os.environ, "PKG_CONFIG_PATH": str(files[0].parent)} if files else dict(os.environ)

    def flags(self, *names):
        done = subprocess.run([self.program, "--cflags", "--libs", *names], check=True, text=True, env=self.environment, stdout=subprocess.PIPE)
        return done.stdout.split()


def pkg_config_faults(compiler, pkg, prefix, work, source):
    faults = [] if len(pkg.names) > 30 else [f"only {len(pkg.names)} pkg-config files are installed"]
    for name in pkg.names:
        done = subprocess.run([pkg.program, "--print-errors", "--exists", name], check=False, text=True, env=pkg.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        faults += [f"{name}.pc: {done.stdout}"] if done.returncode else []
    libraries = {path.stem.removeprefix("libgloam_") for path in prefix.rglob("libgloam_*.a")}
    faults += [f"no pkg-config file for {name}" for name in sorted(libraries) if f"gloam-{name}" not in pkg.names]
    examples = prefix / "share" / "gloam" / "examples"
    # A part without the packages of the others, and the whole library.
    for program, part, file in (("ecs", "gloam-ecs", source / "tests/embedding/host_ecs/host_ecs.cpp"), ("host", "gloam", examples / "host.cpp"),
                                ("minimal", "gloam", examples / "minimal.cpp")):
        flags = pkg.flags(part)
        if part != "gloam":
            faults += [f"{part} asks for {flag}" for flag in flags if re.search(r"draco|OpenMesh|embree|webp|gloam_gpu", flag)]
        run(compiler, "-std=c++20", "-O1", *WARNINGS, file, f"-I{file.parent}", *flags, "-o", work / program)
        if program != "minimal":  # which draws
            run(work / program)
    return faults


def glm_faults(compiler, pkg, work):
    """gloam's headers give the same results with and without GLM_FORCE_DEPTH_ZERO_TO_ONE, and leave the setting to the host."""
    (work / "probe.cpp").write_text(GLM_PROBE, encoding="utf-8")
    said = []
    for number, define in enumerate(((), ("-DGLM_FORCE_DEPTH_ZERO_TO_ONE",))):
        program = work / f"probe{number}"
        run(compiler, "-std=c++20", *WARNINGS, *define, work / "probe.cpp", *pkg.flags("gloam-render"), "-o", program)
        said.append(run(program, stdout=subprocess.PIPE).stdout.splitlines())
    faults = [] if said[0][1:] == said[1][1:] else ["gloam's results depend on GLM_FORCE_DEPTH_ZERO_TO_ONE"]
    return faults + ([] if (said[0][0], said[1][0]) == ("own -1.0", "own 0.0") else [f"the host's projections have other depths: {said}"])


def main(compiler, source, build, prefix, work, program="pkg-config"):
    source, build, prefix, work = Path(source), Path(build), Path(prefix), Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    pkg = PkgConfig(program, prefix)
    faults = header_faults(source, prefix / "include" / "gloam") + path_faults(prefix, source, build)
    faults += pkg_config_faults(compiler, pkg, prefix, work, source) + glm_faults(compiler, pkg, work)
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    if sys.argv[1] == "--table":
        print(table(installed_headers(Path(sys.argv[2]) / "include" / "gloam")))
    else:
        main(*sys.argv[1:])
