# The pages made from what the tool says: cmake -DOMMA=bin/omma [-DCHECK=ON] -P docs/pages.cmake
# With CHECK it compares the pages instead of writing them.
function(page name introduction)
  execute_process(COMMAND ${OMMA} ${name} --markdown OUTPUT_VARIABLE tables RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${OMMA} ${name} --markdown: exit code ${status}")
  endif()
  set(page ${CMAKE_CURRENT_LIST_DIR}/${name}.md)
  set(text "${introduction}\n\n${tables}")
  if(NOT CHECK)
    file(WRITE ${page} "${text}")
    return()
  endif()
  set(written "")
  if(EXISTS ${page})
    file(READ ${page} written)
  endif()
  string(REGEX MATCHALL "images/cameras/[a-z0-9_]+\\.jpg" pictures "${text}")
  foreach(picture ${pictures})
    if(NOT EXISTS ${CMAKE_CURRENT_LIST_DIR}/${picture})
      message(FATAL_ERROR "docs/${picture} is missing; ./dev docs renders it")
    endif()
  endforeach()
  if(NOT text STREQUAL written)
    message(FATAL_ERROR "${page} is not what ${OMMA} says; ./dev docs writes it anew")
  endif()
endfunction()

page(cameras "# Cameras

Written by `./dev docs` from `src/omma/camera/models/`. θ is the angle from the optical axis and r the distance from the
principal point in focal lengths; [conventions.md](conventions.md) has frames and units. The pictures are of each lens's
example, in the middle of a street.")

page(effects "# Effects

Written by `./dev docs` from `src/omma/shading/effects.cpp`. `omma render … --effect NAME:KEY=VALUE,KEY=VALUE` paints
surfaces before they are lit, or draws over them afterwards; up to four effects follow one another. Each is one file in
`shaders/shading/effects/`, drawn by every technique: it knows a surface's position, texture coordinates and place in its
triangle, and how they change from pixel to pixel, and nothing of cameras.

A pixel of width is one of the image in every technique but `image-based`, which draws on cube faces: there it is a texel,
and what comes out varies with the lens ([results/effects.md](results/effects.md)). At triangles' edges lines are
smooth; at outlines, where half of a line is seen, `--samples` smooths them. Metres are the world's, in single precision:
within some kilometres of its origin they are good to a millimetre. Colours are `black`, `white`, `grey`, `red`, `green`,
`blue`, `yellow`, or six hexadecimal digits of sRGB. Only `color` has effects; the background has none.

`--show edges` draws all triangles' edges over any picture: `wireframe:width_px=2.5,color=white` after all other effects.")
