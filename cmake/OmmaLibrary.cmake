# omma_library(NAME sources... LINK public-dependencies... PRIVATE_LINK private-dependencies...)
# One static library per folder of src/omma. Its dependencies are the only folders it may include.
include(GNUInstallDirs)

add_library(omma_options INTERFACE)
target_compile_features(omma_options INTERFACE cxx_std_20)
target_compile_options(
  omma_options INTERFACE $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor>
                         $<BUILD_INTERFACE:$<$<BOOL:${OMMA_WERROR}>:-Werror>>
                         # GCC 12 sees them where there are none, inside std::string (its bugs 105329, 105562).
                         $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-free-nonheap-object>>
                         $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>>
                         # Both triangles of an edge must round its plane alike (docs/conventions.md).
                         $<BUILD_INTERFACE:-ffp-contract=off>)
if(OMMA_SANITIZE)
  # GCC cannot tell what is initialized once its sanitizers have rewritten the code, and says so of std::regex.
  target_compile_options(omma_options INTERFACE $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>)
  target_compile_options(omma_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${OMMA_SANITIZE} -fno-omit-frame-pointer
                                                -fno-sanitize-recover=all>)
  # The address sanitizer sees what is read through a null pointer. Checks of null and of alignment before every access are
  # a quarter of the time to compile.
  if(OMMA_SANITIZE MATCHES undefined)
    target_compile_options(omma_options INTERFACE $<BUILD_INTERFACE:-fno-sanitize=null,alignment>)
  endif()
  target_link_options(omma_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${OMMA_SANITIZE}>)
endif()

set_property(GLOBAL PROPERTY OMMA_LIBRARIES omma_options)

function(omma_library name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE_LINK" ${ARGN})
  add_library(omma_${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  set_target_properties(omma_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(omma_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                 $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(omma_${name} PUBLIC omma_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  omma_use_precompiled(omma_${name} library)
  set_property(GLOBAL APPEND PROPERTY OMMA_LIBRARIES omma_${name})
endfunction()
