# The instructions of a sample; and that the guard sees twice the work.
set(guard ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/guard.py $<TARGET_FILE:lfdsim>)
add_test(NAME instructions COMMAND ${guard})
add_test(NAME instructions_sees_more COMMAND ${guard} --only plain --set diffuser.profile=\"gaussian\")
set_tests_properties(instructions instructions_sees_more PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
set_tests_properties(instructions_sees_more PROPERTIES PASS_REGULAR_EXPRESSION "plain: .* more than 10 % over; .* renew the baseline")
