// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/module.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "engine/render/frame_builder.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/keys/table.h"
#include "modules/closeups/closeup_passes.h"
#include "modules/closeups/components.h"
#include "modules/closeups/compose/composition.h"
#include "modules/closeups/compose/frame.h"
#include "modules/closeups/debug/pick.h"
#include "modules/closeups/debug/visualizers.h"
#include "modules/closeups/knobs.h"
#include "modules/closeups/systems.h"
#include "modules/lights/components.h"
#include "modules/lights/light_names.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/components.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

// Limit of a scene file: the pairs that may form, in reach or not. Each is tested in each frame.
constexpr std::uint64_t kMaxPossiblePairs = std::uint64_t{1} << 18;

std::uint64_t casting_light_count(const World& world) {
  std::uint64_t count = 0;
  world.view<const Light, Maybe<const ShadowCaster>>().each(
      [&](const Light&, const ShadowCaster* caster) { count += caster == nullptr || caster->enabled ? 1 : 0; });
  return count;
}

Status check_subjects(World& world) {
  const std::uint64_t casting = casting_light_count(world);
  std::uint64_t pairs = 0;
  Status status;
  world.view<const CloseupSubject>().each([&](Entity entity, const CloseupSubject& subject) {
    const std::string& names = world.resource<SceneStrings>().text(subject.lights);
    auto lights = resolve_light_names(world, names, "gloam.closeup.lights");
    if (status.ok() && !lights.ok()) status = lights.error();
    if (!status.ok() || !subject.enabled) return;
    pairs += names.empty() ? casting : lights->size();
    if (pairs <= kMaxPossiblePairs) return;
    const auto* node = world.try_get<SourceNode>(entity);
    status =
        Error{ErrorKind::input, "node " + std::to_string(node == nullptr ? 0 : node->index) +
                                    ": gloam.closeup: the subjects up to here and their lights form " +
                                    std::to_string(pairs) + " pairs, at most " + std::to_string(kMaxPossiblePairs) +
                                    " are read; name fewer lights in gloam.closeup.lights"};
  });
  return status;
}

bool has_subjects(const World& world) {
  bool found = false;
  world.view<const CloseupSubject>().each([&](const CloseupSubject& subject) { found = found || subject.enabled; });
  return found;
}

class CloseupsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "closeups"; }
  [[nodiscard]] std::vector<std::string_view> needs() const override { return {"lights", "shadows"}; }
  void register_components(World& world) const override {
    world.register_component<CloseupSubject>("closeup_subject");
    world.register_component<CloseupPair>("closeup_pair");
    register_closeup_resources(world);
  }
  void knobs(KnobRegistry& registry) const override { add_closeup_knobs(registry); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override {
    std::vector<ReferenceInfo> references;
    for (const std::string_view knob : {kMostCloseupPairs.name, kCloseupTexelsPerPixel.name, kCloseupSingleFetches.name,
                                        kCloseupBatch.name, kCloseupDrawsStandard.name})
      references.push_back(traced_shadows(std::string(knob)));
    return references;
  }
  [[nodiscard]] std::string idle_knob(const World& world, const RenderView&, std::string_view knob,
                                      const FrameCounters& counters) const override {
    const auto pairs = counters.find("closeups.pairs");
    if (pairs == counters.end()) return {};
    if (pairs->second <= 0.0) return "no close-up pair has a map";
    if (knob == kCloseupBatch.name && pairs->second < 2.0) return "one close-up pair is in view";
    const auto& materials = world.resource<SceneAssets>().materials;
    const bool blends =
        std::ranges::any_of(materials, [](const Material& m) { return m.alpha_mode == AlphaMode::blend; });
    return knob == kCloseupDrawsStandard.name && !blends ? "no material is blended" : "";
  }
  void add_systems(Schedule& schedule) override { add_closeup_systems(schedule); }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return closeup_visualizers(); }
  void scene_keys(KeyRegistry& registry) const override {
    registry.add(boolean_key(key_line("closeups", KeyElement::node, "gloam.closeup", "false", "",
                                      "whether the meshes of this subtree are a close-up subject"),
                             &CloseupSubject::enabled));
    registry.add(text_key(key_line("closeups", KeyElement::node, "gloam.closeup.lights", "", "",
                                   "names of the light nodes that form close-up pairs with the subject, "
                                   "comma-separated; default: every shadowed light that reaches it"),
                          &CloseupSubject::lights));
    registry.add(number_key(key_line("closeups", KeyElement::node, "gloam.closeup.priority", "1", "",
                                     "pairs of subjects with higher priority get close-up maps first"),
                            -1e6, 1e6, &CloseupSubject::priority));
    registry.add_finish("closeups", &check_subjects);
  }
  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] std::string switched_off(const World&, const KnobRegistry& knobs) const override {
    if (closeup_knobs(knobs).max_pairs == 0) return "closeups.max_pairs=0";
    return knobs.value(kShadowMode) == ShadowMode::off ? "shadows.mode=off" : "";
  }
  /// For a view: needed if a pair touches it, even if no pair gets a map (counter closeups.skipped).
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    std::size_t subjects = 0;
    world.view<const CloseupSubject>().each([&](const CloseupSubject& s) { subjects += s.enabled ? 1 : 0; });
    if (subjects == 0) return {false, "no close-up subject"};
    const std::string words = std::to_string(subjects) + (subjects == 1 ? " close-up subject" : " close-up subjects");
    if (casting_light_count(world) == 0) return {false, words + ", but no light casts shadows"};
    if (view == nullptr) return {true, words};
    // Captures share standard maps, so subjects stay in them.
    if (view->purpose == ViewPurpose::capture) return {false, "captures have no close-ups"};
    if (!sees_surfaces(world, *view)) return {false, words + ", only sky in view"};
    const CloseupViews& views = world.view_resource<CloseupViews>(view->id);
    return {views.in_view > 0, std::to_string(views.in_view) + " close-up pairs in view, " +
                                   std::to_string(views.pairs.size()) + " with close-up maps"};
  }

  void leave_world(World& world) const override { leave_closeup_world(world); }

  [[nodiscard]] bool needs_casters(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kShadowMode) == ShadowMode::deferred && closeup_knobs(knobs).max_pairs > 0;
  }

  void prepare_view(World& world, ViewId view, const KnobRegistry& knobs) const override {
    prepare_closeup_view(world, view);
    world.set_view_resource(view, OverlayRoom{.wanted = closeup_knobs(knobs).max_pairs > 0});
    const auto* seen = world.try_view_resource<RenderView>(view);
    const bool captures = seen != nullptr && seen->purpose == ViewPurpose::capture;
    world.set_view_resource(view, ListRoom{.all = !captures && needs_casters(world, knobs) && has_subjects(world)});
    world.view_resource<CloseupSettings>(view) =
        closeup_settings(closeup_knobs(knobs), knobs.value(kShadowMode) == ShadowMode::deferred);
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce) {
      // Casters are withheld from standard maps only when the pipelines that draw them instead are ready.
      if (frame.services().wait_for_pipelines || ready_)
        announce(frame);
      else
        last_.erase(key_of(frame.world(), frame.view()));
    }
    if (phase == PassPhase::visualize) views_.add_pass(frame);
    if (phase != PassPhase::lists) return;
    if (frame.find<CloseupFrame>() == nullptr)
      ready_ = closeup_pipelines_ready(frame, closeup_knobs(frame.knobs()));
    else
      last_[key_of(frame.world(), frame.view())].maps_drawn = add_closeup_passes(frame, closeup_knobs(frame.knobs()));
  }

  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    return closeup_pick_lines(frame, pixel, copies);
  }

  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const auto found = last_.find(key_of(world, view));
    const LastFrame last = found == last_.end() ? LastFrame{} : found->second;
    sink.count("closeups.pairs", last.pairs);
    sink.count("closeups.skipped", last.skipped);
    sink.count("closeups.tiles", static_cast<double>(last.tiles));
    sink.count("closeups.maps_drawn", last.maps_drawn);
  }

 private:
  /// State of a view's last frame.
  struct LastFrame {
    std::uint32_t pairs = 0;
    std::uint32_t skipped = 0;
    std::uint64_t tiles = 0;
    std::uint32_t maps_drawn = 0;
    std::uint64_t number = 0;  ///< Device::frame_number
  };
  using Key = std::pair<std::uint64_t, std::uint32_t>;  ///< world_id and view
  static Key key_of(const World& world, const RenderView& view) { return {world_id(world), view.id.value}; }

  void announce(FrameBuilder& frame) {
    constexpr std::uint64_t kFramesKept = 120;
    const std::uint64_t number = frame.services().device.frame_number();
    std::erase_if(last_, [&](const auto& item) { return item.second.number + kFramesKept < number; });
    LastFrame& last = last_[key_of(frame.world(), frame.view())];
    auto reserved = reserve_umbra(frame, frame.world().view_resource<CloseupViews>(frame.view().id).pairs);
    CloseupFrame closeups = plan_closeup_frame(frame, reserved.has_value());
    last = {static_cast<std::uint32_t>(closeups.pairs.size()), closeups.skipped, 0, 0, number};
    if (reserved) frame.put(std::move(*reserved));
    for (const CloseupView& pair : closeups.pairs) last.tiles += pair.tiles.tiles();
    frame.put(composed_lights(closeups.pairs, closeup_knobs(frame.knobs())));
    frame.put(withheld_casters(closeups.pairs, frame.world().resource<CloseupSubjects>()));
    frame.put(std::move(closeups));
  }

  std::map<Key, LastFrame> last_;
  CloseupViewPasses views_;
  bool ready_ = false;  ///< the last request found all pipelines ready
};

}  // namespace

std::unique_ptr<Module> make_closeups_module() { return std::make_unique<CloseupsModule>(); }

}  // namespace gloam
