#include "omma/gl/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "omma/base/error.h"
#include "omma/gl/shader_files.h"

namespace omma::gl {
namespace {

/// Replaces every `${NAME}`.
std::string substitute(std::string text, const Defines& defines) {
  for (const auto& [name, value] : defines) {
    const std::string pattern = "${" + name + "}";
    for (size_t at; (at = text.find(pattern)) != std::string::npos;) text.replace(at, pattern.size(), value);
  }
  return text;
}

void append_file(const std::string& name, const Defines& defines, std::vector<std::string>& files, std::string& out) {
  if (std::find(files.begin(), files.end(), name) != files.end()) return;
  const auto found = shader_files().find(name);
  if (found == shader_files().end()) throw MachineError("shader file '{}' is not built in", name);
  const size_t number = files.size();
  files.push_back(name);
  out += fmt::format("#line 1 {}\n", number);

  std::string_view text = found->second;
  for (int line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    constexpr std::string_view include = "#include \"";
    if (!row.starts_with(include)) {
      out.append(row).push_back('\n');
      continue;
    }
    const std::string_view path = row.substr(include.size(), row.rfind('"') - include.size());
    const std::string target = substitute(std::string(path), defines);
    if (target.find("${") == std::string::npos) append_file(target, defines, files, out);
    out += fmt::format("#line {} {}\n", line + 1, number);
  }
}

/// Drivers name a source by its number, `0:12(5):`, `ERROR: 0:12:` or `0(12) :`; people want its file.
std::string name_files(std::string_view log, const std::vector<std::string>& files) {
  constexpr std::string_view prefix = "ERROR: ";
  std::string result;
  while (!log.empty()) {
    std::string_view line = log.substr(0, log.find('\n') + 1);  // all that is left, where no line ends
    if (line.empty()) line = log;
    log.remove_prefix(line.size());
    const char* const end = line.data() + line.size();
    size_t file = 0, row = 0;
    const char* const begin = line.data() + (line.starts_with(prefix) ? prefix.size() : 0);
    const auto [behind_file, no_file] = std::from_chars(begin, end, file);
    if (no_file == std::errc() && behind_file != end && (*behind_file == ':' || *behind_file == '(')) {
      const auto [behind_row, no_row] = std::from_chars(behind_file + 1, end, row);
      if (no_row == std::errc()) {
        result += fmt::format("{}:{}", file < files.size() ? files[file] : std::to_string(file), row);
        line = std::string_view(behind_row, end);
      }
    }
    result += line;
  }
  return result;
}

struct ShaderTraits {
  static void destroy(GLuint id) { glDeleteShader(id); }
};
using Shader = Object<ShaderTraits>;

Shader compile(const Stage& stage, const Defines& defines) {
  std::vector<std::string> files;
  const std::string text = assemble_shader(stage.file, defines, &files);
  Shader shader(glCreateShader(stage.kind));
  const char* source = text.c_str();
  glShaderSource(shader.id(), 1, &source, nullptr);
  glCompileShader(shader.id());
  GLint compiled = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    std::string log(16384, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader.id(), GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    throw MachineError("{} does not compile on this driver:\n{}", stage.file, name_files(log, files));
  }
  return shader;
}

}  // namespace

std::string assemble_shader(std::string_view file, const Defines& defines, std::vector<std::string>* files) {
  std::string text = "#version 450 core\n";
  for (const auto& [name, value] : defines) text += fmt::format("#define {} {}\n", name, value);
  std::vector<std::string> local;
  append_file(std::string(file), defines, files != nullptr ? *files : local, text);
  return text;
}

Program::Program(const std::vector<Stage>& stages, const Defines& defines) : object_(glCreateProgram()) {
  std::vector<Shader> shaders;
  for (const Stage& stage : stages) {
    shaders.push_back(compile(stage, defines));
    glAttachShader(id(), shaders.back().id());
  }
  glLinkProgram(id());
  GLint linked = 0;
  glGetProgramiv(id(), GL_LINK_STATUS, &linked);
  if (!linked) {
    std::string log(16384, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(id(), GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    throw MachineError("{} does not link on this driver:\n{}", stages.back().file, log);
  }
  for (const Shader& shader : shaders) glDetachShader(id(), shader.id());
}

}  // namespace omma::gl
