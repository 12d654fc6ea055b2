// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <bitset>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "sandbox/console.h"
#include "sandbox/window/gamepad.h"

// GLFW declares this only after Vulkan's headers, which only engine/gpu includes. These types have the size of the
// handles.
extern "C" int glfwCreateWindowSurface(void* instance, GLFWwindow* window, const void* allocator,
                                       std::uint64_t* surface);

namespace gloam {
namespace {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : joined_lines(text);
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

}  // namespace

// Window::State has members of these types, so they have linkage.

/// Input events since the last poll. Polled states miss a key or button that is released within a slow frame.
struct Strikes {
  std::bitset<GLFW_KEY_LAST + 1> keys;
  std::bitset<GLFW_MOUSE_BUTTON_LAST + 1> buttons;
  double wheel = 0.0;
  std::u32string text;
  std::vector<std::string> dropped;
};

/// Keys and buttons that an input script holds down.
struct Scripted {
  std::bitset<GLFW_KEY_LAST + 1> keys;
  bool left = false;
  bool right = false;
  bool minimised = false;
  std::optional<std::pair<double, double>> pointer;
  Gamepad pad;
};

namespace {

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
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    strikes_of(w).dropped.insert(strikes_of(w).dropped.end(), paths, paths + count);
  });
}

/// GLFW's number of a key of InputScript; GLFW_KEY_UNKNOWN for other names.
int script_key(const std::string& name) {
  constexpr std::pair<std::string_view, int> kNamed[] = {{"escape", GLFW_KEY_ESCAPE},
                                                         {"tab", GLFW_KEY_TAB},
                                                         {"space", GLFW_KEY_SPACE},
                                                         {"enter", GLFW_KEY_ENTER},
                                                         {"period", GLFW_KEY_PERIOD},
                                                         {"left_shift", GLFW_KEY_LEFT_SHIFT},
                                                         {"left_control", GLFW_KEY_LEFT_CONTROL}};
  for (const auto& [named, key] : kNamed)
    if (named == name) return key;
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + (name[0] - 'a');
  if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') return GLFW_KEY_0 + (name[0] - '0');
  for (int i = 1; i <= 12; ++i)
    if (name == "f" + std::to_string(i)) return GLFW_KEY_F1 + (i - 1);
  return GLFW_KEY_UNKNOWN;
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  Strikes strikes;   ///< of the last poll
  Strikes arriving;  ///< since then
  Scripted scripted;
  double mouse_x = 0.0;
  double mouse_y = 0.0;
  bool dragging = false;
  bool left = false;     ///< the left button is down, or was since the last poll
  bool moved = false;    ///< since a button went down
  int windowed[4] = {};  ///< place and size before full screen

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }
  [[nodiscard]] bool is_down(int key) const {
    return glfwGetKey(window, key) == GLFW_PRESS || scripted.keys[static_cast<std::size_t>(key)];
  }
  [[nodiscard]] bool struck(int key) const { return strikes.keys[static_cast<std::size_t>(key)]; }
  [[nodiscard]] bool pressed(int button) const {
    return glfwGetMouseButton(window, button) == GLFW_PRESS || (button == GLFW_MOUSE_BUTTON_LEFT && scripted.left) ||
           (button == GLFW_MOUSE_BUTTON_RIGHT && scripted.right);
  }
  [[nodiscard]] double axis(int positive, int negative) const {
    return (is_down(positive) ? 1.0 : 0.0) - (is_down(negative) ? 1.0 : 0.0);
  }
  void take_events();
  void move_pointer(WindowInput& input);
  [[nodiscard]] PanelInput panel_input() const;
  [[nodiscard]] std::pair<int, int> size() const {
    int width = 0;
    int height = 0;
    const bool iconified = scripted.minimised || glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
    if (!iconified) glfwGetFramebufferSize(window, &width, &height);
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
    input.buttons[i] = strikes.buttons[static_cast<std::size_t>(kButtons[i])] || pressed(kButtons[i]);
  for (std::size_t i = 0; i < kEditKeyCount; ++i)
    input.keys[i] = strikes.keys[static_cast<std::size_t>(kEditKeys[i])] || is_down(kEditKeys[i]);
  input.wheel = strikes.wheel;
  input.text = strikes.text;
  input.control = is_down(GLFW_KEY_LEFT_CONTROL) || is_down(GLFW_KEY_RIGHT_CONTROL);
  input.shift = is_down(GLFW_KEY_LEFT_SHIFT) || is_down(GLFW_KEY_RIGHT_SHIFT);
  input.alt = is_down(GLFW_KEY_LEFT_ALT) || is_down(GLFW_KEY_RIGHT_ALT);
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
  listen(state->window, state->arriving);
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

void Window::State::take_events() {
  if (size().first == 0 && glfwWindowShouldClose(window) == GLFW_FALSE) {
    glfwWaitEventsTimeout(0.1);
  } else {
    glfwPollEvents();
  }
  strikes = std::exchange(arriving, {});
}

void Window::State::move_pointer(WindowInput& input) {
  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(window, &x, &y);
  if (scripted.pointer) std::tie(x, y) = *scripted.pointer;
  const bool right = pressed(GLFW_MOUSE_BUTTON_RIGHT);
  const bool down = pressed(GLFW_MOUSE_BUTTON_LEFT) || right;
  input.grabbed = strikes.buttons[GLFW_MOUSE_BUTTON_RIGHT];
  input.wheel = strikes.wheel;
  if (down && dragging) {
    (right ? input.orbit_x : input.drag_x) = x - mouse_x;
    (right ? input.orbit_y : input.drag_y) = y - mouse_y;
    moved |= x != mouse_x || y != mouse_y;
  }
  // A press and its lift may both lie between two polls.
  const bool struck_left = strikes.buttons[GLFW_MOUSE_BUTTON_LEFT];
  if (struck_left) left = true;
  if (struck_left || !dragging) moved = false;
  input.clicked = left && !pressed(GLFW_MOUSE_BUTTON_LEFT) && !moved;
  if (!pressed(GLFW_MOUSE_BUTTON_LEFT)) left = false;
  dragging = down;
  mouse_x = x;
  mouse_y = y;
}

WindowInput Window::poll() {
  State& s = *state_;
  s.take_events();
  WindowInput input = {.forward = s.axis(GLFW_KEY_W, GLFW_KEY_S),
                       .right = s.axis(GLFW_KEY_D, GLFW_KEY_A),
                       .up = s.axis(GLFW_KEY_E, GLFW_KEY_Q),
                       .fast = s.is_down(GLFW_KEY_LEFT_SHIFT),
                       .leave = s.struck(GLFW_KEY_ESCAPE),
                       .toggle_panel = s.struck(GLFW_KEY_TAB) || s.struck(GLFW_KEY_F1),
                       .pause = s.struck(GLFW_KEY_SPACE) || s.struck(GLFW_KEY_P),
                       .step = s.struck(GLFW_KEY_PERIOD),
                       .screenshot = s.struck(GLFW_KEY_F12),
                       .full_screen = s.struck(GLFW_KEY_F11),
                       .look_at = s.struck(GLFW_KEY_F),
                       .dropped = s.strikes.dropped};
  for (int i = 1; i <= 9; ++i)
    if (s.struck(GLFW_KEY_0 + i) || s.struck(GLFW_KEY_KP_0 + i)) input.camera = static_cast<std::uint32_t>(i);
  if (const auto pad = read_gamepad()) add_gamepad(*pad, input);
  add_gamepad(s.scripted.pad, input);
  s.move_pointer(input);
  input.panel = s.panel_input();
  input.pointer_x = input.panel.mouse_x;
  input.pointer_y = input.panel.mouse_y;
  return input;
}

void Window::inject(const ScriptEvent& event) {
  using Kind = ScriptEvent::Kind;
  State& s = *state_;
  const int key = script_key(event.text);
  const bool is_key = event.kind == Kind::key || event.kind == Kind::hold || event.kind == Kind::release;
  if (is_key && key == GLFW_KEY_UNKNOWN) return;
  switch (event.kind) {
    case Kind::key:
      s.arriving.keys.set(static_cast<std::size_t>(key));
      break;
    case Kind::hold:
      s.arriving.keys.set(static_cast<std::size_t>(key));
      s.scripted.keys.set(static_cast<std::size_t>(key));
      break;
    case Kind::release:
      s.scripted.keys.reset(static_cast<std::size_t>(key));
      break;
    case Kind::move:
      s.scripted.pointer = {event.x, event.y};
      break;
    case Kind::press:
      s.arriving.buttons.set(GLFW_MOUSE_BUTTON_LEFT);
      s.scripted.left = true;
      break;
    case Kind::lift:
      s.scripted.left = false;
      break;
    case Kind::grab:
      s.arriving.buttons.set(GLFW_MOUSE_BUTTON_RIGHT);
      s.scripted.right = true;
      break;
    case Kind::let_go:
      s.scripted.right = false;
      break;
    case Kind::scroll:
      s.arriving.wheel += event.y;
      break;
    case Kind::type:
      s.arriving.text.append(event.text.begin(), event.text.end());
      break;
    case Kind::resize:
      glfwSetWindowSize(s.window, static_cast<int>(event.x), static_cast<int>(event.y));
      break;
    case Kind::minimise:
    case Kind::restore:
      s.scripted.minimised = event.kind == Kind::minimise;
      break;
    case Kind::pad:
      s.scripted.pad.set(event.text, static_cast<float>(event.x));
      break;
    case Kind::drop:
      s.arriving.dropped.push_back(event.text);
      break;
    case Kind::close:
      glfwSetWindowShouldClose(s.window, GLFW_TRUE);
      break;
    case Kind::wait:
    case Kind::widget:
    case Kind::pace:
    case Kind::say:
    case Kind::until:
      break;
  }
}

bool Window::pump() {
  glfwPollEvents();
  const bool full_screen = state_->arriving.keys[GLFW_KEY_F11];
  state_->arriving.keys.reset(GLFW_KEY_F11);
  return full_screen;
}

void Window::wait(double seconds) { glfwWaitEventsTimeout(seconds); }

bool Window::should_close() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }
std::uint32_t Window::width() const { return static_cast<std::uint32_t>(state_->size().first); }
std::uint32_t Window::height() const { return static_cast<std::uint32_t>(state_->size().second); }

std::pair<std::uint32_t, std::uint32_t> Window::desktop_size() const {
  if (state_->size().first == 0) return {0, 0};
  int width = 0;
  int height = 0;
  glfwGetWindowSize(state_->window, &width, &height);
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

double Window::content_scale() const {
  float x = 0.0f;
  float y = 0.0f;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return y > 0.0f ? static_cast<double>(y) : 1.0;
}

void Window::resize(std::uint32_t width, std::uint32_t height) {
  glfwSetWindowSize(state_->window, static_cast<int>(width), static_cast<int>(height));
}

bool Window::is_full_screen() const { return glfwGetWindowMonitor(state_->window) != nullptr; }

void Window::toggle_full_screen() {
  State& s = *state_;
  int* const place = s.windowed;
  if (is_full_screen()) {
    glfwSetWindowMonitor(s.window, nullptr, place[0], place[1], place[2], place[3], GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* const mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  if (mode == nullptr) return;
  glfwGetWindowPos(s.window, place, place + 1);
  glfwGetWindowSize(s.window, place + 2, place + 3);
  glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }
void Window::copy(const std::string& text) { glfwSetClipboardString(state_->window, text.c_str()); }

void Window::hide() { glfwHideWindow(state_->window); }

}  // namespace gloam
