#include "gui/window/glfw_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "gui/window/imgui_host.h"

namespace patina {
namespace {

/// While a text is edited its cursor blinks.
constexpr double kBlinkSeconds = 0.2;

[[noreturn]] void refuse(const std::string& what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw UserError(what + " (" + (reason ? reason : "no reason given") +
                  "); start Patina in a desktop session with OpenGL 3.3, or use --offscreen FILE.png.");
}

struct GlfwLibrary {
  GlfwLibrary() {
    if (!glfwInit()) refuse("No window can be opened");
  }
  ~GlfwLibrary() { glfwTerminate(); }
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

struct ImguiGlfw {
  explicit ImguiGlfw(GLFWwindow* window) { ImGui_ImplGlfw_InitForOpenGL(window, true); }
  ~ImguiGlfw() { ImGui_ImplGlfw_Shutdown(); }
  ImguiGlfw(const ImguiGlfw&) = delete;
  ImguiGlfw& operator=(const ImguiGlfw&) = delete;
};

/// Dear ImGui 1.86 sees which keys are down as a frame begins; one that went down and up again since the
/// frame before would be lost. Such keys are held down for one frame.
class QuickTaps {
 public:
  /// @param modifiers  GLFW's, as the key went down: they may be up again, too, when the frame begins
  void went_down(int key, int modifiers) {
    keys_.push_back(key);
    if ((modifiers & GLFW_MOD_CONTROL) != 0) keys_.push_back(GLFW_KEY_LEFT_CONTROL);
    if ((modifiers & GLFW_MOD_SHIFT) != 0) keys_.push_back(GLFW_KEY_LEFT_SHIFT);
    if ((modifiers & GLFW_MOD_ALT) != 0) keys_.push_back(GLFW_KEY_LEFT_ALT);
  }

  /// Between the events and ImGui's frame.
  void hold() {
    for (const int key : keys_) ImGui::GetIO().KeysDown[key] = true;
    set_modifiers();
  }

  /// Before the next frame's events.
  void let_go(GLFWwindow* window) {
    for (const int key : keys_) ImGui::GetIO().KeysDown[key] = glfwGetKey(window, key) == GLFW_PRESS;
    keys_.clear();
    set_modifiers();
  }

 private:
  static void set_modifiers() {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
    io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
    io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
  }

  std::vector<int> keys_;
};

using WindowHandle = std::unique_ptr<GLFWwindow, decltype(&glfwDestroyWindow)>;

WindowHandle open(const std::string& title, int width, int height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  WindowHandle window(glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr), glfwDestroyWindow);
  if (!window) refuse("No window with OpenGL 3.3 can be opened");
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  return window;
}

class GlfwWindow final : public Window {
 public:
  GlfwWindow(const std::string& title, int width, int height)
      : window_(open(title, width, height)),
        gl_([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }) {
    // Before ImGui installs its own callbacks, which call these on.
    glfwSetWindowUserPointer(window_.get(), this);
    watch_input();
    glue_.emplace(window_.get());
    renderer_.emplace(gl_);
  }

  const Gl& gl() const override { return gl_; }

  float pixel_density() const override {
    int width = 0, pixels = 0, unused = 0;
    glfwGetWindowSize(window_.get(), &width, &unused);
    glfwGetFramebufferSize(window_.get(), &pixels, &unused);
    return width > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1;
  }

  float content_scale() const override {
    float scale = 1, unused = 1;
    glfwGetWindowContentScale(window_.get(), &scale, &unused);
    return std::max(1.0f, scale / pixel_density());
  }

  void begin_frame(double timeout_seconds) override {
    if (ImGui::GetIO().WantTextInput) timeout_seconds = std::min(timeout_seconds, kBlinkSeconds);
    taps_.let_go(window_.get());
    if (settling_ > 0 || timeout_seconds <= 0) {
      settling_ = std::max(settling_ - 1, 0);
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(timeout_seconds);
    }
    settling_ = std::max(settling_, woken_.exchange(0) - 1);
    ImGui_ImplGlfw_NewFrame();
    taps_.hold();
    renderer_->prepare();
    ImGui::NewFrame();
  }

  void end_frame() override {
    draw_frame(*renderer_);
    glfwSwapBuffers(window_.get());
    renderer_->lose_window();
  }

  bool should_close() const override { return glfwWindowShouldClose(window_.get()); }
  void close() override { glfwSetWindowShouldClose(window_.get(), GLFW_TRUE); }

  void wake(int frames) override {
    int asked = woken_;
    while (asked < frames && !woken_.compare_exchange_weak(asked, frames)) continue;
    glfwPostEmptyEvent();
  }

  std::vector<std::filesystem::path> take_dropped_files() override { return std::exchange(dropped_, {}); }
  void set_title(const char* title) override { glfwSetWindowTitle(window_.get(), title); }
  Image screenshot() override { return read_frame(gl_, *renderer_); }

 private:
  static GlfwWindow& of(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
  }
  static void stir(GLFWwindow* window) { of(window).settling_ = kSettlingFrames; }

  void watch_input() {
    GLFWwindow* window = window_.get();
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { stir(w); });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { stir(w); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { stir(w); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { stir(w); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
      if (action == GLFW_PRESS && key >= 0) of(w).taps_.went_down(key, modifiers);
      stir(w);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { stir(w); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { stir(w); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { stir(w); });
    glfwSetWindowRefreshCallback(window, stir);
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
      of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + count);
      stir(w);
    });
  }

  GlfwLibrary library_;
  WindowHandle window_;
  Gl gl_;
  ImguiContext context_;
  std::optional<ImguiGlfw> glue_;
  std::optional<ImguiRenderer> renderer_;
  std::vector<std::filesystem::path> dropped_;
  QuickTaps taps_;
  int settling_ = kSettlingFrames;
  std::atomic<int> woken_ = 0;  ///< frames that were asked for
};

}  // namespace

std::unique_ptr<Window> make_glfw_window(const std::string& title, int width, int height) {
  return std::make_unique<GlfwWindow>(title, width, height);
}

}  // namespace patina
