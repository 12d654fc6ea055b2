// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// The functions of tinygltf.
#include "engine/scene/gltf/parsing/tinygltf_names.h"

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
