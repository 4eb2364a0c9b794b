# embed_shaders(OUTPUT): every file of shaders/ and every lens file, as text in one C++ source.
# Names are relative to shaders/; lens files are under models/.
set(OMMA_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)

function(embed_shaders output)
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*)
  file(GLOB models CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/omma/camera/models/*.h)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DSHADERS=${PROJECT_SOURCE_DIR}/shaders
            -DMODELS=${PROJECT_SOURCE_DIR}/src/omma/camera/models -P ${OMMA_EMBED_SCRIPT}
    DEPENDS ${shaders} ${models} ${OMMA_EMBED_SCRIPT}
    COMMENT "Embedding shaders"
    VERBATIM)
endfunction()
