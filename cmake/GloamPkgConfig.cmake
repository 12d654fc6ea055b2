# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Installs a file for pkg-config for each component: gloam.pc for the whole library, gloam-<component>.pc for a part. The
# libraries are static, so what they link is in Requires and Libs: a host needs no --static.

# Triples: a pattern of what layers link, the pkg-config module that has it, and flags; none: there is none. Header-only libraries that no
# installed header includes are left out, and Vulkan's loader: gloam does not link it.
set(gloam_pkg_config_links
  "^glm::" glm none "^TBB::" tbb none "^Threads::" none -pthread "^OpenMesh" openmesh none "^draco::" draco none
  "^meshoptimizer::" none -lmeshoptimizer "^embree$" none -lembree3 "^deflate$" libdeflate none "^webp$" libwebp none
  "^dl$" none -ldl)

# gloam_pkg_config_name(<variable> <component>)
function(gloam_pkg_config_name variable component)
  set(name gloam-${component})
  if(component STREQUAL "gloam")
    set(name gloam)
  endif()
  set(${variable} ${name} PARENT_SCOPE)
endfunction()

set(gloam_pkg_config_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH gloam_prefix_from_pc /${gloam_pkg_config_dir} /)
string(REGEX REPLACE "/$" "" gloam_prefix_from_pc ${gloam_prefix_from_pc})
set(gloam_pc_components ${gloam_layers} gloam_gloam)
list(TRANSFORM gloam_pc_components REPLACE "^gloam_" "")
foreach(component IN LISTS gloam_pc_components)
  set(property LINK_LIBRARIES)
  set(libs -L\${libdir} -lgloam_${component})
  if(component STREQUAL "gloam")
    set(property INTERFACE_LINK_LIBRARIES)
    set(libs "")
  endif()
  get_target_property(links gloam_${component} ${property})
  set(requires "")
  set(flags_of_component "")
  foreach(link IN LISTS links)
    if(link MATCHES "^gloam(_|::)options$")
      continue()
    elseif(link MATCHES "^gloam(_|::)(.*)$")
      gloam_pkg_config_name(name ${CMAKE_MATCH_2})
      list(APPEND requires ${name})
      continue()
    endif()
    set(rest ${gloam_pkg_config_links})
    while(rest)
      list(POP_FRONT rest pattern module flags)
      if(link MATCHES "${pattern}")
        list(APPEND requires ${module})
        list(APPEND flags_of_component ${flags})
      endif()
    endwhile()
  endforeach()
  list(REMOVE_ITEM requires none)
  list(REMOVE_ITEM flags_of_component none)
  list(REMOVE_DUPLICATES requires)
  list(JOIN requires ", " requires)
  list(PREPEND flags_of_component ${libs})
  list(JOIN flags_of_component " " libs)
  gloam_pkg_config_name(name ${component})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc @ONLY CONTENT
"prefix=\${pcfiledir}/@gloam_prefix_from_pc@
libdir=\${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=\${prefix}/include/gloam

Name: @name@
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags: -I\${includedir}
Libs: @libs@
")
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc DESTINATION ${gloam_pkg_config_dir} COMPONENT gloam)
endforeach()
