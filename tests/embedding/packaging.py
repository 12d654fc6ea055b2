# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Tries the vcpkg port and the Conan recipe without vcpkg and Conan, which Debian does not have: stand-ins for their functions
configure gloam with the options that port and recipe pass. usage: packaging.py CMAKE SOURCE WORK"""
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import types
from pathlib import Path

# The helpers that vcpkg gives to a port. Configuring is done, so a wrong option or a missing folder fails.
STAND_INS = """
set(CURRENT_HOST_INSTALLED_DIR "@WORK@/host")
set(CURRENT_PACKAGES_DIR "@WORK@/packages")
function(vcpkg_check_linkage)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(ARG "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${ARG_SOURCE_PATH} -B @WORK@/vcpkg --warn-uninitialized ${ARG_OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(vcpkg_cmake_install)
  if(NOT EXISTS @WORK@/vcpkg/cmake_install.cmake)
    message(FATAL_ERROR "nothing to install")
  endif()
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(ARG "" "PACKAGE_NAME;CONFIG_PATH" "" ${ARGN})
  file(READ @WORK@/vcpkg/cmake_install.cmake installs)
  string(FIND "${installs}" "/${ARG_CONFIG_PATH}/gloamTargets-" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${ARG_CONFIG_PATH} has no ${ARG_PACKAGE_NAME}Config.cmake")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(ARG "" "" "FILE_LIST" ${ARGN})
  if(NOT EXISTS ${ARG_FILE_LIST})
    message(FATAL_ERROR "${ARG_FILE_LIST} does not exist")
  endif()
endfunction()
include("@PORT@/portfile.cmake")
"""


def vcpkg_faults(cmake, source, work):
    port = source / "packaging" / "vcpkg" / "ports" / "gloam"
    manifest = json.loads((port / "vcpkg.json").read_text(encoding="utf-8"))
    version = re.search(r"project\(gloam VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
    names = [part if isinstance(part, str) else part["name"] for part in manifest["dependencies"]]
    faults = [] if manifest["name"] == "gloam" and manifest["version"] == version else ["vcpkg.json has another name or version"]
    faults += [] if names == sorted(names) and len(set(names)) == len(names) else ["dependencies of vcpkg.json are not sorted"]
    for folder, tool in (("glslang", "glslangValidator"), ("spirv-tools", "spirv-opt")):
        (work / "host" / "tools" / folder).mkdir(parents=True)
        (work / "host" / "tools" / folder / tool).symlink_to(shutil.which(tool))
    script = work / "port.cmake"
    script.write_text(STAND_INS.replace("@WORK@", str(work)).replace("@PORT@", str(port)), encoding="utf-8")
    done = subprocess.run([cmake, "-P", script], check=False, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return faults + ([done.stdout[-3000:]] if done.returncode or "Manually-specified variables were not used" in done.stdout else [])


def stand_in_conan(cmake, source, work, used):
    """Modules with the few names of Conan that the recipe imports."""

    class ConanFile:
        recipe_folder, export_sources_folder, source_folder = str(source / "packaging" / "conan"), str(work / "exported"), str(work / "exported")
        package_folder = str(work / "package")

        def __init__(self):
            self.cpp_info = types.SimpleNamespace(set_property=lambda *_: None)

    def copy(_, pattern, folder, target):
        paths = [path for path in Path(folder).glob(pattern.replace("/*", "/**/*")) if path.is_file()]
        if not paths:
            used.append(f"the recipe copies nothing for {pattern}")
        for path in paths:
            to = Path(target) / path.relative_to(Path(folder))
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, to)

    class CMakeToolchain:
        variables = {}

        def __init__(self, _):
            self.cache_variables = self.variables

        def generate(self):
            pass

    class CMake:
        def __init__(self, recipe):
            self.recipe = recipe

        def configure(self):
            options = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in CMakeToolchain.variables.items()]
            done = subprocess.run([cmake, "-S", self.recipe.source_folder, "-B", work / "conan", *options], check=False, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if done.returncode or "Manually-specified variables were not used" in done.stdout:
                used.append(done.stdout[-3000:])

        def build(self):
            pass

        install = build

    class Apt:
        def __init__(self, _):
            pass

        def install(self, packages):
            known = (source / "scripts" / "packages.txt").read_text(encoding="utf-8").split()
            used.extend(f"the recipe wants {package}, which scripts/packages.txt lacks" for package in packages if package not in known)

    contents = {"conan": {"ConanFile": ConanFile}, "conan.tools": {},
                "conan.tools.cmake": {"CMake": CMake, "CMakeToolchain": CMakeToolchain, "cmake_layout": lambda _: None},
                "conan.tools.files": {"copy": copy, "load": lambda _, path: Path(path).read_text(encoding="utf-8")},
                "conan.tools.system": {}, "conan.tools.system.package_manager": {"Apt": Apt}}
    for name, names in contents.items():
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(names)


def conan_faults(cmake, source, work):
    faults = []
    stand_in_conan(cmake, source, work, faults)
    spec = importlib.util.spec_from_file_location("conanfile", source / "packaging" / "conan" / "conanfile.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    recipe = module.GloamConan()
    for step in ("set_version", "export_sources", "layout", "system_requirements", "generate", "build", "package", "package_info"):
        getattr(recipe, step)()
    if f"gloam VERSION {recipe.version} " not in (source / "CMakeLists.txt").read_text(encoding="utf-8"):
        faults.append(f"the recipe takes {recipe.version} for the version")
    return faults


def main(cmake, source, work):
    source, work = Path(source), Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    faults = vcpkg_faults(cmake, source, work) + conan_faults(cmake, source, work)
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main(*sys.argv[1:])
