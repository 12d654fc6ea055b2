// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Descriptions of pipelines as text, so that a later process can make them before its first frame asks for them.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "engine/gpu/types.h"
#include "engine/render/pipelines/pipeline_list.h"

namespace gloam {

/// Owns names of constants, which descriptions refer to.
using PipelineNames = std::set<std::string, std::less<>>;

/// JSON with a checksum. Shaders are named, with a hash of their words.
[[nodiscard]] std::string pipeline_record(const PipelineList& list);

/// Whether a text is a whole record: its version and checksum are right.
[[nodiscard]] bool is_sound_record(std::string_view record);

/// The descriptions of a record, without those of shaders that `shaders` does not have with the same words. Empty if
/// the record is damaged. The result refers to `shaders` and `names`.
[[nodiscard]] PipelineList parse_pipeline_record(std::string_view record,
                                                 std::span<const gpu::ShaderCode* const> shaders, PipelineNames& names);

}  // namespace gloam
