// GLSL programs from the files of shaders/.
//
// `#include "path"` pulls in another file once; `${NAME}` in its path is replaced by that define's value, and
// without that define it pulls in nothing. Every line keeps its number, and a compiler's complaint names the file.
#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "omma/gl/objects.h"

namespace omma::gl {

/// Preprocessor symbols; an empty value defines the bare name.
using Defines = std::map<std::string, std::string>;

struct Stage {
  GLenum kind;       ///< GL_VERTEX_SHADER, …
  std::string file;  ///< below shaders/
};

/// The text that is handed to the compiler. `files` receives the name behind each number of a #line.
/// Throws MachineError for a file that is not built in.
std::string assemble_shader(std::string_view file, const Defines& defines, std::vector<std::string>* files = nullptr);

class Program {
 public:
  Program() = default;
  /// Throws MachineError with the compiler's or linker's words when the driver refuses.
  Program(const std::vector<Stage>& stages, const Defines& defines);
  /// Takes over a program that somebody else linked.
  static Program wrap(GLuint id) {
    Program program;
    program.object_ = Object<Traits>(id);
    return program;
  }

  GLuint id() const { return object_.id(); }
  void use() const { glUseProgram(id()); }

  /// -1 where the program has no such uniform (the compiler drops those it does not need).
  GLint location(const char* name) const { return glGetUniformLocation(id(), name); }
  void set(const char* name, int value) const { glProgramUniform1i(id(), location(name), value); }
  void set(const char* name, unsigned value) const { glProgramUniform1ui(id(), location(name), value); }
  void set(const char* name, float value) const { glProgramUniform1f(id(), location(name), value); }
  void set(const char* name, glm::ivec2 value) const { glProgramUniform2iv(id(), location(name), 1, &value[0]); }
  void set(const char* name, glm::vec2 value) const { glProgramUniform2fv(id(), location(name), 1, &value[0]); }
  void set(const char* name, glm::vec3 value) const { glProgramUniform3fv(id(), location(name), 1, &value[0]); }
  void set(const char* name, glm::vec4 value) const { glProgramUniform4fv(id(), location(name), 1, &value[0]); }
  void set(const char* name, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(id(), location(name), 1, GL_FALSE, &value[0][0]);
  }
  void set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, &value[0][0]);
  }
  void set(const char* name, std::span<const int> values) const {
    glProgramUniform1iv(id(), location(name), GLsizei(values.size()), values.data());
  }
  void set(const char* name, std::span<const float> values) const {
    glProgramUniform1fv(id(), location(name), GLsizei(values.size()), values.data());
  }
  void set(const char* name, std::span<const unsigned> values) const {
    glProgramUniform1uiv(id(), location(name), GLsizei(values.size()), values.data());
  }
  void set(const char* name, std::span<const glm::ivec2> values) const {
    glProgramUniform2iv(id(), location(name), GLsizei(values.size()), &values[0][0]);
  }
  void set(const char* name, std::span<const glm::vec2> values) const {
    glProgramUniform2fv(id(), location(name), GLsizei(values.size()), &values[0][0]);
  }
  void set(const char* name, std::span<const glm::mat3> values) const {
    glProgramUniformMatrix3fv(id(), location(name), GLsizei(values.size()), GL_FALSE, &values[0][0][0]);
  }
  void set(const char* name, std::span<const glm::mat4> values) const {
    glProgramUniformMatrix4fv(id(), location(name), GLsizei(values.size()), GL_FALSE, &values[0][0][0]);
  }

 private:
  struct Traits {
    static void destroy(GLuint id) { glDeleteProgram(id); }
  };
  Object<Traits> object_;
};

}  // namespace omma::gl
