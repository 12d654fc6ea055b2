// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "engine/gpu/types.h"

namespace gloam {

/// Descriptions of the pipelines that a module needs.
using PipelineList = std::vector<std::variant<gpu::ComputePipelineDesc, gpu::GraphicsPipelineDesc>>;

}  // namespace gloam
