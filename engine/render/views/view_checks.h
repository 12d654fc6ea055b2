// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/view_request.h"

namespace gloam {

/// Asserts that no view is requested twice, and that none has the id of a companion.
void check_ids(std::span<const ViewRequest> requests);

/// Acquires a target that exists only while a frame is recorded. The view takes its size.
[[nodiscard]] Status acquire_target(const gpu::Device& device, ViewRequest& request);

/// Asserts that the view can be drawn into its target.
void check_target(const gpu::Device& device, const ViewRequest& request);

/// Usage error if the view is larger than kMostViewPixels a side: a size may come from a user.
[[nodiscard]] Status check_size(const ViewSettings& settings);

}  // namespace gloam
