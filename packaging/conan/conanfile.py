# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""A Conan 2 recipe for the tree that it lies in: conan create packaging/conan

The libraries that gloam links are the distribution's packages, as in a build without Conan."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load
from conan.tools.system.package_manager import Apt

ROOT = os.path.join("..", "..")
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake/*", "engine/*", "modules/*", "shaders/*", "docs/*", "tests/embedding/host/*")


class GloamConan(ConanFile):
    name = "gloam"
    license = "MIT"
    description = "An engine module for what happens at dusk: lights, shadows, reflections, grass and fog on Vulkan 1.3"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"

    def set_version(self):
        lists = load(self, os.path.join(self.recipe_folder, ROOT, "CMakeLists.txt"))
        self.version = re.search(r"project\(gloam VERSION ([0-9.]+)", lists).group(1)

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, os.path.join(self.recipe_folder, ROOT), self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def system_requirements(self):
        Apt(self).install([
            "glslang-tools", "spirv-tools", "spirv-headers", "libglm-dev", "libvulkan-dev", "libtinygltf-dev", "libstb-dev",
            "libopenmesh-dev", "libtbb-dev", "libembree-dev", "nlohmann-json3-dev", "libopenexr-dev", "libdeflate-dev",
            "libmeshoptimizer-dev", "libdraco-dev", "libwebp-dev", "libxxhash-dev"])

    def generate(self):
        toolchain = CMakeToolchain(self)
        for option, value in (("SANDBOX", False), ("TESTS", False), ("INSTALL", True), ("WARNINGS_AS_ERRORS", False)):
            toolchain.cache_variables[f"GLOAM_{option}"] = value
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        # Hosts use gloam's own CMake package, with its components.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "gloam")]
        self.cpp_info.includedirs = [os.path.join("include", "gloam")]
