// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "sandbox/console.h"

// GLFW declares this only behind Vulkan's own headers, which stay in engine/gpu. Handles are as wide as these types.
extern "C" int glfwCreateWindowSurface(void* instance, GLFWwindow* window, const void* allocator,
                                       std::uint64_t* surface);

namespace gloam {
namespace {

std::string glfw_reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : one_line(text);
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
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
  [[nodiscard]] double axis(int positive, int negative) const {
    return (glfwGetKey(window, positive) == GLFW_PRESS ? 1.0 : 0.0) -
           (glfwGetKey(window, negative) == GLFW_PRESS ? 1.0 : 0.0);
  }
  [[nodiscard]] std::pair<int, int> size() const {
    int width = 0;
    int height = 0;
    if (glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE) glfwGetFramebufferSize(window, &width, &height);
    return width > 0 && height > 0 ? std::pair(width, height) : std::pair(0, 0);
  }
};

Result<std::unique_ptr<Window>> Window::open(const std::string& title, std::uint32_t width, std::uint32_t height) {
  if (glfwInit() == GLFW_FALSE) return Error{ErrorKind::failed, "a window needs a display: " + glfw_reason()};
  auto state = std::make_unique<State>();
  if (glfwVulkanSupported() == GLFW_FALSE)
    return Error{ErrorKind::no_device, "no Vulkan for a window: " + glfw_reason()};
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  state->window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) return Error{ErrorKind::failed, "the window cannot be opened: " + glfw_reason()};
  glfwGetCursorPos(state->window, &state->mouse_x, &state->mouse_y);
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
  if (s.size().first == 0 && !should_close()) {
    glfwWaitEventsTimeout(0.1);
  } else {
    glfwPollEvents();
  }
  if (glfwGetKey(s.window, GLFW_KEY_ESCAPE) == GLFW_PRESS) glfwSetWindowShouldClose(s.window, GLFW_TRUE);

  WindowInput input = {.forward = s.axis(GLFW_KEY_W, GLFW_KEY_S),
                       .right = s.axis(GLFW_KEY_D, GLFW_KEY_A),
                       .up = s.axis(GLFW_KEY_E, GLFW_KEY_Q),
                       .fast = glfwGetKey(s.window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS};
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
  return input;
}

bool Window::should_close() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }
std::uint32_t Window::width() const { return static_cast<std::uint32_t>(state_->size().first); }
std::uint32_t Window::height() const { return static_cast<std::uint32_t>(state_->size().second); }

void Window::resize(std::uint32_t width, std::uint32_t height) {
  glfwSetWindowSize(state_->window, static_cast<int>(width), static_cast<int>(height));
}

}  // namespace gloam
