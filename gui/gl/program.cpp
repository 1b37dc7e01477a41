#include <algorithm>
#include <string>

#include "engine/error.h"
#include "engine/io/file.h"
#include "gui/gl/objects.h"

namespace patina {
namespace {

/// The first line of a compiler's report, which names the place and the mistake.
std::string first_line(std::string log) {
  log.resize(std::min(log.find_first_of("\n\r"), log.size()));
  while (!log.empty() && (log.back() == ' ' || log.back() == '\0')) log.pop_back();
  return log.empty() ? "the driver gives no reason" : log;
}

template <class GetParameter, class GetLog>
std::string read_log(GLuint object, GetParameter get_parameter, GetLog get_log) {
  GLint length = 0;
  get_parameter(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(object, length, nullptr, log.data());
  return first_line(log);
}

GlName compile(const Gl& gl, GLenum stage, const std::string& name, const std::string& source) {
  GlName shader(gl, gl.CreateShader(stage), [](const Gl& g, GLuint object) { g.DeleteShader(object); });
  const char* text = source.c_str();
  gl.ShaderSource(shader.get(), 1, &text, nullptr);
  gl.CompileShader(shader.get());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    throw UserError("The graphics driver cannot compile the " +
                    std::string(stage == GL_VERTEX_SHADER ? "vertex" : "fragment") + " shader \"" + name +
                    "\": " + read_log(shader.get(), gl.GetShaderiv, gl.GetShaderInfoLog) +
                    "; reinstall the program or update the driver.");
  }
  return shader;
}

}  // namespace

Program::Program(const Gl& gl, const std::string& name, const std::string& vertex_source,
                 const std::string& fragment_source)
    : name_(gl, gl.CreateProgram(), [](const Gl& g, GLuint object) { g.DeleteProgram(object); }) {
  const GlName vertex = compile(gl, GL_VERTEX_SHADER, name, vertex_source);
  const GlName fragment = compile(gl, GL_FRAGMENT_SHADER, name, fragment_source);
  gl.AttachShader(name_.get(), vertex.get());
  gl.AttachShader(name_.get(), fragment.get());
  gl.LinkProgram(name_.get());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(name_.get(), GL_LINK_STATUS, &linked);
  if (!linked) {
    throw UserError("The graphics driver cannot link the shaders \"" + name +
                    "\": " + read_log(name_.get(), gl.GetProgramiv, gl.GetProgramInfoLog) +
                    "; reinstall the program or update the driver.");
  }
}

Program Program::load(const Gl& gl, const std::string& vertex, const std::string& fragment) {
  const auto folder = data_directory() / "shaders";
  return Program(gl, fragment, read_file(folder / (vertex + ".vert")),
                 read_file(folder / (fragment + ".frag")));
}

void Program::use() const { name_.gl().UseProgram(name_.get()); }

GLint Program::location(const char* uniform) const {
  return name_.gl().GetUniformLocation(name_.get(), uniform);
}

}  // namespace patina
