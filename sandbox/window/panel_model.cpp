// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_model.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "engine/core/assert.h"
#include "sandbox/output/json_text.h"
#include "sandbox/session/results/summary.h"

namespace gloam {
namespace {

constexpr double kManyTimes = 100.0;

void remember(std::vector<double>& history, double value) {
  if (history.size() == FrameTimes::kFrames) history.erase(history.begin());
  history.push_back(value);
}

std::string with_unit(const Knob& knob, const std::string& value) {
  return knob.unit.empty() ? value : value + " " + knob.unit;
}

std::string valid_values(const Knob& knob) {
  if (knob.type != Knob::Type::choice)
    return with_unit(knob, value_text(knob, knob.min) + " to " + value_text(knob, knob.max));
  std::string list;
  for (const std::string& choice : knob.choices) list += (list.empty() ? "" : ", ") + choice;
  return list;
}

}  // namespace

KnobWidget widget_of(const Knob& knob) {
  switch (knob.type) {
    case Knob::Type::choice:
      return KnobWidget::combo;
    case Knob::Type::integer:
      return KnobWidget::integer_slider;
    case Knob::Type::number:
      return KnobWidget::number_slider;
  }
  return KnobWidget::combo;
}

bool spans_magnitudes(const Knob& knob) { return knob.min > 0.0 && knob.max >= kManyTimes * knob.min; }

std::string slider_format(const Knob& knob) {
  std::string format = knob.type == Knob::Type::integer ? "%lld" : "%.4g";
  if (!knob.unit.empty()) format += ' ';
  for (const char c : knob.unit) format += c == '%' ? "%%" : std::string(1, c);
  return format;
}

std::string knob_tooltip(const Knob& knob) {
  std::string text = knob.name + ": " + knob.meaning + "\n" + valid_values(knob) +
                     "\ndefault: " + with_unit(knob, value_text(knob, knob.default_number));
  if (!knob.exact.empty()) text += "\nmost exact: " + with_unit(knob, knob.exact);
  return text;
}

double knob_value(const KnobRegistry& registry, const Knob& knob) { return registry.number(knob); }

void set_knob_value(KnobRegistry& registry, const Knob& knob, double value) {
  double valid = std::clamp(value, knob.min, knob.max);
  if (knob.type != Knob::Type::number) valid = std::round(valid);
  const Status set = registry.set(knob.name, value_text(knob, valid));
  GLOAM_ASSERT(set.ok(), "a knob takes the values of its range");
}

void reset_knob(KnobRegistry& registry, const Knob& knob) { set_knob_value(registry, knob, knob.default_number); }

bool is_default(const KnobRegistry& registry, const Knob& knob) {
  return knob_value(registry, knob) == knob.default_number;
}

bool matches(const Knob& knob, std::string_view search) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  const auto has = [&](const std::string& text) {
    return std::search(text.begin(), text.end(), search.begin(), search.end(), same) != text.end() || search.empty();
  };
  return has(knob.name) || has(knob.meaning);
}

std::vector<KnobGroup> knob_groups(const KnobRegistry& registry, std::string_view search) {
  std::vector<KnobGroup> groups;
  for (const Knob& knob : registry.knobs()) {
    if (!matches(knob, search)) continue;
    auto group = std::ranges::find(groups, knob.module, &KnobGroup::module);
    if (group == groups.end()) group = groups.insert(group, {.module = knob.module, .knobs = {}});
    group->knobs.push_back(&knob);
    if (!is_default(registry, knob)) ++group->changed;
  }
  return groups;
}

std::string config_text(const KnobRegistry& registry) {
  Json json = Json::object();
  for (const Knob& knob : registry.knobs()) {
    if (is_default(registry, knob)) continue;
    if (knob.type == Knob::Type::choice)
      json[knob.name] = registry.text(knob);
    else
      json[knob.name] = registry.number(knob);
  }
  return json_text(json);
}

std::string assignments_text(const KnobRegistry& registry) {
  std::string text;
  for (const Knob& knob : registry.knobs())
    if (!is_default(registry, knob)) text += " --set " + knob.name + "=" + registry.text(knob);
  return text;
}

void KnobSlots::keep(const KnobRegistry& registry, std::size_t slot) {
  slots_[slot].clear();
  for (const Knob& knob : registry.knobs()) slots_[slot][knob.name] = registry.text(knob);
}

std::vector<KnobOverride> KnobSlots::kept(std::size_t slot) const {
  std::vector<KnobOverride> values;
  for (const auto& [name, value] : slots_[slot]) values.push_back({name, value});
  return values;
}

void KnobSlots::show(KnobRegistry& registry, std::size_t slot) const {
  for (const auto& [name, value] : slots_[slot]) {
    const Knob* knob = registry.find(name);
    if (knob != nullptr && registry.text(*knob) == value) continue;
    const Status set = registry.set(name, value);
    GLOAM_ASSERT(set.ok(), "a knob takes a value that it had");
  }
}

ViewGroups view_groups(std::span<const VisualizerInfo> views, std::span<const ModuleState> modules) {
  ViewGroups groups;
  for (const VisualizerInfo& view : views) {
    if (view.trace) {
      groups.traced.push_back(&view);
      continue;
    }
    const auto module = std::ranges::find(modules, view.module, &ModuleState::name);
    if (module == modules.end() || module->demanded) {
      groups.called_for.push_back(&view);
      continue;
    }
    auto idle = std::ranges::find(groups.others, view.module, &IdleViews::module);
    if (idle == groups.others.end())
      idle = groups.others.insert(groups.others.end(), {.module = view.module, .reason = module->reason, .views = {}});
    idle->views.push_back(&view);
  }
  return groups;
}

std::string scale_text(double setting, double scale) {
  const std::string percent = std::to_string(std::lround(scale * 100.0)) + " %";
  return setting == 0.0 ? "auto (" + percent + ")" : percent;
}

void FrameTimes::add_systems(std::span<const Zone> zones) {
  std::map<std::pair<std::string, std::string>, double> sums;
  for (const Zone& zone : zones)
    sums[{zone.module, zone.name}] += static_cast<double>(zone.end_ns - zone.begin_ns) * 1e-6;
  decltype(system_ms_) kept;
  systems_.clear();
  for (const auto& [key, ms] : sums) {
    History& history = kept[key];
    if (const auto found = system_ms_.find(key); found != system_ms_.end()) history = std::move(found->second);
    remember(history, ms);
    systems_.push_back({key.second, key.first, summarize(history).median});
  }
  system_ms_ = std::move(kept);
  std::ranges::stable_sort(systems_, std::greater(), &SystemTime::ms);
}

void FrameTimes::add(double frame_ms, const FrameReport& report) {
  remember(frame_ms_, frame_ms);
  remember(cpu_ms_, report.cpu_ms);
  if (report.gpu_ms > 0.0) remember(gpu_ms_, report.gpu_ms);
  passes_ = report.passes;
  std::map<std::string, std::size_t> seen;
  decltype(pass_ms_) kept;
  for (PassTime& pass : passes_) {
    const std::pair key(pass.name, seen[pass.name]++);
    History& history = kept[key];
    if (const auto found = pass_ms_.find(key); found != pass_ms_.end()) history = std::move(found->second);
    remember(history, pass.ms);
    pass.ms = summarize(history).median;
  }
  pass_ms_ = std::move(kept);
}

double FrameTimes::frame_ms() const { return summarize(frame_ms_).median; }
double FrameTimes::cpu_ms() const { return summarize(cpu_ms_).median; }
double FrameTimes::gpu_ms() const { return summarize(gpu_ms_).median; }

}  // namespace gloam
