# The Python package, as PYTHONPATH finds it in the build. The environment that built the module runs them: it needs NumPy and Pillow.
if(TARGET _core)
  set(environment "PYTHONPATH=${CMAKE_BINARY_DIR}/python;LFDSIM_PROGRAM=$<TARGET_FILE:lfdsim>")
  foreach(script displays pictures photographs analysis bad_input fuzz work documents)
    add_test(NAME python.${script} COMMAND ${LFDSIM_PYTHON_INTERPRETER} ${CMAKE_CURRENT_LIST_DIR}/${script}.py)
    set_tests_properties(python.${script} PROPERTIES ENVIRONMENT "${environment}" TIMEOUT 300)
  endforeach()
  add_test(NAME python.minimal COMMAND ${LFDSIM_PYTHON_INTERPRETER} ${PROJECT_SOURCE_DIR}/examples/minimal.py
    ${PROJECT_SOURCE_DIR}/displays/hexagon.toml ${CMAKE_BINARY_DIR}/minimal.png)
  set_tests_properties(python.minimal PROPERTIES ENVIRONMENT "${environment}" PASS_REGULAR_EXPRESSION "SSIM.: 0\\.9")
  foreach(script analysis fuzz)
    add_test(NAME python.${script}_full COMMAND ${LFDSIM_PYTHON_INTERPRETER} ${CMAKE_CURRENT_LIST_DIR}/${script}.py)
    set_tests_properties(python.${script}_full PROPERTIES ENVIRONMENT "${environment};LFDSIM_FULL=1" TIMEOUT 3600 LABELS full)
  endforeach()
  add_test(NAME python.typed_full COMMAND ${LFDSIM_PYTHON_INTERPRETER} ${CMAKE_CURRENT_LIST_DIR}/typed.py)
  set_tests_properties(python.typed_full PROPERTIES ENVIRONMENT "${environment}" TIMEOUT 300 LABELS full SKIP_RETURN_CODE 77)
  # Asks PyPI for what runs notebooks.
  add_test(NAME python.notebooks_full
    COMMAND ${LFDSIM_PYTHON_INTERPRETER} ${CMAKE_CURRENT_LIST_DIR}/notebooks.py ${CMAKE_BINARY_DIR}/notebook-tools)
  set_tests_properties(python.notebooks_full PROPERTIES ENVIRONMENT "${environment}" TIMEOUT 3600 LABELS full SKIP_RETURN_CODE 77)
  # Asks PyPI for what builds a wheel; compiles all of the program once more.
  add_test(NAME python.wheel_full COMMAND ${CMAKE_CURRENT_LIST_DIR}/wheel.sh ${PROJECT_SOURCE_DIR} ${LFDSIM_PYTHON_INTERPRETER})
  set_tests_properties(python.wheel_full PROPERTIES TIMEOUT 3600 RUN_SERIAL ON LABELS full SKIP_RETURN_CODE 77)
  # Studies: those that take longer, and those on clusters (skipped where distributed or Slurm is missing), are left to --full.
  foreach(script file checks design store run program report pictures dask slurm tolerance)
    add_test(NAME study.${script} COMMAND ${LFDSIM_PYTHON_INTERPRETER} -m unittest test_${script}
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/tests/study)
    set_tests_properties(study.${script} PROPERTIES ENVIRONMENT "${environment}" TIMEOUT 900 SKIP_RETURN_CODE 77)
    if(script MATCHES "^(program|report|pictures|dask|slurm|tolerance)$")
      set_tests_properties(study.${script} PROPERTIES LABELS full)
    endif()
  endforeach()
  set_tests_properties(study.run PROPERTIES COST 100)  # it takes long, and begins early
endif()
