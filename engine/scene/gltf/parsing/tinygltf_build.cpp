// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// The functions of tinygltf, in the namespace that CMakeLists.txt gives it.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
