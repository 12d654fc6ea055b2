// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

/// The one way this layer sees Vulkan: no prototypes, every call goes through a table that belongs to an instance or a
/// device (functions.h).
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>
