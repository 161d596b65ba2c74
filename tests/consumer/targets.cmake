# A project downstream of the installed package, with laws of its own.
if(PEPERITE_INSTALL)
  add_test(NAME consumer
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/consumer
            -DCOMPILER=${CMAKE_CXX_COMPILER} -DMPIEXEC=${MPIEXEC_EXECUTABLE}
            -DWORK=${CMAKE_CURRENT_BINARY_DIR}/consumer -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/run.cmake)
  set_tests_properties(consumer PROPERTIES ENVIRONMENT "${PEPERITE_MPI_ENVIRONMENT}" TIMEOUT 300 PROCESSORS 2)
endif()
