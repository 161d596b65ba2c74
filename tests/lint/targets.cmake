# Rules of the source: lint.py, and every header compiles alone: public ones by CMake, private ones as the first that
# their own .cpp includes, or by a stub.
set(lint ${CMAKE_CURRENT_SOURCE_DIR}/lint/lint.py)
add_test(NAME lint COMMAND ${PYTHON} -B ${lint})
add_test(NAME lint.self_test COMMAND ${PYTHON} -B ${lint} --self-test)

file(GLOB private_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/libdecomp/src/*.hpp
  ${PROJECT_SOURCE_DIR}/libsph/src/*/*.hpp ${PROJECT_SOURCE_DIR}/libsph/src/*/*/*.hpp)
set(stubs)
foreach(header ${private_headers})
  get_filename_component(name ${header} NAME_WE)
  string(REGEX REPLACE "hpp$" "cpp" own ${header})
  if(EXISTS ${own})
    file(STRINGS ${own} first REGEX "^#include" LIMIT_COUNT 1)
    if(first MATCHES "[/\"]${name}\\.hpp\"")
      continue()
    endif()
  endif()
  set(stub ${CMAKE_CURRENT_BINARY_DIR}/private_headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${stub} CONTENT "#include \"${header}\"\n")
  list(APPEND stubs ${stub})
endforeach()
add_library(private_headers OBJECT EXCLUDE_FROM_ALL ${stubs})
target_include_directories(private_headers PRIVATE
  $<TARGET_PROPERTY:sph,INCLUDE_DIRECTORIES> ${PROJECT_SOURCE_DIR}/libdecomp/src)
target_link_libraries(private_headers PRIVATE sph peperite_build)
target_compile_options(private_headers PRIVATE -O0)

add_test(NAME headers
  COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target all_verify_interface_header_sets private_headers)
set_tests_properties(headers PROPERTIES TIMEOUT 600 PROCESSORS 2)
