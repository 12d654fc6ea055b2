# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Defines gloam_add_shaders, for this project and for modules that are built against the installed package.

# Include root of gloam's own shaders; gloamConfig.cmake sets it to the installed headers.
if(NOT DEFINED GLOAM_SHADER_ROOT)
  set(GLOAM_SHADER_ROOT ${PROJECT_SOURCE_DIR})
endif()
set_property(GLOBAL PROPERTY GLOAM_SHADER_ROOT "${GLOAM_SHADER_ROOT}")

set(GLOAM_SHADER_TOOLS "${CMAKE_CURRENT_LIST_DIR}" CACHE INTERNAL "folder of EmbedSpirv.cmake")
# Passes of spirv-opt that inline functions and turn variables into values, so that drivers make pipelines faster even
# when their cache is warm (docs/experiments.md). No pass changes arithmetic or moves code between branches.
set(GLOAM_SPIRV_PASSES --skip-validation --preserve-bindings --preserve-spec-constants --inline-entry-points-exhaustive
  --eliminate-dead-functions --eliminate-dead-code-aggressive --private-to-local --scalar-replacement=100
  --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --ssa-rewrite --eliminate-dead-code-aggressive
  CACHE INTERNAL "passes of spirv-opt")

# A build of the same sources whose compiled shaders are copied in place of compiling them again. That build must be up to
# date, and not of type Debug, whose shaders keep more names. Compiling takes 144 s of processor time.
set(GLOAM_SHADERS_FROM "" CACHE PATH "Build folder whose compiled shaders are copied")

# gloam_add_shaders(<folder> [FOR_TESTS] [<file.comp.glsl>…])
# Compiles shaders/<folder>/<file> to SPIR-V and embeds it in the library gloam_shaders_<folder>. Without files: all
# *.comp.glsl, *.vert.glsl and *.frag.glsl below shaders/<folder>. FOR_TESTS: the files are below
# tests/shaders/<folder>, and the library is no part of the package. The header shaders/<folder>/shaders.h in the build
# tree declares each shader as gloam::shaders::<folder>::<symbol>: the file name without .glsl and with _ for ., so
# blur.frag.glsl is blur_frag; every_shader lists them. The SPIR-V keeps names of bindings, specialisation constants and
# structures, by which reflection finds them; in Debug builds all names. Shaders include files by full path from the
# root of their project or of gloam.
function(gloam_add_shaders folder)
  if(NOT GLSLANG_VALIDATOR)
    find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
  endif()
  if(NOT SPIRV_OPT)
    find_program(SPIRV_OPT spirv-opt REQUIRED)
  endif()
  cmake_parse_arguments(ARG "FOR_TESTS" "" "" ${ARGN})
  set(source_dir ${PROJECT_SOURCE_DIR}/shaders/${folder})
  if(ARG_FOR_TESTS)
    set(source_dir ${PROJECT_SOURCE_DIR}/tests/shaders/${folder})
  endif()
  set(sources ${ARG_UNPARSED_ARGUMENTS})
  if(NOT sources)
    file(GLOB_RECURSE sources RELATIVE ${source_dir} CONFIGURE_DEPENDS
      ${source_dir}/*.comp.glsl ${source_dir}/*.vert.glsl ${source_dir}/*.frag.glsl)
  endif()
  if(NOT sources)
    message(FATAL_ERROR "${source_dir} has no *.comp.glsl, *.vert.glsl or *.frag.glsl")
  endif()
  get_property(root GLOBAL PROPERTY GLOAM_SHADER_ROOT)
  set(out_dir ${PROJECT_BINARY_DIR}/generated/shaders/${folder})
  file(MAKE_DIRECTORY ${out_dir})
  set(declarations "")
  set(definitions "")
  set(includes "")
  set(addresses "")
  set(outputs "")
  foreach(source IN LISTS sources)
    string(REGEX REPLACE "\\.glsl$" "" stem ${source})
    get_filename_component(base ${stem} NAME)
    string(REPLACE "." "_" symbol ${base})
    string(REGEX REPLACE ".*\\.(comp|vert|frag)$" "\\1" stage ${stem})
    set(output ${out_dir}/${stem}.spv.h)
    get_filename_component(output_dir ${output} DIRECTORY)
    file(MAKE_DIRECTORY ${output_dir})
    if(GLOAM_SHADERS_FROM)
      set(compiled ${GLOAM_SHADERS_FROM}/generated/shaders/${folder}/${stem}.spv.h)
      add_custom_command(OUTPUT ${output} COMMAND ${CMAKE_COMMAND} -E copy ${compiled} ${output} DEPENDS ${compiled} VERBATIM)
    else()
      # The first command writes SPIR-V to the header's place, because the dependency file names that as its target.
      add_custom_command(OUTPUT ${output}
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.3 -S ${stage} -I${PROJECT_SOURCE_DIR} -I${root}
          --depfile ${output}.d -o ${output} ${source_dir}/${source}
        COMMAND ${SPIRV_OPT} ${GLOAM_SPIRV_PASSES} ${output} -o ${output}.spv
        COMMAND ${CMAKE_COMMAND} -DINPUT=${output}.spv -DOUTPUT=${output} -DNAME=${symbol}_words
          -DALL_NAMES=$<CONFIG:Debug> -P ${GLOAM_SHADER_TOOLS}/EmbedSpirv.cmake
        DEPENDS ${source_dir}/${source} ${GLOAM_SHADER_TOOLS}/EmbedSpirv.cmake
        DEPFILE ${output}.d
        COMMENT "Shader ${folder}/${source}" VERBATIM)
    endif()
    list(APPEND outputs ${output})
    string(APPEND declarations "extern const gpu::ShaderCode ${symbol};\n")
    string(APPEND includes "#include \"shaders/${folder}/${stem}.spv.h\"\n")
    string(APPEND definitions "const gpu::ShaderCode ${symbol}{\"${folder}/${stem}\", words_of(${symbol}_words)};\n")
    string(APPEND addresses "&${symbol}, ")
  endforeach()
  file(CONFIGURE OUTPUT ${out_dir}/shaders.h CONTENT
"#pragma once
#include \"engine/gpu/types.h\"
namespace gloam::shaders::${folder} {
${declarations}extern const std::span<const gpu::ShaderCode* const> every_shader;
}
")
  file(CONFIGURE OUTPUT ${out_dir}/shaders.cpp CONTENT
"#include \"shaders/${folder}/shaders.h\"
#include <cstddef>
#include <cstdint>
namespace {
${includes}
// char32_t has the size, alignment and values of a 32-bit word. Nothing ever writes these words.
template <std::size_t count>
std::span<const std::uint32_t> words_of(const char32_t (&literal)[count]) {
  static_assert(sizeof(char32_t) == sizeof(std::uint32_t) && alignof(char32_t) == alignof(std::uint32_t));
  return {reinterpret_cast<const std::uint32_t*>(literal), count - 1};
}
}
namespace gloam::shaders::${folder} {
${definitions}constexpr const gpu::ShaderCode* kEveryShader[] = {${addresses}};
const std::span<const gpu::ShaderCode* const> every_shader = kEveryShader;
}
")
  add_custom_target(gloam_shaders_${folder}_words DEPENDS ${outputs})
  add_library(gloam_shaders_${folder} STATIC ${out_dir}/shaders.cpp ${outputs})
  add_library(gloam::shaders_${folder} ALIAS gloam_shaders_${folder})
  set_target_properties(gloam_shaders_${folder} PROPERTIES EXPORT_NAME shaders_${folder} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gloam_shaders_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated> $<BUILD_INTERFACE:${root}>
    $<INSTALL_INTERFACE:include/gloam>)
  target_link_libraries(gloam_shaders_${folder} PUBLIC gloam::options)
  if(NOT ARG_FOR_TESTS)
    set_property(GLOBAL APPEND PROPERTY GLOAM_SHADER_FOLDERS ${folder})
    set_property(GLOBAL APPEND PROPERTY GLOAM_LAYERS gloam_shaders_${folder})
  endif()
endfunction()

# Defines the library gloam_every_shader. Its header shaders/every/shaders.h in the build tree declares
# gloam::every_shader(), which returns all shaders that were embedded so far, without those of
# tests.
function(gloam_list_shaders)
  get_property(folders GLOBAL PROPERTY GLOAM_SHADER_FOLDERS)
  set(includes "")
  set(appends "")
  foreach(folder IN LISTS folders)
    string(APPEND includes "#include \"shaders/${folder}/shaders.h\"\n")
    string(APPEND appends "  all.insert(all.end(), shaders::${folder}::every_shader.begin(), shaders::${folder}::every_shader.end());\n")
  endforeach()
  list(TRANSFORM folders PREPEND gloam::shaders_ OUTPUT_VARIABLE libraries)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/shaders/every/shaders.h CONTENT
"#pragma once
#include <vector>
#include \"engine/gpu/types.h\"
${includes}
namespace gloam {
[[nodiscard]] inline std::vector<const gpu::ShaderCode*> every_shader() {
  std::vector<const gpu::ShaderCode*> all;
${appends}  return all;
}
}
")
  add_library(gloam_every_shader INTERFACE)
  target_link_libraries(gloam_every_shader INTERFACE ${libraries})
endfunction()
