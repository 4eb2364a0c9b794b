# ccache is used where it is installed. Paths count from the checkout, so that another checkout finds what this one built.
find_program(OMMA_CCACHE ccache DOC "Compiler cache; empty for none")
mark_as_advanced(OMMA_CCACHE)
if(OMMA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros ${OMMA_CCACHE})
endif()
