#include "gui/gl/functions.h"

#include <string>

#include "engine/error.h"

namespace patina {
namespace {

template <class Function>
void find(Function& function, Gl::Loader loader, const char* name) {
  function = reinterpret_cast<Function>(loader(name));
  if (!function) {
    throw UserError(std::string("The graphics driver lacks the function ") + name +
                    "; update it, or choose a driver that offers OpenGL 3.3.");
  }
}

}  // namespace

Gl::Gl(Loader loader) {
#define PATINA_GL_FIND(TYPE, Name) find(Name, loader, "gl" #Name);
  PATINA_GL_FUNCTIONS(PATINA_GL_FIND)
#undef PATINA_GL_FIND
}

const char* Gl::renderer_name() const {
  const auto* name = reinterpret_cast<const char*>(GetString(GL_RENDERER));
  return name ? name : "unknown";
}

}  // namespace patina
