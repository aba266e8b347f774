find_package(GTest REQUIRED)

# grove_test(NAME SOURCES a.cpp… LIBRARIES target… LABELS label…): one program whose cases ctest knows one by one.
function(grove_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(grove_${name}_tests ${TEST_SOURCES})
  target_link_libraries(grove_${name}_tests PRIVATE ${TEST_LIBRARIES} grove_warnings GTest::gmock GTest::gtest_main)
  target_include_directories(grove_${name}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(grove_${name}_tests PRIVATE GROVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Tests run once for each time that they are compiled: what they test is optimised, they themselves need not be.
  target_compile_options(grove_${name}_tests PRIVATE $<$<CONFIG:Release>:-O1>)
  grove_precompile_headers(grove_${name}_tests tests precompiled_tests.h)
  gtest_discover_tests(grove_${name}_tests TEST_PREFIX "${name}." PROPERTIES LABELS "${TEST_LABELS}" DISCOVERY_TIMEOUT 60)
endfunction()
