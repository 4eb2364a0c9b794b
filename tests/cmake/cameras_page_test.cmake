# docs/cameras.md is what the tool says of its cameras.
execute_process(COMMAND ${OMMA} cameras --markdown OUTPUT_VARIABLE said RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "omma cameras --markdown: exit code ${status}")
endif()
file(READ ${PAGE} written)
if(NOT said STREQUAL written)
  message(FATAL_ERROR "${PAGE} differs from `omma cameras --markdown`; ./dev docs writes it anew")
endif()
