#include "gpu/gl/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gpu/gl/error.h"
#include "gpu/gl/shader_sources.h"

namespace lkao::gl {
namespace {

GLenum stage_of(const std::string& name) {
  const std::string stage = name.substr(name.rfind('.') + 1);
  if (stage == "vert") return GL_VERTEX_SHADER;
  if (stage == "geom") return GL_GEOMETRY_SHADER;
  if (stage == "frag") return GL_FRAGMENT_SHADER;
  return GL_COMPUTE_SHADER;
}

std::string first_line(std::string log) {
  log.resize(std::min(log.find('\n'), log.size()));
  log.resize(std::min(log.find('\0'), log.size()));
  return log.empty() ? "the driver gives no reason" : log;
}

ShaderObject compile(GLenum stage, const std::string& name, const std::string& text) {
  ShaderObject shader(glCreateShader(stage));
  const char* source = text.c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint is_compiled = GL_FALSE, log_size = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &is_compiled);
  if (is_compiled == GL_TRUE) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &log_size);
  std::string log(static_cast<std::size_t>(std::max(log_size, 1)), '\0');
  glGetShaderInfoLog(shader.name(), log_size, nullptr, log.data());
  throw std::runtime_error(fmt::format("the driver refuses the shader {}: {}", name, first_line(log)));
}

ProgramObject link(const std::vector<ShaderObject>& shaders, const std::string& name) {
  ProgramObject program(glCreateProgram());
  for (const ShaderObject& shader : shaders) glAttachShader(program.name(), shader.name());
  glLinkProgram(program.name());
  for (const ShaderObject& shader : shaders) glDetachShader(program.name(), shader.name());
  GLint is_linked = GL_FALSE, log_size = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &is_linked);
  if (is_linked != GL_TRUE) {
    glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &log_size);
    std::string log(static_cast<std::size_t>(std::max(log_size, 1)), '\0');
    glGetProgramInfoLog(program.name(), log_size, nullptr, log.data());
    throw std::runtime_error(fmt::format("the driver cannot link {}: {}", name, first_line(log)));
  }
  check_errors("making a program");
  return program;
}

std::string with_defines(std::string text, const Defines& defines) {
  std::string lines;
  for (const auto& [macro, value] : defines) lines += fmt::format("#define {} {}\n", macro, value);
  // #version must stay the first line.
  return text.insert(text.find('\n') + 1, lines);
}

}  // namespace

ProgramObject make_program(const std::vector<std::string>& names, const Defines& defines) {
  std::vector<ShaderObject> shaders;
  std::string all;
  for (const std::string& name : names) {
    shaders.push_back(compile(stage_of(name), name, with_defines(shader_source(name), defines)));
    all += (all.empty() ? "" : " + ") + name;
  }
  return link(shaders, all);
}

ProgramObject make_program_of(GLenum stage, const std::string& name, const std::string& text) {
  std::vector<ShaderObject> shaders;
  shaders.push_back(compile(stage, name, text));
  return link(shaders, name);
}

}  // namespace lkao::gl
