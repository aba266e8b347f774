# Writes OUTPUT, a header that names the commit that SOURCE_DIR is at, when it differs from what is there. Run at each build.
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND git describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY "${SOURCE_DIR}"
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#pragma once\n\ninline constexpr char kBuiltCommit[] = \"@commit@\";\n" @ONLY)
