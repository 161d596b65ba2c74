# Random scenes on random ranks: build/bin/bit_fuzz, and the MPI program that it feeds.
find_package(nlohmann_json REQUIRED)
add_executable(fuzz_ranks fuzz/fuzz_ranks.cpp fuzz/agreed.cpp)
target_include_directories(fuzz_ranks PRIVATE ${PROJECT_SOURCE_DIR}/libsph/src)
target_link_libraries(fuzz_ranks PRIVATE equivalence_parts nlohmann_json::nlohmann_json)
file(MAKE_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/bit_fuzz.py ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/bit_fuzz SYMBOLIC)
add_test(NAME fuzz.keys COMMAND ${PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/test_fuzz.py --programs $<TARGET_FILE_DIR:fuzz_ranks>)

# Cases that differed once.
file(GLOB kept CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/kept/*.json)
add_test(NAME fuzz.kept COMMAND ${PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/bit_fuzz.py
  --programs $<TARGET_FILE_DIR:fuzz_ranks> --mpirun ${MPIEXEC_EXECUTABLE} --no-shrink --replay ${kept})
set_tests_properties(fuzz.kept PROPERTIES TIMEOUT 300 PROCESSORS 4)
