# Scenes for other renderers. Where a renderer is not installed, its script prints "SKIPPED: why" and ends with 77.
if(TARGET lfdsim)
  add_test(NAME peers.scenes COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/scenes.py $<TARGET_FILE:lfdsim>)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    add_test(NAME peers.povray COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/povray.py $<TARGET_FILE:lfdsim>)
    add_test(NAME peers.povray_meshes COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/povray.py $<TARGET_FILE:lfdsim> --triangles 20000)
    add_test(NAME peers.povray_full COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/povray.py $<TARGET_FILE:lfdsim> --full)
    add_test(NAME peers.cycles COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/renderers.py $<TARGET_FILE:lfdsim> cycles)
    add_test(NAME peers.mitsuba COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/renderers.py $<TARGET_FILE:lfdsim> mitsuba)
    add_test(NAME peers.failing COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/failing.py $<TARGET_FILE:lfdsim>)
    set_tests_properties(peers.failing PROPERTIES TIMEOUT 3600 LABELS full)
    # All of them side by side, and whether they differ no more than they should
    add_test(NAME peers COMMAND ${PYTHON} ${PROJECT_SOURCE_DIR}/bench/peers/run --smallest --no-install --program $<TARGET_FILE:lfdsim>
      --out ${CMAKE_BINARY_DIR}/peers)
    set_tests_properties(peers PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 3600 LABELS full RUN_SERIAL ON)
    set_tests_properties(peers.povray peers.povray_meshes peers.povray_full peers.cycles peers.mitsuba PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
    set_tests_properties(peers.povray_meshes peers.povray_full PROPERTIES LABELS full TIMEOUT 7200)
  endif()
endif()
