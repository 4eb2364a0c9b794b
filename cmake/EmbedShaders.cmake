# embed_shaders(OUTPUT): every file of shaders/, and what C++ and GLSL share, as text in one C++ source.
# Names are relative to shaders/; lens files are under models/, shapes around triangles under bounds/.
set(OMMA_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)

function(embed_shaders output)
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*)
  set(camera ${PROJECT_SOURCE_DIR}/src/omma/camera)
  file(GLOB shared CONFIGURE_DEPENDS ${camera}/models/*.h ${camera}/bounds/bounding_shape.h)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DSHADERS=${PROJECT_SOURCE_DIR}/shaders
            -DCAMERA=${camera} -P ${OMMA_EMBED_SCRIPT}
    DEPENDS ${shaders} ${shared} ${OMMA_EMBED_SCRIPT}
    COMMENT "Embedding shaders"
    VERBATIM)
endfunction()
