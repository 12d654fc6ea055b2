// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <bitset>
#include <iterator>
#include <utility>

#include "sandbox/console.h"

// GLFW declares this only after Vulkan's headers, which only engine/gpu includes. These types have the size of the
// handles.
extern "C" int glfwCreateWindowSurface(void* instance, GLFWwindow* window, const void* allocator,
                                       std::uint64_t* surface);

namespace gloam {
namespace {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : one_line(text);
}

/// GLFW's keys in the order of EditKey.
constexpr int kEditKeys[] = {GLFW_KEY_TAB,      GLFW_KEY_LEFT,      GLFW_KEY_RIGHT, GLFW_KEY_UP,    GLFW_KEY_DOWN,
                             GLFW_KEY_PAGE_UP,  GLFW_KEY_PAGE_DOWN, GLFW_KEY_HOME,  GLFW_KEY_END,   GLFW_KEY_INSERT,
                             GLFW_KEY_DELETE,   GLFW_KEY_BACKSPACE, GLFW_KEY_SPACE, GLFW_KEY_ENTER, GLFW_KEY_ESCAPE,
                             GLFW_KEY_KP_ENTER, GLFW_KEY_A,         GLFW_KEY_C,     GLFW_KEY_V,     GLFW_KEY_X,
                             GLFW_KEY_Y,        GLFW_KEY_Z};
static_assert(std::size(kEditKeys) == kEditKeyCount);

/// GLFW's buttons in the order of PanelInput::buttons.
constexpr int kButtons[] = {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE};

/// Input events since the last poll. Polled states miss a key or button that is released within a slow frame.
struct Strikes {
  std::bitset<GLFW_KEY_LAST + 1> keys;
  std::bitset<GLFW_MOUSE_BUTTON_LAST + 1> buttons;
  double wheel = 0.0;
  std::u32string text;
};

Strikes& strikes_of(GLFWwindow* window) { return *static_cast<Strikes*>(glfwGetWindowUserPointer(window)); }

void listen(GLFWwindow* window, Strikes& strikes) {
  glfwSetWindowUserPointer(window, &strikes);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int /*scancode*/, int action, int /*mods*/) {
    if (action == GLFW_PRESS && key >= 0) strikes_of(w).keys.set(static_cast<std::size_t>(key));
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int /*mods*/) {
    if (action == GLFW_PRESS) strikes_of(w).buttons.set(static_cast<std::size_t>(button));
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double /*x*/, double y) { strikes_of(w).wheel += y; });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int c) { strikes_of(w).text += static_cast<char32_t>(c); });
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  Strikes strikes;
  double mouse_x = 0.0;
  double mouse_y = 0.0;
  bool dragging = false;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }
  [[nodiscard]] bool held(int key) const { return glfwGetKey(window, key) == GLFW_PRESS; }
  [[nodiscard]] double axis(int positive, int negative) const {
    return (held(positive) ? 1.0 : 0.0) - (held(negative) ? 1.0 : 0.0);
  }
  [[nodiscard]] PanelInput panel_input() const;
  [[nodiscard]] std::pair<int, int> size() const {
    int width = 0;
    int height = 0;
    if (glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE) glfwGetFramebufferSize(window, &width, &height);
    return width > 0 && height > 0 ? std::pair(width, height) : std::pair(0, 0);
  }
};

/// Uses the cursor position of the last poll.
PanelInput Window::State::panel_input() const {
  PanelInput input;
  // The cursor position is in desktop units, which may be larger than a pixel.
  int width = 0;
  int height = 0;
  glfwGetWindowSize(window, &width, &height);
  const auto [pixels_x, pixels_y] = size();
  input.mouse_x = mouse_x * pixels_x / std::max(width, 1);
  input.mouse_y = mouse_y * pixels_y / std::max(height, 1);
  for (std::size_t i = 0; i < std::size(kButtons); ++i)
    input.buttons[i] =
        strikes.buttons[static_cast<std::size_t>(kButtons[i])] || glfwGetMouseButton(window, kButtons[i]) == GLFW_PRESS;
  for (std::size_t i = 0; i < kEditKeyCount; ++i)
    input.keys[i] = strikes.keys[static_cast<std::size_t>(kEditKeys[i])] || held(kEditKeys[i]);
  input.wheel = strikes.wheel;
  input.text = strikes.text;
  input.control = held(GLFW_KEY_LEFT_CONTROL) || held(GLFW_KEY_RIGHT_CONTROL);
  input.shift = held(GLFW_KEY_LEFT_SHIFT) || held(GLFW_KEY_RIGHT_SHIFT);
  input.alt = held(GLFW_KEY_LEFT_ALT) || held(GLFW_KEY_RIGHT_ALT);
  return input;
}

Result<std::unique_ptr<Window>> Window::open(const std::string& title, std::uint32_t width, std::uint32_t height) {
  if (glfwInit() == GLFW_FALSE) return Error{ErrorKind::failed, "a window needs a display: " + glfw_reason()};
  auto state = std::make_unique<State>();
  if (glfwVulkanSupported() == GLFW_FALSE)
    return Error{ErrorKind::no_device, "no Vulkan for a window: " + glfw_reason()};
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  state->window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) return Error{ErrorKind::failed, "the window cannot be opened: " + glfw_reason()};
  glfwGetCursorPos(state->window, &state->mouse_x, &state->mouse_y);
  listen(state->window, state->strikes);
  return std::unique_ptr<Window>(new Window(std::move(state)));
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() = default;

std::vector<std::string> Window::vulkan_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return names == nullptr ? std::vector<std::string>() : std::vector<std::string>(names, names + count);
}

std::function<std::uint64_t(void* instance)> Window::surface_maker() const {
  return [window = state_->window](void* instance) {
    std::uint64_t surface = 0;
    constexpr int kVulkanSuccess = 0;
    return glfwCreateWindowSurface(instance, window, nullptr, &surface) == kVulkanSuccess ? surface : 0;
  };
}

WindowInput Window::poll() {
  State& s = *state_;
  s.strikes = {};
  if (s.size().first == 0 && !should_close()) {
    glfwWaitEventsTimeout(0.1);
  } else {
    glfwPollEvents();
  }

  WindowInput input = {.forward = s.axis(GLFW_KEY_W, GLFW_KEY_S),
                       .right = s.axis(GLFW_KEY_D, GLFW_KEY_A),
                       .up = s.axis(GLFW_KEY_E, GLFW_KEY_Q),
                       .fast = s.held(GLFW_KEY_LEFT_SHIFT),
                       .leave = s.strikes.keys[GLFW_KEY_ESCAPE],
                       .toggle_panel = s.strikes.keys[GLFW_KEY_TAB] || s.strikes.keys[GLFW_KEY_F1]};
  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(s.window, &x, &y);
  const bool pressed = glfwGetMouseButton(s.window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
                       glfwGetMouseButton(s.window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  if (pressed && s.dragging) {
    input.drag_x = x - s.mouse_x;
    input.drag_y = y - s.mouse_y;
  }
  s.dragging = pressed;
  s.mouse_x = x;
  s.mouse_y = y;
  input.panel = s.panel_input();
  return input;
}

bool Window::should_close() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }
std::uint32_t Window::width() const { return static_cast<std::uint32_t>(state_->size().first); }
std::uint32_t Window::height() const { return static_cast<std::uint32_t>(state_->size().second); }

double Window::content_scale() const {
  float x = 0.0f;
  float y = 0.0f;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return y > 0.0f ? static_cast<double>(y) : 1.0;
}

void Window::resize(std::uint32_t width, std::uint32_t height) {
  glfwSetWindowSize(state_->window, static_cast<int>(width), static_cast<int>(height));
}

}  // namespace gloam
