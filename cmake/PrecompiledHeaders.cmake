# omma_precompile(NAME [PIC] LINK libraries... HEADERS headers...): headers of others that many sources read, compiled once
# for all targets that take them by omma_use_precompiled(TARGET NAME). Only what hardly ever changes belongs here. Sources
# include what they use all the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without.
set(OMMA_STANDARD_HEADERS
    <algorithm> <array> <bit> <charconv> <chrono> <cmath> <cstdint> <cstring> <filesystem> <functional> <iterator> <limits>
    <map> <memory> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <fmt/core.h> <glm/glm.hpp> <glm/gtc/constants.hpp> <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp>)

function(omma_precompile name)
  cmake_parse_arguments(ARG "PIC" "" "LINK;HEADERS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "" @ONLY)
  add_library(omma_precompiled_${name} OBJECT ${source})
  target_link_libraries(omma_precompiled_${name} PRIVATE omma_options glm::glm fmt::fmt ${ARG_LINK})
  set_target_properties(omma_precompiled_${name} PROPERTIES POSITION_INDEPENDENT_CODE ${ARG_PIC})
  target_precompile_headers(omma_precompiled_${name} PRIVATE ${OMMA_STANDARD_HEADERS} ${ARG_HEADERS})
endfunction()

function(omma_use_precompiled target name)
  # Compilers refuse headers that were compiled for code of another kind of position.
  get_target_property(pic omma_precompiled_${name} POSITION_INDEPENDENT_CODE)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ${pic})
  target_precompile_headers(${target} REUSE_FROM omma_precompiled_${name})
endfunction()
