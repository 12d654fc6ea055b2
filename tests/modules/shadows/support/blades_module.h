// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "tests/shaders/gpu_test/casters/blades_shared.h"

namespace gloam::test {

/// Blades that one caster source draws.
struct BladeField {
  dvec3 origin = dvec3(0.0);  ///< world
  std::vector<shaders::Blade> resting;
  float phase = 0.0f;
  float reach_m = 0.0f;  ///< of the tips along X
  bool moving = false;   ///< CasterSource::moving
  Entity entity = kNoEntity;
  bool told = true;  ///< false: CasterSource::content_hash is 0

  /// The corners of a blade in the world, computed in double.
  struct Triangle {
    dvec3 corners[3];
  };
  [[nodiscard]] Triangle triangle(std::size_t blade) const;
  /// Holds the blades at any phase.
  [[nodiscard]] WorldBox bounds() const;
};

/// A module that uses only public headers, as a module of a host would: blades that a compute pass moves, and that cast
/// shadows from a storage buffer. Blades are not visible themselves. It must come before the shadows module, whose maps
/// read the buffers that this module writes in PassPhase::lists.
class BladesModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "blades"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override {
    return {!fields.empty(), std::to_string(fields.size()) + " fields"};
  }
  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override;
  void add_passes(FrameBuilder& frame, PassPhase phase) override;

  std::vector<BladeField> fields;
  std::function<void(FrameBuilder&, PassPhase)> also;  ///< called in each phase, if set
  /// Calls of the sources' functions since the test set them to 0.
  int declared = 0;
  int recorded = 0;

 private:
  void announce(FrameBuilder& frame);
  void sway(FrameBuilder& frame);

  std::vector<std::shared_ptr<BufferRef>> blades_;  ///< of the frame that is being declared, by field
};

}  // namespace gloam::test
