# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
# Toolchain: Windows on x86-64, by Debian's g++-mingw-w64-x86-64-posix. Tests run under Debian's wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
# Programs bring the compiler's libraries with them.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
# Debian's headers that hold for every system. /usr/include as a whole is the C library of this one.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
foreach(name glm xxhash.h vulkan vk_video spirv)
  file(CREATE_LINK /usr/include/${name} ${CMAKE_BINARY_DIR}/headers/${name} SYMBOLIC)
endforeach()
list(APPEND CMAKE_PREFIX_PATH ${CMAKE_BINARY_DIR}/headers)
set(GLOAM_GLM_HEADERS ${CMAKE_BINARY_DIR}/headers CACHE PATH "")
set(GLOAM_XXHASH_HEADERS ${CMAKE_BINARY_DIR}/headers CACHE PATH "")
set(GLOAM_VULKAN_HEADERS ${CMAKE_BINARY_DIR}/headers CACHE PATH "")
set(GLOAM_SPIRV_HEADERS ${CMAKE_BINARY_DIR}/headers CACHE PATH "")
