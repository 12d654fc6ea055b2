# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Finds every package that this project uses. All are packages of the distribution.
find_package(Threads REQUIRED)
if(GLOAM_CPU_ONLY)
  # Headers alone, and oneTBB if it is there for this system.
  find_path(GLOAM_GLM_HEADERS glm/glm.hpp REQUIRED)
  find_path(GLOAM_XXHASH_HEADERS xxhash.h REQUIRED)
  find_package(TBB QUIET)
  if(NOT TARGET glm::glm)
    add_library(glm::glm INTERFACE IMPORTED GLOBAL)
    target_include_directories(glm::glm INTERFACE ${GLOAM_GLM_HEADERS})
  endif()
  # The layers gpu and frame need no more of Vulkan and SPIR-V than headers: they load Vulkan when they run.
  find_path(GLOAM_VULKAN_HEADERS vulkan/vulkan.h)
  find_path(GLOAM_SPIRV_HEADERS spirv/unified1/spirv.hpp)
  set(GLOAM_VULKAN_LAYERS OFF)
  if(GLOAM_VULKAN_HEADERS AND GLOAM_SPIRV_HEADERS)
    set(GLOAM_VULKAN_LAYERS ON)
    add_library(Vulkan::Headers INTERFACE IMPORTED GLOBAL)
    target_include_directories(Vulkan::Headers INTERFACE ${GLOAM_VULKAN_HEADERS})
    add_library(SPIRV-Headers::SPIRV-Headers INTERFACE IMPORTED GLOBAL)
    target_include_directories(SPIRV-Headers::SPIRV-Headers INTERFACE ${GLOAM_SPIRV_HEADERS})
  endif()
  if(GLOAM_TESTS)
    find_package(GTest QUIET)
    if(NOT TARGET GTest::gmock)  # Debian has the sources
      set(BUILD_SHARED_LIBS OFF)
      add_subdirectory(/usr/src/googletest ${CMAKE_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
    endif()
  endif()
  return()
endif()
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(Vulkan REQUIRED)
find_package(SPIRV-Headers REQUIRED)  # a header of numbers
find_package(OpenMesh REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(embree 3 REQUIRED)
find_library(GLOAM_LIBDEFLATE deflate REQUIRED)  # has no CMake package: targets link it by name
find_library(GLOAM_LIBWEBP webp REQUIRED)  # the same
find_path(GLOAM_TINYGLTF_HEADERS tiny_gltf.h REQUIRED)  # engine/scene compiles it
find_path(GLOAM_XXHASH_HEADERS xxhash.h REQUIRED)  # header only, has no CMake package
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
if(GLOAM_SANDBOX)
  find_package(glfw3 REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(spdlog REQUIRED)
  find_package(benchmark REQUIRED)
  find_package(ZLIB REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)  # has no CMake package
endif()
if(GLOAM_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
endif()
