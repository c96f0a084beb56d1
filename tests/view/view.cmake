# Hostile browsers against the viewer's server.
add_executable(view_echo_server view/echo_server.cpp)
target_link_libraries(view_echo_server PRIVATE lfdsim_view fmt::fmt)
if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")  # it measures delays and memory
  add_test(NAME view_attacks COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/attacks.py $<TARGET_FILE:view_echo_server>)
endif()
