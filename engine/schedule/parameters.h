// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "engine/ecs/commands.h"
#include "engine/ecs/type_key.h"
#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/schedule/access.h"

// Parameter types of systems, besides View<…>, JobExecutor& and (in Stage::view) ViewId.

namespace gloam {

/// A resource that must exist: Resource<const R> reads, Resource<R> writes.
template <class R>
class Resource {
 public:
  explicit Resource(R& value) : value_(&value) {}
  [[nodiscard]] R& operator*() const { return *value_; }
  [[nodiscard]] R* operator->() const { return value_; }

 private:
  R* value_;
};

/// A resource that may be absent.
template <class R>
class OptionalResource {
 public:
  explicit OptionalResource(R* value) : value_(value) {}
  [[nodiscard]] explicit operator bool() const { return value_ != nullptr; }
  /// Null when absent.
  [[nodiscard]] R* get() const { return value_; }
  /// The resource must exist.
  [[nodiscard]] R& operator*() const { return *get_checked(); }
  [[nodiscard]] R* operator->() const { return get_checked(); }

 private:
  [[nodiscard]] R* get_checked() const {
    GLOAM_ASSERT(value_ != nullptr, "an optional resource is looked at before it is used");
    return value_;
  }
  R* value_;
};

/// A resource of the view that the stage runs for; it must exist. Only in Stage::view.
template <class R>
class ViewResource {
 public:
  explicit ViewResource(R& value) : value_(&value) {}
  [[nodiscard]] R& operator*() const { return *value_; }
  [[nodiscard]] R* operator->() const { return value_; }

 private:
  R* value_;
};

/// Structural changes that a system records. They are applied when all systems of the stage have ended, system by
/// system in order of registration.
class Commands : public CommandBuffer {
 public:
  /// For a parallel loop: `count` buffers, one per range, applied in order after the system's other commands. Call it
  /// once per run.
  [[nodiscard]] CommandLists& ranges(std::size_t count) {
    ranges_.prepare(count);
    return ranges_;
  }
  CommandReport apply(World& world);
  void clear();

 private:
  CommandLists ranges_;
};

/// Arguments of one run of a system.
struct SystemContext {
  World& world;
  JobExecutor& executor;
  Commands& commands;
  ViewId view;
};

namespace detail {

/// Declares the access of a parameter type and makes the parameter.
template <class Parameter>
struct SystemParameter {
  static_assert(!std::is_same_v<Parameter, Parameter>,
                "systems take View, Resource, OptionalResource, ViewResource, JobExecutor&, Commands& and ViewId");
};

template <class... Args>
struct SystemParameter<View<Args...>> {
  static void declare(SystemAccess& access) { (declare_one<Args>(access), ...); }
  static View<Args...> make(const SystemContext& context) { return View<Args...>(context.world); }

 private:
  template <class Arg>
  static void declare_one(SystemAccess& access) {
    if constexpr (ViewTerm<Arg>::kColumn) {
      using Component = typename ViewTerm<Arg>::Component;
      access.declare({AccessKind::component, type_key<Component>(), type_name<Component>(), ViewTerm<Arg>::kWrites});
    }
  }
};

template <class R>
void declare_resource(SystemAccess& access, AccessKind kind) {
  using Value = std::remove_const_t<R>;
  access.declare({kind, type_key<Value>(), type_name<Value>(), !std::is_const_v<R>});
}

/// The world, const if R is const: the access checker then sees a read instead of a write.
template <class R>
auto& world_for(const SystemContext& context) {
  if constexpr (std::is_const_v<R>) {
    return std::as_const(context.world);
  } else {
    return context.world;
  }
}

template <class R>
struct SystemParameter<Resource<R>> {
  static void declare(SystemAccess& access) { declare_resource<R>(access, AccessKind::resource); }
  static Resource<R> make(const SystemContext& context) {
    return Resource<R>(world_for<R>(context).template resource<std::remove_const_t<R>>());
  }
};

template <class R>
struct SystemParameter<OptionalResource<R>> {
  static void declare(SystemAccess& access) { declare_resource<R>(access, AccessKind::resource); }
  static OptionalResource<R> make(const SystemContext& context) {
    return OptionalResource<R>(world_for<R>(context).template try_resource<std::remove_const_t<R>>());
  }
};

template <class R>
struct SystemParameter<ViewResource<R>> {
  static void declare(SystemAccess& access) {
    declare_resource<R>(access, AccessKind::view_resource);
    access.per_view = true;
  }
  static ViewResource<R> make(const SystemContext& context) {
    return ViewResource<R>(world_for<R>(context).template view_resource<std::remove_const_t<R>>(context.view));
  }
};

template <>
struct SystemParameter<JobExecutor&> {
  static void declare(SystemAccess&) {}
  static JobExecutor& make(const SystemContext& context) { return context.executor; }
};

template <>
struct SystemParameter<Commands&> {
  static void declare(SystemAccess& access) { access.commands = true; }
  static Commands& make(const SystemContext& context) { return context.commands; }
};

template <>
struct SystemParameter<ViewId> {
  static void declare(SystemAccess& access) { access.per_view = true; }
  static ViewId make(const SystemContext& context) { return context.view; }
};

/// Views and resources may also be taken by const reference.
template <class Parameter>
struct SystemParameter<const Parameter&> : SystemParameter<Parameter> {};

}  // namespace detail
}  // namespace gloam
