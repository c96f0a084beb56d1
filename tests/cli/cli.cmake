# The program as a user runs it. Each script is a test; where the machine cannot do it, it prints "SKIPPED: why" and ends with 77.
if(TARGET lfdsim)
  foreach(script bad_input bad_model usage json_output interrupt same_bits write_errors full_disk)
    add_test(NAME cli.${script} COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/${script}.py $<TARGET_FILE:lfdsim>)
    set_tests_properties(cli.${script} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
  endforeach()
endif()
