# docs/cameras.md, made from what the tool says of its cameras: cmake -DOMMA=bin/omma [-DCHECK=ON] -P docs/cameras.cmake
# With CHECK it compares the page instead of writing it.
execute_process(COMMAND ${OMMA} cameras --markdown OUTPUT_VARIABLE tables RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${OMMA} cameras --markdown: exit code ${status}")
endif()
set(page ${CMAKE_CURRENT_LIST_DIR}/cameras.md)
set(text "# Cameras

Written by `./dev docs` from `src/omma/camera/models/`. θ is the angle from the optical axis and r the distance from the
principal point in focal lengths; [conventions.md](conventions.md) has frames and units.

${tables}")
if(NOT CHECK)
  file(WRITE ${page} "${text}")
  return()
endif()
set(written "")
if(EXISTS ${page})
  file(READ ${page} written)
endif()
if(NOT text STREQUAL written)
  message(FATAL_ERROR "${page} is not what ${OMMA} says; ./dev docs writes it anew")
endif()
