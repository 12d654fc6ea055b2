# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Installs the program (component "program") and sets up cpack: scripts/package.sh makes an archive of everything, and one
# Debian package each of the program and of the library.
install(TARGETS gloam_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/scripts/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME gloam COMPONENT program)
# scripts/package.sh writes these.
install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
install(FILES ${PROJECT_BINARY_DIR}/gloam.spdx.json DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program OPTIONAL)
foreach(component IN ITEMS program gloam)
  set(folder ${CMAKE_INSTALL_DOCDIR})
  if(component STREQUAL "gloam")
    set(folder ${CMAKE_INSTALL_DATADIR}/doc/libgloam-dev)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${folder} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${folder} COMPONENT ${component})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/third_party_notes DESTINATION ${folder} COMPONENT ${component})
endforeach()

set(CPACK_PACKAGE_NAME gloam)
set(CPACK_PACKAGE_VENDOR "The gloam authors")
set(CPACK_PACKAGE_CONTACT "The gloam authors <gloam@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "many lights, soft shadows, wet reflections and grass in real time")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_FILE_NAME gloam-${PROJECT_VERSION}-debian12-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/out)
set(CPACK_GENERATOR TZST DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program gloam)
set(CPACK_THREADS 0)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gloam)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The loader is opened at run time, and without a driver there is no device.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "glslang-tools, spirv-tools, vulkan-validationlayers")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program gloam: it shows scenes by night in a window, draws pictures, measures what each effect costs\n in time and in error, and tests a device.")
set(CPACK_DEBIAN_GLOAM_PACKAGE_NAME libgloam-dev)
set(CPACK_DEBIAN_GLOAM_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_GLOAM_PACKAGE_DEPENDS "libglm-dev, libvulkan-dev, libtbb-dev, libembree-dev, libopenmesh-dev, libmeshoptimizer-dev, libdraco-dev, libwebp-dev, libdeflate-dev, nlohmann-json3-dev, libxxhash-dev")
set(CPACK_DEBIAN_GLOAM_PACKAGE_SUGGESTS "glslang-tools, spirv-tools, cmake")
set(CPACK_COMPONENT_GLOAM_DESCRIPTION "Static libraries, headers, shaders and examples of gloam for engines: many lights with soft shadows, wet\n reflections, grass and lit particles as modules on a Vulkan frame graph.")
include(CPack)
