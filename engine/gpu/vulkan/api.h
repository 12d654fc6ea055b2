// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

/// This folder's include of the Vulkan headers, without prototypes: every call goes through the function table of an
/// instance or a device (functions.h).
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>
