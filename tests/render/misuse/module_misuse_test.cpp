// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Renderers and modules as a careless host makes them: each kind of misuse, and the sentence that names it.
#include <algorithm>
#include <functional>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/scene/keys/registry.h"
#include "shaders/render/shaders.h"
#include "tests/render/misuse/careless_host.h"

namespace gloam {
namespace {

using test::CarelessHost;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A module that is given its parts.
class PartsModule final : public Module {
 public:
  explicit PartsModule(std::string name, std::function<void(FrameBuilder&)> passes = {})
      : name_(std::move(name)), passes_(std::move(passes)) {}
  [[nodiscard]] std::string_view name() const override { return name_; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry& registry) const override {
    if (!key_.empty()) registry.add({.name = key_});
  }
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (passes_ && phase == PassPhase::post) passes_(frame);
  }
  std::string key_;

 private:
  std::string name_;
  std::function<void(FrameBuilder&)> passes_;
};

ModuleList all_and(std::unique_ptr<Module> module) {
  ModuleList modules = make_all_modules();
  modules.push_back(std::move(module));
  return modules;
}
ModuleList all_and(std::string name, std::function<void(FrameBuilder&)> passes = {}) {
  return all_and(std::make_unique<PartsModule>(std::move(name), std::move(passes)));
}
/// How assertions name the module that all_and() adds.
std::string after_all() { return "module " + std::to_string(make_all_modules().size()) + " of the list"; }
void make(ModuleList modules) { CarelessHost stage(std::move(modules)); }

TEST(ModuleMisuse, a_renderer_without_a_device_or_an_executor) {
  const auto device = gpu::make_recording_device();
  const auto executor = make_serial_executor();
  EXPECT_ASSERT((void)Renderer::create({.executor = executor.get()}), "RendererOptions::device is null");
  EXPECT_ASSERT((void)Renderer::create({.device = device.get()}), "RendererOptions::executor is null");
}

TEST(ModuleMisuse, a_null_module) { EXPECT_ASSERT(make(all_and(std::unique_ptr<Module>())), after_all() + " is null"); }

TEST(ModuleMisuse, a_module_without_a_name) {
  EXPECT_ASSERT(make(all_and("")), after_all() + " has no name");
  EXPECT_ASSERT(make(all_and("engine")), "a module must not be named \"engine\"");
}

TEST(ModuleMisuse, a_module_twice) { EXPECT_ASSERT(make(all_and("fog")), "two modules of the list are named \"fog\""); }

TEST(ModuleMisuse, modules_in_a_wrong_order) {
  const std::size_t count = make_all_modules().size();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      ModuleList modules = make_all_modules();
      std::swap(modules[a], modules[b]);
      const std::string sentence = test::assertion_of([&] { make(std::move(modules)); });
      EXPECT_THAT(sentence, ::testing::AnyOf(HasSubstr("must come after"), HasSubstr("no assertion"))) << a << " " << b;
    }
  ModuleList modules = make_all_modules();
  std::swap(modules[0], modules[1]);
  EXPECT_ASSERT(make(std::move(modules)), "module \"shadows\" must come after \"lights\" in the list");
}

TEST(ModuleMisuse, any_list_without_some_modules_draws_or_says_what_it_lacks) {
  const std::size_t count = make_all_modules().size();
  for (std::uint32_t kept = 0; kept < (1u << count); kept += 7) {
    ModuleList modules, all = make_all_modules();
    for (std::size_t i = 0; i < count; ++i)
      if ((kept >> i & 1u) != 0) modules.push_back(std::move(all[i]));
    std::string names;
    for (const auto& module : modules) names += std::string(module->name()) + " ";
    const std::string sentence = test::assertion_of([&] {
      CarelessHost stage(std::move(modules));
      ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
    });
    EXPECT_THAT(sentence, ::testing::AnyOf(HasSubstr("needs the module"), HasSubstr("no assertion"))) << names;
  }
}

struct OutputOfNobody {
  int value = 0;
};

TEST(ModuleMisuse, an_output_that_no_module_has_put) {
  CarelessHost stage(all_and("host", [](FrameBuilder& frame) { (void)frame.get<OutputOfNobody>(); }));
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "module \"host\" needs the output");
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "OutputOfNobody");
}

TEST(ModuleMisuse, a_pass_that_names_bindings_that_its_shader_lacks_or_leaves_some_unbound) {
  const ComputeProgram scan = {shaders::render::scan_bins_comp};
  const auto sentence_of = [&](const std::function<void(ComputePass&)>& body) {
    CarelessHost stage(all_and("host", [&](FrameBuilder& frame) {
      ComputePass pass(frame, "careless", scan);
      body(pass);
    }));
    return test::assertion_of([&] { (void)stage.render(CarelessHost::request()); });
  };
  EXPECT_THAT(sentence_of([](ComputePass& pass) { pass.read("no_such_image", ImageRef()); }),
              HasSubstr("the shader declares no binding of this name"));
  EXPECT_THAT(sentence_of([](ComputePass& pass) { pass.dispatch(1); }), HasSubstr("careless"));
}

TEST(ModuleMisuse, a_pass_without_writes_is_logged_once) {
  CarelessHost stage(all_and("host", [](FrameBuilder& frame) {
    PassBuilder pass = frame.graph().add_pass("look", "host");
    pass.read(frame.get<GeometryOutputs>().depth, gpu::Access::compute_read);
    pass.execute([](PassContext&) { FAIL() << "the pass was not culled"; });
  }));
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.lines, Contains(HasSubstr("pass 'look' of module 'host' writes nothing, so it is culled")));
  EXPECT_THAT(stage.lines, SizeIs(1));
}

TEST(ModuleMisuse, a_scene_key_of_two_modules) {
  ModuleList modules;
  for (const char* name : {"one", "other"}) {
    auto module = std::make_unique<PartsModule>(name);
    module->key_ = "gloam.host.size";
    modules.push_back(std::move(module));
  }
  EXPECT_ASSERT((void)make_key_registry(modules), "a scene key is registered once: gloam.host.size");
  modules.push_back(nullptr);
  modules.erase(modules.begin());
  EXPECT_ASSERT((void)make_key_registry(modules), "module 1 of the list is null");
}

TEST(ModuleMisuse, knobs_that_are_unknown_twice_or_of_another_type) {
  CarelessHost stage;
  KnobRegistry& knobs = stage.renderer->knobs();
  constexpr NumberKnob kUnknown{.name = "shadows.maximum"};
  EXPECT_ASSERT((void)knobs.value(kUnknown), "knob shadows.maximum must be declared before it is read or set");
  constexpr OnOffKnob kOtherType{.name = "lights.fixed_slots"};
  EXPECT_ASSERT((void)knobs.value(kOtherType), "knob lights.fixed_slots is declared with another type");
  EXPECT_ASSERT(knobs.add(*knobs.find("shadows.mode")), "knob shadows.mode is declared twice");
}

void destroy_device_before_renderer() {
  CarelessHost stage;
  stage.device.reset();
}

TEST(ModuleMisuseDeathTest, a_device_that_goes_before_its_renderer) {
  EXPECT_DEATH(destroy_device_before_renderer(), "a gpu::Device is destroyed before 1 of its users");
}

}  // namespace
}  // namespace gloam
