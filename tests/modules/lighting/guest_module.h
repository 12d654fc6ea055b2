// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "engine/render/frame_builder.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam::test {

/// A module after all others, whose passes are a function of the test.
class GuestModule final : public Module {
 public:
  using Passes = std::function<void(FrameBuilder&, PassPhase)>;

  /// passes: must outlive the module; may change between frames. If empty, the world does not demand the module.
  /// motion: whether it needs GeometryOutputs::motion.
  explicit GuestModule(const Passes& passes, bool motion = false) : passes_(passes), motion_(motion) {}
  [[nodiscard]] std::string_view name() const override { return "guest"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override {
    return {static_cast<bool>(passes_), "the test says so"};
  }
  [[nodiscard]] bool needs_motion(const World&, const KnobRegistry&) const override { return motion_; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override { passes_(frame, phase); }

 private:
  const Passes& passes_;
  bool motion_;
};

/// A lit scene with a guest module.
class GuestSceneTest : public LitSceneTest {
 protected:
  [[nodiscard]] ModuleList make_modules() override {
    ModuleList modules = make_all_modules();
    modules.push_back(std::make_unique<GuestModule>(guest));
    return modules;
  }
  void set(std::string_view knob, std::string_view value) {
    ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob << "=" << value;
  }
  [[nodiscard]] ImageBytes image(std::string_view name) {
    return value_of(renderer->read_image(world, settings.id, name));
  }
  /// Numbers that differ.
  template <class T>
  [[nodiscard]] static std::size_t differences(const std::vector<T>& a, const std::vector<T>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
  }

  GuestModule::Passes guest;
};

}  // namespace gloam::test
