# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Functions that define this project's targets: one library per layer, one test program per suite. GloamShaders defines
# one shader library per folder.

include(GloamShaders)
add_library(gloam_options INTERFACE)
add_library(gloam::options ALIAS gloam_options)
target_compile_features(gloam_options INTERFACE cxx_std_20)
# The library holds paths from the root of the sources: those of assertions, and of debug information.
target_compile_options(gloam_options INTERFACE
  $<BUILD_INTERFACE:-ffile-prefix-map=${PROJECT_BINARY_DIR}/=> $<BUILD_INTERFACE:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>)
# No contraction to fused multiply-add: a CPU clone of a shader and the same code in another translation unit must agree
# bit for bit.
target_compile_options(gloam_options INTERFACE $<BUILD_INTERFACE:-ffp-contract=off>)
# GCC collects the garbage of its own memory from 128 MiB on; a group of sources needs more, and collecting takes 5 % of its time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(gloam_options INTERFACE $<BUILD_INTERFACE:--param=ggc-min-heapsize=2000000>)
endif()
if(GLOAM_SANITIZE)  # without warnings, which the other builds give
  target_compile_options(gloam_options INTERFACE -fsanitize=${GLOAM_SANITIZE} -fno-omit-frame-pointer)
  if(GLOAM_SANITIZE_WITHOUT)
    target_compile_options(gloam_options INTERFACE -fno-sanitize=${GLOAM_SANITIZE_WITHOUT})
  endif()
  target_link_options(gloam_options INTERFACE -fsanitize=${GLOAM_SANITIZE})
else()
  target_compile_options(gloam_options INTERFACE
    $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-Wno-missing-field-initializers>
    $<BUILD_INTERFACE:$<$<BOOL:${GLOAM_WARNINGS_AS_ERRORS}>:-Werror>>)
  # A section for each function and object, so that a host that links with -Wl,--gc-sections drops what it does not use.
  target_compile_options(gloam_options INTERFACE $<BUILD_INTERFACE:-ffunction-sections;-fdata-sections>)
endif()

# gloam_list_folders(<variable>): the names of the folders directly below the current source folder. An added or removed
# folder configures the project again.
function(gloam_list_folders variable)
  file(GLOB names RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*)
  set(folders "")
  foreach(name IN LISTS names)
    if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${name})
      list(APPEND folders ${name})
    endif()
  endforeach()
  set(${variable} ${folders} PARENT_SCOPE)
endfunction()

# gloam_compile_together(<target> [source…])
# Compiles several sources of a target in one compiler run: most of a source's time goes into headers that the others
# share. Sources that are neighbours in the target's list form a group of at most GLOAM_TOGETHER_COUNT. Compiled alone are
# the sources named here (they share a file-local name with another one) and those in GLOAM_SOURCES_ALONE; the groups of
# the other sources stay as they are.
function(gloam_compile_together target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(REMOVE_ITEM sources ${ARGN} "")
  list(LENGTH sources count)
  math(EXPR groups "(${count} + ${GLOAM_TOGETHER_COUNT} - 1) / ${GLOAM_TOGETHER_COUNT}")
  set(at 0)
  foreach(source IN LISTS sources)
    math(EXPR group "${at} * ${groups} / ${count}")
    math(EXPR at "${at} + 1")
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    if(NOT path IN_LIST GLOAM_SOURCES_ALONE)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${target}_${group})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# gloam_add_layer(<name> SOURCES … [ALONE sources…] [PUBLIC targets…] [PRIVATE targets…])
# Static library gloam_<name>, exported as gloam::<name>. Its headers are included by full path from the root. ALONE:
# sources that are compiled alone, because they share a file-local name with another one or need a library that the
# others do not.
function(gloam_add_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;PUBLIC;PRIVATE" ${ARGN})
  add_library(gloam_${name} STATIC ${ARG_SOURCES})
  add_library(gloam::${name} ALIAS gloam_${name})
  set_target_properties(gloam_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(gloam_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:include/gloam>)
  target_link_libraries(gloam_${name} PUBLIC gloam_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(GLOAM_TOGETHER)
    gloam_compile_together(gloam_${name} ${ARG_ALONE})
  endif()
  set_property(GLOBAL APPEND PROPERTY GLOAM_LAYERS gloam_${name})
endfunction()

# Settings of all test targets. Test code is compiled once and run once, so optimisation would take longer than it saves:
# -Og compiles in four fifths of the time of -O1. Suites of kernels search maps and lists by brute force and get -O1;
# property tests are fully optimised, because they run their code very often.
function(gloam_set_up_test_code target)
  target_link_libraries(${target} PRIVATE ${ARGN} gloam_options GTest::gmock)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
  target_compile_definitions(${target} PRIVATE GLOAM_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    GLOAM_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared" GLOAM_BINARY_DIR="${PROJECT_BINARY_DIR}")
  if(target MATCHES "_kernels$|_kernel_tests$|^gloam_test_shadow_maps$")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  elseif(NOT target MATCHES "_properties$")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
  endif()
endfunction()

# gloam_add_test_support(<name> SOURCES … [LIBRARIES …]): a library that several test programs link, compiled once.
function(gloam_add_test_support name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  gloam_set_up_test_code(${name} ${ARG_LIBRARIES})
endfunction()

# gloam_add_test_program(<program> SOURCES … [ALONE …] [LIBRARIES …]): a GoogleTest program without CTest entries. Its
# sources are compiled together, except those in ALONE.
function(gloam_add_test_program program)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;LIBRARIES" ${ARGN})
  add_executable(${program} ${ARG_SOURCES})
  gloam_set_up_test_code(${program} ${ARG_LIBRARIES})
  target_link_libraries(${program} PRIVATE GTest::gtest_main)
  list(LENGTH ARG_SOURCES count)
  if(GLOAM_TOGETHER AND count GREATER 1)
    gloam_compile_together(${program} ${ARG_ALONE})
  endif()
endfunction()

# The Vulkan driver of entries labelled second_device: SwiftShader, which Debian's package chromium brings.
set(GLOAM_SECOND_DRIVER "/usr/lib/chromium/vk_swiftshader_icd.json" CACHE FILEPATH "Driver file of SwiftShader")

# Seconds of processor time of the longest entries, in round numbers. CTest starts these first, the longest before the
# others, so that no core is idle at the end while one of them still runs. A clean clone has no times of former runs.
# program.shader_cache copies the driver's cache and keeps its own shaders apart, so it follows those that fill the cache.
set(GLOAM_ENTRY_COSTS
  shadows_kernels_tests.width8=70 final_lists_on_gpu_tests.width8=85 program.play_tour=50
  shadow_maps_on_gpu_tests.width8=80 depth_of_field_kernel_tests.width8=50 shadows_hard_tests.width8=60
  deferred_shadows_tests.width8=50 embedding=50 depth_of_field_kernel_tests.second_device=40 closeups_on_gpu_tests.width8=40
  program.legal_numbers=40 soak=20 program.hard_scenes=20 golden_tests=25 embedding_clang=40 grass_gpu_tests.width8=30 program.cost=30
  reflections_kernel_tests.width8=15 list_flight_tests=20 lighting_gpu_tests.width8=20
  light_flight_tests=15 program.render=15 program.shader_cache=10)

# gloam_start_early(<entry>): sets the cost of an entry in the list above.
function(gloam_start_early entry)
  set(cost ${GLOAM_ENTRY_COSTS})
  string(REPLACE "." "\\." pattern ${entry})
  list(FILTER cost INCLUDE REGEX "^${pattern}=")
  if(cost)
    string(REGEX REPLACE "^.*=" "" cost ${cost})
    set_tests_properties(${entry} PROPERTIES COST ${cost})
  endif()
endfunction()

# gloam_add_second_device_entry(<name> COMMAND program [arguments…])
# Adds a CTest entry whose tests run on SwiftShader, beside the other drivers of the machine. It is skipped if the driver
# is absent.
function(gloam_add_second_device_entry name)
  cmake_parse_arguments(ARG "" "" "COMMAND" ${ARGN})
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES LABELS "gpu;second_device" TIMEOUT ${GLOAM_TEST_TIMEOUT}
    FAIL_REGULAR_EXPRESSION "Running 0 tests" SKIP_REGULAR_EXPRESSION "there is no usable Vulkan device"
    ENVIRONMENT "VK_ADD_DRIVER_FILES=${GLOAM_SECOND_DRIVER};GLOAM_TEST_DEVICE=swiftshader;MESA_SHADER_CACHE_DIR=${PROJECT_BINARY_DIR}/shader_cache")
  gloam_start_early(${name})
endfunction()

# gloam_add_entries(<suite> COMMAND program [arguments…] [LABELS …] [WIDTHS …] [ENVIRONMENT …])
# Adds one CTest entry, or one per subgroup width if WIDTHS are given (in bits of a lavapipe vector). If there are other
# widths, the entry of width 8 has the label width8, and the preset `release` leaves it out: suites that draw run the same
# kernels at width 8, and widths 4 and 16 are the extremes.
function(gloam_add_entries suite)
  cmake_parse_arguments(ARG "" "" "COMMAND;LABELS;WIDTHS;ENVIRONMENT" ${ARGN})
  set(entries "")
  list(APPEND ARG_ENVIRONMENT "MESA_SHADER_CACHE_DIR=${PROJECT_BINARY_DIR}/shader_cache")  # shared by all entries
  if(NOT ARG_WIDTHS)
    list(APPEND entries ${suite})
    add_test(NAME ${suite} COMMAND ${ARG_COMMAND})
    set_tests_properties(${suite} PROPERTIES ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  foreach(bits IN LISTS ARG_WIDTHS)
    math(EXPR lanes "${bits} / 32")
    list(APPEND entries ${suite}.width${lanes})
    add_test(NAME ${suite}.width${lanes} COMMAND ${ARG_COMMAND})
    set_tests_properties(${suite}.width${lanes} PROPERTIES ENVIRONMENT "${ARG_ENVIRONMENT};LP_NATIVE_VECTOR_WIDTH=${bits}")
  endforeach()
  # Without this, a filter that matches no test would pass.
  set_tests_properties(${entries} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${GLOAM_TEST_TIMEOUT}
    FAIL_REGULAR_EXPRESSION "Running 0 tests")
  foreach(entry IN LISTS entries)
    gloam_start_early(${entry})
  endforeach()
  list(LENGTH ARG_WIDTHS count)
  if(count GREATER 1 AND 256 IN_LIST ARG_WIDTHS)
    set_property(TEST ${suite}.width8 APPEND PROPERTY LABELS width8)
  endif()
endfunction()

# gloam_one_width(<suite>): no kernel of the suite works on subgroups, so CTest's preset `release` runs it at one width: 8,
# whose pipelines suites that draw share. Widths 4 and 16, which compile every pipeline again, are labelled long.
function(gloam_one_width suite)
  get_test_property(${suite}.width8 LABELS labels)
  list(REMOVE_ITEM labels width8)
  set_tests_properties(${suite}.width8 PROPERTIES LABELS "${labels}")
  set_property(TEST ${suite}.width4 ${suite}.width16 APPEND PROPERTY LABELS long)
endfunction()

# gloam_add_test(<suite> SOURCES … [ALONE …] [LIBRARIES …] [LABELS …] [WIDTHS 128 256 512])
# A GoogleTest program <suite> with its CTest entries: see gloam_add_test_program and gloam_add_entries.
function(gloam_add_test suite)
  cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;LIBRARIES;LABELS;WIDTHS;ENVIRONMENT" ${ARGN})
  gloam_add_test_program(${suite} SOURCES ${ARG_SOURCES} ALONE ${ARG_ALONE} LIBRARIES ${ARG_LIBRARIES})
  if("sanitize" IN_LIST ARG_LABELS)
    # This target builds only the programs that the sanitizer presets run.
    if(NOT TARGET gloam_sanitize_tests)
      add_custom_target(gloam_sanitize_tests)
    endif()
    add_dependencies(gloam_sanitize_tests ${suite})
  endif()
  if("threads" IN_LIST ARG_LABELS)
    # The same for ThreadSanitizer.
    if(NOT TARGET gloam_threads_tests)
      add_custom_target(gloam_threads_tests)
    endif()
    add_dependencies(gloam_threads_tests ${suite})
  endif()
  gloam_add_entries(${suite} COMMAND ${suite} LABELS ${ARG_LABELS} WIDTHS ${ARG_WIDTHS} ENVIRONMENT ${ARG_ENVIRONMENT})
endfunction()

# gloam_find_tests(<filter> <program> <source>…)
# Sets <filter> to the GoogleTest filter of the tests in these sources. No other source of the program may have suites
# of the same names.
function(gloam_find_tests filter program)
  set(patterns "")
  foreach(source IN LISTS ARGN)
    set(path ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    file(STRINGS ${path} lines REGEX "^(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\\(")
    set(found "")
    foreach(line IN LISTS lines)
      if(NOT line MATCHES "^([A-Z_]+)\\( *([A-Za-z0-9_]+) *,")
        message(FATAL_ERROR "${path}: the name of the suite must be on the line of its macro: ${line}")
      endif()
      set(pattern_TEST "${CMAKE_MATCH_2}.*")
      set(pattern_TEST_F "${CMAKE_MATCH_2}.*")
      set(pattern_TEST_P "*/${CMAKE_MATCH_2}.*")
      set(pattern_TYPED_TEST "${CMAKE_MATCH_2}/*")
      set(pattern_TYPED_TEST_P "*/${CMAKE_MATCH_2}/*")
      list(APPEND found ${CMAKE_MATCH_2})
      list(APPEND patterns ${pattern_${CMAKE_MATCH_1}})
    endforeach()
    if(NOT found)
      message(FATAL_ERROR "${path}: no test found")
    endif()
    list(REMOVE_DUPLICATES found)
    foreach(suite IN LISTS found)
      get_property(other TARGET ${program} PROPERTY GLOAM_SOURCE_OF_${suite})
      if(other)
        message(FATAL_ERROR "${other} and ${source} both have a suite ${suite}, but are one program (${program}): rename one of them")
      endif()
      set_property(TARGET ${program} PROPERTY GLOAM_SOURCE_OF_${suite} ${source})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES patterns)
  list(JOIN patterns ":" patterns)
  set(${filter} ${patterns} PARENT_SCOPE)
endfunction()

# gloam_add_suites(<program> KIND <kind> SUITES … [ALONE …] [LIBRARIES …] [LABELS …] [WIDTHS 128 256 512])
# Several suites in one GoogleTest program, which costs much less than one program per suite. The CTest entries are the
# same: <suite>_tests runs the tests of <suite>_<kind>_test.cpp, and `suite=a,b` runs those of a_<kind>_test.cpp and
# b_<kind>_test.cpp.
function(gloam_add_suites program)
  cmake_parse_arguments(ARG "" "KIND" "SUITES;ALONE;LIBRARIES;LABELS;WIDTHS" ${ARGN})
  set(sources "")
  foreach(suite IN LISTS ARG_SUITES)
    string(REGEX REPLACE "^.*=" "" names ${suite})
    string(REGEX REPLACE "=.*$" "" suite ${suite})
    string(REPLACE "," ";" names ${names})
    list(TRANSFORM names APPEND _${ARG_KIND}_test.cpp)
    set(sources_${suite} ${names})
    list(APPEND sources ${names})
  endforeach()
  gloam_add_test_program(${program} SOURCES ${sources} ALONE ${ARG_ALONE} LIBRARIES ${ARG_LIBRARIES})
  foreach(suite IN LISTS ARG_SUITES)
    string(REGEX REPLACE "=.*$" "" suite ${suite})
    gloam_find_tests(filter ${program} ${sources_${suite}})
    gloam_add_entries(${suite}_tests COMMAND ${program} --gtest_filter=${filter} LABELS ${ARG_LABELS} WIDTHS ${ARG_WIDTHS})
  endforeach()
endfunction()

# gloam_add_properties(<suite> …): as gloam_add_test, with RapidCheck linked.
function(gloam_add_properties suite)
  if(NOT TARGET rapidcheck)  # builds with GLOAM_CPU_ONLY, where the system may have none
    return()
  endif()
  gloam_add_test(${suite} ${ARGN})
  target_link_libraries(${suite} PRIVATE rapidcheck)
endfunction()
