# Installs the build, moves the installation elsewhere, builds the examples against it with find_package(omma), runs them,
# and compares the first one's picture with the installed tool's.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(JOIN " " line ${ARGN})
    message(FATAL_ERROR "${line}\nexit code ${status}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)

# Paths of the checkout or of the first prefix in the package would only work on the machine that built it.
file(GLOB_RECURSE package_files ${WORK}/first/*.cmake)
foreach(name ${package_files})
  file(READ ${name} text)
  foreach(folder ${SOURCE} ${WORK})
    string(FIND "${text}" "${folder}/" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${name} mentions ${folder}; an installed package must not")
    endif()
  endforeach()
endforeach()

file(RENAME ${WORK}/first ${WORK}/moved)
foreach(example minimal realtime rig moving_vertices)
  run(${CMAKE_COMMAND} -S ${SOURCE}/examples/${example} -B ${WORK}/${example} -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH=${WORK}/moved
      -DCMAKE_FIND_PACKAGE_NO_PACKAGE_REGISTRY=ON)
  run(${CMAKE_COMMAND} --build ${WORK}/${example})
endforeach()

run(${WORK}/minimal/minimal room ${WORK}/example.png)
run(${WORK}/realtime/realtime room)
run(${WORK}/rig/rig room ${WORK})
run(${WORK}/moving_vertices/moving_vertices ${WORK})
run(${WORK}/moved/bin/omma render room --camera equidistant:fov_deg=180 --size 512x512 -o ${WORK}/tool.png)
run(${WORK}/moved/bin/omma compare ${WORK}/example.png ${WORK}/tool.png --max-max 0)

# A texture of a rare format is read by a module, which the tool finds beside itself.
file(GLOB_RECURSE module ${BUILD}/lib*/omma_openimageio.so)
if(module)
  file(COPY ${SOURCE}/tests/unit/pictures/color.ppm DESTINATION ${WORK})
  file(WRITE ${WORK}/square.mtl "newmtl a\nmap_Kd color.ppm\n")
  file(WRITE ${WORK}/square.obj "mtllib square.mtl\nusemtl a\nv -1 -1 -2\nv 1 -1 -2\nv 0 1 -2\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
  execute_process(
    COMMAND ${WORK}/moved/bin/omma render ${WORK}/square.obj --camera equidistant --size 64x64 -o ${WORK}/square.png
    RESULT_VARIABLE status ERROR_VARIABLE said)
  if(NOT status EQUAL 0 OR said MATCHES "cannot be used")
    message(FATAL_ERROR "the installed tool does not read a texture in .ppm: exit code ${status}\n${said}")
  endif()
endif()
