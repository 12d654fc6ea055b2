// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// Include this before tiny_gltf.h. It leaves images to engine/scene/decoding, and gives tinygltf a namespace that only
// gloam has: Debian's libdraco contains another build of tinygltf, whose classes have the same names and other members,
// and a program may link both.
#define tinygltf gloam_tinygltf
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
