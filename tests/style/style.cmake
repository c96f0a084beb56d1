# Checks of the source text and of the objects built from it.
foreach(check layering lengths format)
  add_test(NAME style.${check} COMMAND tests/style/${check}.sh WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endforeach()
add_test(NAME style.code_lines COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/code_lines.py)  # no room above 27 files
add_test(NAME style.layering_sees_upward_include COMMAND ${CMAKE_CURRENT_LIST_DIR}/layering.sh ${CMAKE_CURRENT_LIST_DIR}/upward)
set_tests_properties(style.layering_sees_upward_include PROPERTIES
  PASS_REGULAR_EXPRESSION "bad.h:2: base .floor 0. includes engine .floor 2.")

# Sanitizers add weak symbols of their own.
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  add_test(NAME style.symbols COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/symbols.py ${CMAKE_BINARY_DIR})
endif()
