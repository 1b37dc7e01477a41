#include "gui/window/offscreen_window.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/error.h"
#include "gui/window/imgui_host.h"

namespace patina {
namespace {

/// The index in KeysDown of one of ImGui's named keys: letters and space as their ASCII codes, the rest above
/// those.
int key_index(ImGuiKey key) {
  switch (key) {
    case ImGuiKey_A:
      return 'A';
    case ImGuiKey_C:
      return 'C';
    case ImGuiKey_V:
      return 'V';
    case ImGuiKey_X:
      return 'X';
    case ImGuiKey_Y:
      return 'Y';
    case ImGuiKey_Z:
      return 'Z';
    case ImGuiKey_Space:
      return ' ';
    default:
      return 256 + key;
  }
}

/// An OSMesa context that draws into memory of its own.
class OsmesaContext {
 public:
  OsmesaContext(int width, int height) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context_) throw UserError("OSMesa offers no OpenGL 3.3; install a newer Mesa.");
    resize(width, height);
  }
  ~OsmesaContext() { OSMesaDestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void resize(int width, int height) {
    pixels_.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width, height)) {
      throw UserError("OSMesa cannot draw a picture of " + std::to_string(width) + " x " +
                      std::to_string(height) + " pixels; choose a smaller one.");
    }
  }

 private:
  OSMesaContext context_ = nullptr;
  std::vector<std::uint8_t> pixels_;
};

class OsmesaWindow final : public OffscreenWindow {
 public:
  OsmesaWindow(int width, int height)
      : target_(width, height),
        gl_([](const char* name) { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); }),
        renderer_(gl_) {
    ImGuiIO& io = ImGui::GetIO();
    io.BackendPlatformName = "patina, off screen";
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    for (ImGuiKey key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key_index(key);
  }

  const Gl& gl() const override { return gl_; }
  float content_scale() const override { return 1; }
  float pixel_density() const override { return 1; }

  void begin_frame(double timeout_seconds) override {
    if (settling_ > 0) {
      --settling_;
    } else if (input_.empty()) {
      sleep(timeout_seconds);
    }
    if (!input_.empty()) {
      input_.front()(ImGui::GetIO());
      input_.pop_front();
      settling_ = kSettlingFrames;
    }
    ImGui::GetIO().DeltaTime = 1.0f / 60;
    renderer_.prepare();
    ImGui::NewFrame();
  }

  void end_frame() override {
    draw_frame(renderer_);
    gl_.Finish();
  }

  bool should_close() const override { return closed_; }
  void close() override { closed_ = true; }

  void wake(int frames) override {
    {
      const std::lock_guard lock(mutex_);
      woken_ = std::max(woken_, frames);
    }
    wakened_.notify_one();
  }

  std::vector<std::filesystem::path> take_dropped_files() override { return std::exchange(dropped_, {}); }
  void set_title(const char*) override {}
  Image screenshot() override { return read_frame(gl_, renderer_); }

  void resize(int width, int height) override {
    target_.resize(width, height);
    renderer_.lose_window();
    ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  }

  void move_mouse(float x, float y) override {
    queue([=](ImGuiIO& io) { io.MousePos = {x, y}; });
  }
  void press_mouse(ImGuiMouseButton button) override {
    queue([=](ImGuiIO& io) { io.MouseDown[button] = true; });
  }
  void release_mouse(ImGuiMouseButton button) override {
    queue([=](ImGuiIO& io) { io.MouseDown[button] = false; });
  }
  void scroll(float x, float y) override {
    queue([=](ImGuiIO& io) {
      io.MouseWheelH += x;
      io.MouseWheel += y;
    });
  }
  void press_key(int key) override {
    queue([=](ImGuiIO& io) { io.KeysDown[key] = true; });
  }
  void release_key(int key) override {
    queue([=](ImGuiIO& io) { io.KeysDown[key] = false; });
  }
  void hold_modifiers(ImGuiKeyModFlags modifiers) override {
    queue([=](ImGuiIO& io) {
      io.KeyCtrl = modifiers & ImGuiKeyModFlags_Ctrl;
      io.KeyShift = modifiers & ImGuiKeyModFlags_Shift;
      io.KeyAlt = modifiers & ImGuiKeyModFlags_Alt;
      io.KeySuper = modifiers & ImGuiKeyModFlags_Super;
    });
  }
  void type(const std::string& utf8) override {
    queue([=](ImGuiIO& io) { io.AddInputCharactersUTF8(utf8.c_str()); });
  }
  void drop_files(std::vector<std::filesystem::path> files) override {
    queue([this, files = std::move(files)](ImGuiIO&) {
      dropped_.insert(dropped_.end(), files.begin(), files.end());
    });
  }
  bool input_taken() const override { return input_.empty(); }

 private:
  void queue(std::function<void(ImGuiIO&)> input) { input_.push_back(std::move(input)); }

  void sleep(double seconds) {
    std::unique_lock lock(mutex_);
    wakened_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return woken_ > 0; });
    settling_ = std::max(settling_, std::exchange(woken_, 0) - 1);
  }

  OsmesaContext target_;
  Gl gl_;
  ImguiContext context_;
  ImguiRenderer renderer_;
  std::deque<std::function<void(ImGuiIO&)>> input_;
  std::vector<std::filesystem::path> dropped_;
  bool closed_ = false;
  int settling_ = 0;
  std::mutex mutex_;
  std::condition_variable wakened_;
  int woken_ = 0;  ///< frames that were asked for; guarded by mutex_
};

}  // namespace

std::unique_ptr<OffscreenWindow> OffscreenWindow::make(int width, int height) {
  return std::make_unique<OsmesaWindow>(width, height);
}

void OffscreenWindow::click(float x, float y, ImGuiMouseButton button) {
  move_mouse(x, y);
  press_mouse(button);
  release_mouse(button);
}

void OffscreenWindow::double_click(float x, float y) {
  click(x, y);
  click(x, y);
}

void OffscreenWindow::drag(float x0, float y0, float x1, float y1, ImGuiMouseButton button) {
  move_mouse(x0, y0);
  press_mouse(button);
  move_mouse(0.5f * (x0 + x1), 0.5f * (y0 + y1));
  move_mouse(x1, y1);
  release_mouse(button);
}

void OffscreenWindow::tap_key(int key) {
  press_key(key);
  release_key(key);
}

}  // namespace patina
