// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/device.h"

#include <string>

#include "engine/core/assert.h"

namespace gloam::gpu {

Device::~Device() {
  GLOAM_ASSERT(users_ == 0, "a gpu::Device is destroyed before " + std::to_string(users_) + " of its users: destroy " +
                                "renderers and swapchains first");
}

}  // namespace gloam::gpu
