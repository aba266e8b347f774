# `cmake --install`: headers, static libraries, and a CMake package of components that are found one by one:
#   grove::grove   the core: rooms base to registry
#   grove::scene   the core and scene files
#   grove::render  all that and the renderer
# One export set a component, so that a program of the core alone need not have the packages that the others are linked with.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(grove_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/grove")
set(grove_rooms_of_grove base math geometry accel build traverse registry)
set(grove_rooms_of_scene scene)
set(grove_rooms_of_render render)

# Sets OUT to the packages of the external targets that `target` is linked with; a target PACKAGE::name comes from PACKAGE.
function(grove_packages_of target out)
  get_target_property(private ${target} LINK_LIBRARIES)
  get_target_property(public ${target} INTERFACE_LINK_LIBRARIES)
  set(packages)
  foreach(library IN LISTS private public)
    if(library MATCHES "^([A-Za-z0-9_]+)::" AND NOT CMAKE_MATCH_1 STREQUAL "grove")
      list(APPEND packages ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(${out} ${packages} PARENT_SCOPE)
endfunction()

foreach(component grove scene render)
  set(targets)
  set(packages)
  foreach(room IN LISTS grove_rooms_of_${component})
    if(TARGET grove_${room})
      list(APPEND targets grove_${room})
      grove_packages_of(grove_${room} room_packages)
      list(APPEND packages ${room_packages})
      install(DIRECTORY src/grove/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/grove FILES_MATCHING PATTERN "*.h")
    endif()
  endforeach()
  if(component STREQUAL "grove")
    list(APPEND targets grove_core grove_flags)
  endif()
  if(targets)
    install(TARGETS ${targets} EXPORT grove-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT grove-${component} NAMESPACE grove:: DESTINATION ${grove_package_dir})
  endif()
  list(REMOVE_DUPLICATES packages)
  set(GROVE_PACKAGES_OF_${component} "${packages}")
endforeach()
set_target_properties(grove_flags PROPERTIES EXPORT_NAME flags)

configure_package_config_file(cmake/groveConfig.cmake.in "${PROJECT_BINARY_DIR}/groveConfig.cmake" INSTALL_DESTINATION ${grove_package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/groveConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/groveConfig.cmake" "${PROJECT_BINARY_DIR}/groveConfigVersion.cmake" DESTINATION ${grove_package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The command, under whatever target name its program is built.
foreach(program grove grove_command grove_app)
  if(TARGET ${program})
    get_target_property(kind ${program} TYPE)
    if(kind STREQUAL "EXECUTABLE")
      install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
  endif()
endforeach()
