# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Functions that make this project's targets: one library a layer, one test program a suite; GloamShaders: one shader library a folder.

include(GloamShaders)
add_library(gloam_options INTERFACE)
add_library(gloam::options ALIAS gloam_options)
target_compile_features(gloam_options INTERFACE cxx_std_20)
target_compile_options(gloam_options INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-Wno-missing-field-initializers>
  $<BUILD_INTERFACE:$<$<BOOL:${GLOAM_WARNINGS_AS_ERRORS}>:-Werror>>)
target_compile_definitions(gloam_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE)
# No contraction: a CPU twin and the same code in another translation unit must agree bit for bit.
target_compile_options(gloam_options INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
if(GLOAM_SANITIZE)
  target_compile_options(gloam_options INTERFACE -fsanitize=${GLOAM_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(gloam_options INTERFACE -fsanitize=${GLOAM_SANITIZE})
endif()

# gloam_compile_together(<target> [source…]): several sources of a target a compiler run, which halves the time, for most of it goes
# into the same headers again and again. The sources named here stay alone, as those must that share a file-local name with another one.
function(gloam_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# gloam_add_layer(<name> [APART] SOURCES … [ALONE sources…] [PUBLIC targets…] [PRIVATE targets…])
# Static library gloam_<name>, exported as gloam::<name>. Included by full path from the root. Only sanitized layers are compiled
# together, so that the release build proves that each source includes what it uses; ALONE: not these; APART: none.
function(gloam_add_layer name)
  cmake_parse_arguments(ARG "APART" "" "SOURCES;ALONE;PUBLIC;PRIVATE" ${ARGN})
  add_library(gloam_${name} STATIC ${ARG_SOURCES})
  add_library(gloam::${name} ALIAS gloam_${name})
  set_target_properties(gloam_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gloam_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:include>)
  target_link_libraries(gloam_${name} PUBLIC gloam_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(GLOAM_SANITIZE AND GLOAM_TOGETHER AND NOT ARG_APART)
    gloam_compile_together(gloam_${name} ${ARG_ALONE})
  endif()
  set_property(GLOBAL APPEND PROPERTY GLOAM_LAYERS gloam_${name})
endfunction()

# gloam_add_test(<suite> SOURCES … [ALONE …] [LIBRARIES …] [LABELS …] [WIDTHS 128 256 512])
# GoogleTest program <suite>; one CTest entry, or one a subgroup width (in bits of a lavapipe vector) when WIDTHS are given. Its
# sources are compiled together, without those in ALONE.
function(gloam_add_test suite)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;LIBRARIES;LABELS;WIDTHS;ENVIRONMENT" ${ARGN})
  add_executable(${suite} ${ARG_SOURCES})
  target_link_libraries(${suite} PRIVATE ${ARG_LIBRARIES} gloam_options GTest::gmock GTest::gtest_main)
  target_include_directories(${suite} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
  target_compile_definitions(${suite} PRIVATE GLOAM_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    GLOAM_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared" GLOAM_BINARY_DIR="${PROJECT_BINARY_DIR}")
  list(LENGTH ARG_SOURCES count)
  if(GLOAM_TOGETHER AND count GREATER 1)
    gloam_compile_together(${suite} ${ARG_ALONE})
  endif()
  # Test code is compiled once and run once: optimising it fully takes longer than it saves. Properties run their code very often.
  if(NOT suite MATCHES "_properties$")
    target_compile_options(${suite} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if("sanitize" IN_LIST ARG_LABELS)
    # Builds what the sanitizer presets run, and nothing else.
    if(NOT TARGET gloam_sanitize_tests)
      add_custom_target(gloam_sanitize_tests)
    endif()
    add_dependencies(gloam_sanitize_tests ${suite})
  endif()
  if(NOT ARG_WIDTHS)
    add_test(NAME ${suite} COMMAND ${suite})
    set_tests_properties(${suite} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${GLOAM_TEST_TIMEOUT}
      ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  foreach(bits IN LISTS ARG_WIDTHS)
    math(EXPR lanes "${bits} / 32")
    add_test(NAME ${suite}.width${lanes} COMMAND ${suite})
    set_tests_properties(${suite}.width${lanes} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${GLOAM_TEST_TIMEOUT}
      ENVIRONMENT "${ARG_ENVIRONMENT};LP_NATIVE_VECTOR_WIDTH=${bits}")
  endforeach()
endfunction()

# gloam_add_properties(<suite> …): as gloam_add_test, with RapidCheck linked.
function(gloam_add_properties suite)
  gloam_add_test(${suite} ${ARGN})
  target_link_libraries(${suite} PRIVATE rapidcheck)
endfunction()
