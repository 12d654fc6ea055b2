# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Defines the umbrella target gloam::gloam and, with GLOAM_INSTALL, the package that find_package(gloam) finds. Everything
# is in the install component "gloam", so that `cmake --install <build> --component gloam` needs only the libraries to be
# built.
include(CMakePackageConfigHelpers)

get_property(gloam_layers GLOBAL PROPERTY GLOAM_LAYERS)
list(FILTER gloam_layers EXCLUDE REGEX "^gloam_(sandbox|shaders_sandbox)$")

add_library(gloam_gloam INTERFACE)
add_library(gloam::gloam ALIAS gloam_gloam)
set_target_properties(gloam_gloam PROPERTIES EXPORT_NAME gloam)
target_link_libraries(gloam_gloam INTERFACE ${gloam_layers})
set_target_properties(gloam_options PROPERTIES EXPORT_NAME options)
if(NOT GLOAM_INSTALL)
  return()
endif()

# Pairs: a pattern of target names that layers link, and the package of those targets.
set(gloam_package_patterns
  "^Threads::" Threads "^glm::" glm "^TBB::" TBB "^Vulkan::" Vulkan "^OpenMesh" OpenMesh
  "^(OpenEXR|Imath)::" OpenEXR "^meshoptimizer::" meshoptimizer "^draco::" draco
  "^nlohmann_json::" nlohmann_json "^embree" embree)

# gloam_find_packages(<variable> <target>…): the packages of these targets.
function(gloam_find_packages variable)
  set(packages "")
  set(patterns ${gloam_package_patterns})
  while(patterns)
    list(POP_FRONT patterns pattern package)
    set(matches ${ARGN})
    list(FILTER matches INCLUDE REGEX "${pattern}")
    if(matches)
      list(APPEND packages ${package})
    endif()
  endwhile()
  set(${variable} ${packages} PARENT_SCOPE)
endfunction()

# gloam_find_parts(<variable> <component>): appends the components that this one links, each after those that it links
# itself.
function(gloam_find_parts variable component)
  set(parts ${${variable}})
  get_target_property(links gloam_${component} LINK_LIBRARIES)
  if(component STREQUAL "gloam" OR component STREQUAL "options")
    get_target_property(links gloam_${component} INTERFACE_LINK_LIBRARIES)
  endif()
  list(FILTER links INCLUDE REGEX "^gloam(_|::)")
  list(TRANSFORM links REPLACE "^gloam(_|::)" "")
  foreach(part IN LISTS links)
    if(NOT part IN_LIST parts)
      gloam_find_parts(parts ${part})
      list(APPEND parts ${part})
    endif()
  endforeach()
  set(${variable} ${parts} PARENT_SCOPE)
endfunction()

# Each layer is a component of the package: an export set, so that its target exists only if it is asked for.
set(gloam_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gloam)
set(GLOAM_COMPONENTS ${gloam_layers} gloam_gloam)
list(TRANSFORM GLOAM_COMPONENTS REPLACE "^gloam_" "")
set(GLOAM_COMPONENT_TABLE "")
foreach(component IN LISTS GLOAM_COMPONENTS ITEMS options)
  set(parts "")
  gloam_find_parts(parts ${component})
  get_target_property(links gloam_${component} LINK_LIBRARIES)
  gloam_find_packages(packages ${links})
  list(JOIN parts " " parts)
  list(JOIN packages " " packages)
  string(APPEND GLOAM_COMPONENT_TABLE "set(gloam_stands_on_${component} ${parts})\nset(gloam_packages_${component} ${packages})\n")
  install(TARGETS gloam_${component} EXPORT gloam_${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT gloam)
  install(EXPORT gloam_${component} NAMESPACE gloam:: FILE gloamTargets-${component}.cmake DESTINATION ${gloam_package_dir}
    COMPONENT gloam)
endforeach()
list(JOIN GLOAM_COMPONENTS " " GLOAM_COMPONENTS)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/gloamConfig.cmake.in ${PROJECT_BINARY_DIR}/gloamConfig.cmake
  INSTALL_DESTINATION ${gloam_package_dir} NO_SET_AND_CHECK_MACRO)
# Below 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gloamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gloamConfig.cmake ${PROJECT_BINARY_DIR}/gloamConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/GloamShaders.cmake ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake DESTINATION ${gloam_package_dir} COMPONENT gloam)

include(GloamPkgConfig)

# Headers keep their paths relative to the root, below include/gloam. Targets add that folder to the include path, so
# that `#include "engine/…"` works and nothing else in include/ is shadowed. Of engine/ all headers but internal ones are
# installed, of modules only the public headers and those of CPU rooms: docs/public-headers.md lists them.
set(gloam_include_dir include/gloam)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/internal_headers.txt gloam_internal_headers REGEX "^[^#]")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/internal_headers.txt)
set(gloam_internal_patterns "")
foreach(header IN LISTS gloam_internal_headers)
  string(REGEX REPLACE "/$" "" header ${header})
  list(APPEND gloam_internal_patterns PATTERN ${header} EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine DESTINATION ${gloam_include_dir} COMPONENT gloam
  FILES_MATCHING PATTERN "*.h" ${gloam_internal_patterns})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/modules DESTINATION ${gloam_include_dir} COMPONENT gloam
  FILES_MATCHING REGEX "/modules/[a-z_]+/(components|module|outputs|gloam|light_names|module_list|bake|baked_light|captures)\\.h$"
  REGEX "/modules/(lights/(bins|masks|selection)|closeups/umbra|reflections/culling|grass/growth)/[a-z_]+\\.h$")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders DESTINATION ${gloam_include_dir} COMPONENT gloam
  FILES_MATCHING REGEX "_(shared\\.h|api\\.glsl)$|/shaders/common/[a-z_]+\\.(h|glsl)$" PATTERN "sandbox" EXCLUDE)
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/shaders DESTINATION ${gloam_include_dir} COMPONENT gloam
  FILES_MATCHING PATTERN "shaders.h" PATTERN "*_test" EXCLUDE PATTERN "every" EXCLUDE PATTERN "sandbox" EXCLUDE)
# Shaders that installed *_api.glsl include.
install(FILES ${PROJECT_SOURCE_DIR}/shaders/lighting/arriving_light.glsl
  DESTINATION ${gloam_include_dir}/shaders/lighting COMPONENT gloam)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/shadows/filter DESTINATION ${gloam_include_dir}/shaders/shadows
  COMPONENT gloam FILES_MATCHING PATTERN "*.glsl")
# Programs that use the package; tests/embedding builds and runs them as they are installed.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tests/embedding/host/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gloam/examples
  COMPONENT gloam)
