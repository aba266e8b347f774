# Run by the target grove_pages: copies SOURCES (web/) to WORK, installs the npm packages of the lock file there when it has changed, and builds
# PAGES into OUTPUT. Where the packages cannot be had, the pages are left empty and the build goes on.
cmake_minimum_required(VERSION 3.25)

# What is no longer in the sources goes, what npm installed stays.
file(GLOB entries "${WORK}/*")
list(FILTER entries EXCLUDE REGEX "/(node_modules|screenshots|installed-lock)$")
foreach(entry IN LISTS entries)
  file(REMOVE_RECURSE "${entry}")
endforeach()
file(COPY "${SOURCES}/" DESTINATION "${WORK}" PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)

file(SHA256 "${WORK}/package-lock.json" lock)
set(installed "")
if(EXISTS "${WORK}/installed-lock")
  file(READ "${WORK}/installed-lock" installed)
endif()
if(NOT installed STREQUAL lock)
  execute_process(
    COMMAND "${NPM}" ci --prefer-offline --no-progress --fetch-retries=1
    WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    string(REGEX MATCH "npm (error|ERR!)[^\n]*" reason "${said}")
    message(WARNING "HTML reports: npm could not install the packages of web/package-lock.json (${reason}); going on without the pages. "
                    "To try again, run CMake again.")
    file(REMOVE "${WORK}/installed-lock")
    file(WRITE "${WORK}/packages-missing" "")
    foreach(page IN LISTS PAGES)
      file(WRITE "${OUTPUT}/${page}.html" "")
    endforeach()
    return()
  endif()
  file(WRITE "${WORK}/installed-lock" "${lock}")
endif()

execute_process(COMMAND "${NODE}" build.mjs --out "${OUTPUT}" ${PAGES} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the pages of web/ could not be built; the first message above names the file")
endif()
