# The pages of HTML reports, web/PAGE → PAGE.html, made at build time where Node.js is found. Without it the files are empty, which is how the
# program knows. They are made anew only when something in web/ has changed.
option(GROVE_BUILD_PAGES "Build the pages of HTML reports where Node.js 18 or later and npm are found" ON)

# grove_pages(DIRECTORY PAGE…): adds a target grove_pages that makes DIRECTORY/PAGE.html; sets GROVE_PAGES_BUILD, for the whole project, to the folder that
# they are built in, with node_modules, or to nothing where they are not built.
function(grove_pages directory)
  list(TRANSFORM ARGN REPLACE "(.+)" "${directory}/\\1.html" OUTPUT_VARIABLE outputs)
  set(GROVE_PAGES_BUILD "" CACHE INTERNAL "")
  find_program(GROVE_NODE node DOC "Node.js, for the pages of HTML reports")
  find_program(GROVE_NPM npm DOC "Node.js' package manager, for the pages of HTML reports")
  set(version "")
  if(GROVE_BUILD_PAGES AND GROVE_NODE AND GROVE_NPM)
    execute_process(COMMAND "${GROVE_NODE}" --version OUTPUT_VARIABLE version ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    string(REGEX REPLACE "^v" "" version "${version}")
  endif()
  if(NOT version OR version VERSION_LESS 18)
    message(STATUS "HTML reports: no (they need nodejs 18 or later and npm)")
    foreach(output IN LISTS outputs)
      file(CONFIGURE OUTPUT "${output}" CONTENT "")
    endforeach()
    add_custom_target(grove_pages)
    return()
  endif()
  message(STATUS "HTML reports: yes (Node.js ${version})")

  set(web "${PROJECT_SOURCE_DIR}/web")
  set(work "${PROJECT_BINARY_DIR}/web")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${web}/*.ts" "${web}/*.mjs" "${web}/*.css" "${web}/*.html" "${web}/*.json" "${web}/.npmrc")
  list(FILTER sources EXCLUDE REGEX "/(node_modules|dist)/")
  # Packages that could not be had last time are tried again after each configuring.
  if(EXISTS "${work}/packages-missing")
    file(REMOVE ${outputs})
  endif()
  add_custom_command(
    OUTPUT ${outputs}
    COMMAND "${CMAKE_COMMAND}" "-DNODE=${GROVE_NODE}" "-DNPM=${GROVE_NPM}" "-DSOURCES=${web}" "-DWORK=${work}" "-DOUTPUT=${directory}"
            "-DPAGES=${ARGN}" -P "${PROJECT_SOURCE_DIR}/cmake/build_pages.cmake"
    DEPENDS ${sources} "${PROJECT_SOURCE_DIR}/cmake/build_pages.cmake"
    COMMENT "Building the pages of HTML reports" VERBATIM)
  add_custom_target(grove_pages DEPENDS ${outputs})
  set(GROVE_PAGES_BUILD "${work}" CACHE INTERNAL "")
endfunction()
