# The viewer's page: style and scripts joined into one HTML text, which one C++ function returns.
set(page_folder ${CMAKE_CURRENT_LIST_DIR}/page)
file(GLOB page_parts CONFIGURE_DEPENDS ${page_folder}/*.html ${page_folder}/*.css ${page_folder}/*.js)
set(page_cpp ${CMAKE_CURRENT_BINARY_DIR}/view/page.cpp)
add_custom_command(OUTPUT ${page_cpp}
  COMMAND ${CMAKE_COMMAND} -D CPP=${page_cpp} -P ${page_folder}/join.cmake
  DEPENDS ${page_folder}/join.cmake ${page_parts} VERBATIM)
target_sources(lfdsim_view PRIVATE ${page_cpp})
