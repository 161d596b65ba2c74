# The bits of some hundred scenes, as they were recorded.
add_executable(recorded recorded/recorded.cpp)
target_include_directories(recorded PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(recorded PRIVATE PEPERITE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(recorded PRIVATE equivalence_parts nlohmann_json::nlohmann_json)
add_mpi_test(recorded recorded RANKS 2 ARGS ${CMAKE_CURRENT_SOURCE_DIR}/recorded/fingerprints.json TIMEOUT 600)
