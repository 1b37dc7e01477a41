#include "tests/window/desktop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace patina {

struct Desktop::Connection {
  Display* display;

  explicit Connection(const std::string& name) : display(XOpenDisplay(name.c_str())) {
    if (display == nullptr) throw std::runtime_error("no display " + name);
  }
  ~Connection() { XCloseDisplay(display); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Atom atom(const char* name) const { return XInternAtom(display, name, False); }
};

namespace {

/// The other program of a drag: asks, lets go, and hands over what was dragged.
class DragSource {
 public:
  DragSource(Display* display, Window target, std::string data)
      : display_(display), target_(target), data_(std::move(data)) {
    own_ = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display, atom("XdndSelection"), own_, CurrentTime);
  }
  ~DragSource() { XDestroyWindow(display_, own_); }
  DragSource(const DragSource&) = delete;
  DragSource& operator=(const DragSource&) = delete;

  bool drag_to(int x, int y) {
    send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")), 0, 0);
    send("XdndPosition", 0, (long{x} << 16) | y, CurrentTime, static_cast<long>(atom("XdndActionCopy")));
    const auto status = wait_for("XdndStatus");
    if (!status || (status->data.l[1] & 1) == 0) return false;
    send("XdndDrop", 0, CurrentTime, 0, 0);
    const auto finished = wait_for("XdndFinished");
    return finished && finished->data.l[1] != 0;  // GLFW says how many bytes it took, not 1
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  void send(const char* type, long second, long third, long fourth, long fifth) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    const long words[]{static_cast<long>(own_), second, third, fourth, fifth};
    std::copy(std::begin(words), std::end(words), event.xclient.data.l);
    XSendEvent(display_, target_, False, NoEventMask, &event);
    XFlush(display_);
  }

  void hand_over(const XSelectionRequestEvent& request) const {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(data_.data()), static_cast<int>(data_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display_, request.requestor, False, NoEventMask, &event);
    XFlush(display_);
  }

  /// At most twenty seconds.
  std::optional<XClientMessageEvent> wait_for(const char* type) const {
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
      while (XPending(display_) > 0) {
        XEvent event;
        XNextEvent(display_, &event);
        if (event.type == SelectionRequest) hand_over(event.xselectionrequest);
        if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return event.xclient;
      }
    }
    return std::nullopt;
  }

  Display* display_;
  Window target_, own_ = 0;
  std::string data_;
};

}  // namespace

Desktop::Desktop(const std::string& display)
    : display_(display), connection_(std::make_unique<Connection>(display)) {}

Desktop::~Desktop() = default;

std::optional<Desktop::Window> Desktop::window() const {
  ::Window root = 0, parent = 0, *children = nullptr;
  unsigned count = 0;
  XQueryTree(connection_->display, DefaultRootWindow(connection_->display), &root, &parent, &children,
             &count);
  std::optional<Window> found;
  for (unsigned i = 0; i < count && !found; ++i) {
    XWindowAttributes attributes;
    XGetWindowAttributes(connection_->display, children[i], &attributes);
    if (attributes.map_state == IsViewable && !title(children[i]).empty()) found = children[i];
  }
  if (children != nullptr) XFree(children);
  return found;
}

std::string Desktop::title(Window window) const {
  Atom type = 0;
  int format = 0;
  unsigned long length = 0, left = 0;
  unsigned char* bytes = nullptr;
  XGetWindowProperty(connection_->display, window, connection_->atom("_NET_WM_NAME"), 0, 1000, False,
                     connection_->atom("UTF8_STRING"), &type, &format, &length, &left, &bytes);
  if (bytes == nullptr) return {};
  std::string title(reinterpret_cast<char*>(bytes), length);
  XFree(bytes);
  return title;
}

Desktop::Picture Desktop::picture(Window window) const {
  XWindowAttributes attributes;
  XGetWindowAttributes(connection_->display, window, &attributes);
  XImage* image = XGetImage(connection_->display, window, 0, 0, static_cast<unsigned>(attributes.width),
                            static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
  if (image == nullptr) throw std::runtime_error("the window cannot be seen");
  Picture picture{attributes.width, attributes.height, {}};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      picture.pixels.push_back(static_cast<std::uint32_t>(XGetPixel(image, x, y) & 0xffffff));
  XDestroyImage(image);
  return picture;
}

void Desktop::click(int x, int y) const {
  const std::string at = std::to_string(x) + " " + std::to_string(y);
  if (std::system(("DISPLAY=" + display_ + " xdotool mousemove " + at + " sleep 0.3 click 1").c_str()) != 0)
    throw std::runtime_error("xdotool cannot click");
}

void Desktop::press(const std::string& key) const {
  if (std::system(("DISPLAY=" + display_ + " xdotool key " + key).c_str()) != 0)
    throw std::runtime_error("xdotool cannot type");
}

void Desktop::type(const std::string& text) const {
  if (std::system(("DISPLAY=" + display_ + " xdotool type --delay 60 '" + text + "'").c_str()) != 0)
    throw std::runtime_error("xdotool cannot type");
}

bool Desktop::drop(Window window, const std::filesystem::path& file) const {
  XWindowAttributes attributes;
  XGetWindowAttributes(connection_->display, window, &attributes);
  DragSource source(connection_->display, window, "file://" + file.string() + "\r\n");
  return source.drag_to(attributes.width / 2, attributes.height / 2);
}

void Desktop::close(Window window) const {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = connection_->atom("WM_PROTOCOLS");
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(connection_->atom("WM_DELETE_WINDOW"));
  XSendEvent(connection_->display, window, False, NoEventMask, &event);
  XFlush(connection_->display);
}

}  // namespace patina
