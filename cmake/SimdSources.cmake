# omma_simd_source(LIBRARY HEADER options...): compiles a header for every SIMD instruction set that Highway knows for this
# processor, each as an object of its own, so that no compiler works on all of them one after another. Who calls what is
# in them includes "simd_targets.h": OMMA_SIMD_TARGETS(declare) is declare(namespace) for each of them.

# Processors that have SSSE3 and no SSE 4 are of 2006 and 2007; they take the portable code. With sanitizers an instruction
# set takes minutes, and one of them beside the portable code shows as much as all.
if(OMMA_SANITIZE)
  set(disabled "(HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)")
else()
  set(disabled HWY_SSSE3)
endif()
set(choice "#define HWY_COMPILE_ALL_ATTAINABLE\n#define HWY_DISABLED_TARGETS ${disabled}\n")

# Sets `result` to the names of the instruction sets, which Highway alone can tell: they depend on compiler and processor.
function(omma_find_simd_targets result)
  set(question ${PROJECT_BINARY_DIR}/simd_targets.cpp)
  set(text "${choice}#include <hwy/detect_targets.h>\n")
  foreach(name SCALAR EMU128 SSSE3 SSE4 AVX2 AVX3 AVX3_DL NEON SVE SVE2 SVE_256 SVE2_128 PPC8 RVV WASM WASM_EMU256)
    string(APPEND text "#if HWY_TARGETS & HWY_${name}\nsimd_target ${name}\n#endif\n")
  endforeach()
  file(CONFIGURE OUTPUT ${question} CONTENT "${text}" @ONLY)
  get_target_property(include_folders hwy::hwy INTERFACE_INCLUDE_DIRECTORIES)
  list(TRANSFORM include_folders PREPEND -I)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  separate_arguments(flags NATIVE_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${flags} ${include_folders} -E ${question} OUTPUT_VARIABLE answer
                          COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "simd_target [A-Z0-9_]+" targets "${answer}")
  list(TRANSFORM targets REPLACE "simd_target " "")
  if(NOT targets)
    message(FATAL_ERROR "Highway names no instruction set to compile for; asked by ${question}")
  endif()
  set(${result} ${targets} PARENT_SCOPE)
endfunction()

omma_find_simd_targets(OMMA_SIMD_TARGETS)
message(STATUS "SIMD instruction sets: ${OMMA_SIMD_TARGETS}")
set(OMMA_SIMD_FOLDER ${PROJECT_BINARY_DIR}/simd)
list(TRANSFORM OMMA_SIMD_TARGETS REPLACE "(.+)" "declare(N_\\1)" OUTPUT_VARIABLE declarations)
list(JOIN declarations " " declarations)
file(CONFIGURE OUTPUT ${OMMA_SIMD_FOLDER}/simd_targets.h @ONLY
     CONTENT "${choice}#include <hwy/highway.h>\n#define OMMA_SIMD_TARGETS(declare) ${declarations}\n")

function(omma_simd_source library header)
  target_include_directories(${library} PRIVATE ${OMMA_SIMD_FOLDER})
  string(REPLACE -inl.h "" name ${header})
  file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/${header})
  foreach(target ${OMMA_SIMD_TARGETS})
    string(TOLOWER ${target} suffix)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/simd/${name}_${suffix}.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY
         CONTENT "#define HWY_BASELINE_TARGETS HWY_${target}\n#define HWY_COMPILE_ONLY_STATIC\n#include \"${path}\"\n")
    target_sources(${library} PRIVATE ${source})
    set_property(SOURCE ${source} PROPERTY COMPILE_OPTIONS ${ARGN})
    # A register for every number: with all loops unrolled sixteen times, what hardly a processor of the last twenty years
    # runs would take longer to compile than all the others.
    if(target STREQUAL SCALAR AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O1)
    endif()
    # The address sanitizer sees what one instruction set does, which all do alike; the other sanitizer has hardly a line of
    # these that it looks at, and takes as long to compile again.
    if(OMMA_SANITIZE MATCHES undefined)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize=undefined)
    endif()
    if(OMMA_SANITIZE AND target STREQUAL SCALAR)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-sanitize=all)
    endif()
  endforeach()
endfunction()
