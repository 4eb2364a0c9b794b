# omma_precompile(NAME LINK libraries... HEADERS headers...): headers of others that many sources read, compiled once
# for all targets that take them by omma_use_precompiled(TARGET NAME). Only what hardly ever changes belongs here. Sources
# include what they use all the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(OMMA_STANDARD_HEADERS
    <algorithm> <array> <bit> <charconv> <chrono> <cmath> <cstdint> <cstring> <filesystem> <functional> <iterator> <limits>
    <map> <memory> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <fmt/format.h> <glm/glm.hpp> <glm/gtc/constants.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp>)

function(omma_precompile name)
  cmake_parse_arguments(ARG "" "" "LINK;HEADERS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "" @ONLY)
  add_library(omma_precompiled_${name} OBJECT ${source})
  target_link_libraries(omma_precompiled_${name} PRIVATE omma_options glm::glm fmt::fmt ${ARG_LINK})
  target_precompile_headers(omma_precompiled_${name} PRIVATE ${OMMA_STANDARD_HEADERS} ${ARG_HEADERS})
endfunction()

function(omma_use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM omma_precompiled_${name})
endfunction()
