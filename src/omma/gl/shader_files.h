// The GLSL files built into the library, by their path below shaders/; the lens files are below models/.
#pragma once

#include <map>
#include <string_view>

namespace omma::gl {

const std::map<std::string_view, std::string_view>& shader_files();

}  // namespace omma::gl
