# A room is one library target; it may use only the rooms named in DEPENDS. See docs/architecture.md.

# Flags that every room, program and test is compiled with.
add_library(grove_flags INTERFACE)
target_compile_features(grove_flags INTERFACE cxx_std_20)
# Contraction into fused multiply-adds would make hits differ between instruction sets.
target_compile_options(grove_flags INTERFACE -ffp-contract=off)
# Warnings are for our own sources only: never exported.
add_library(grove_warnings INTERFACE)
target_compile_options(grove_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wcast-align -Woverloaded-virtual
  # Warns of the standard library's own std::string concatenation (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(GROVE_WARNINGS_AS_ERRORS)
  target_compile_options(grove_warnings INTERFACE -Werror)
endif()

# For builds from nothing without a compiler cache, which does not see through precompiled headers.
option(GROVE_PRECOMPILE_HEADERS "Parse the headers that most sources include once" OFF)

# grove_precompile_headers(TARGET KIND HEADER): parses HEADER once for all targets of a kind. Their flags must be the same.
function(grove_precompile_headers target kind header)
  if(NOT GROVE_PRECOMPILE_HEADERS)
    return()
  endif()
  get_property(first GLOBAL PROPERTY grove_first_precompiled_${kind})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/${header})
    set_property(GLOBAL PROPERTY grove_first_precompiled_${kind} ${target})
  endif()
endfunction()

# grove_room(NAME SOURCES a.cpp… DEPENDS room… LIBRARIES target… PRIVATE_LIBRARIES target…)
# Libraries of other packages are named PACKAGE::target, which is how the installed package knows what to look for.
function(grove_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(grove_${name} STATIC ${ROOM_SOURCES})
  add_library(grove::${name} ALIAS grove_${name})
  list(TRANSFORM ROOM_DEPENDS PREPEND grove_)
  target_include_directories(grove_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include>)
  # Private libraries are linked by whoever links this static one; CMake exports them as such. Warnings stay here.
  target_link_libraries(grove_${name}
    PUBLIC grove_flags ${ROOM_DEPENDS} ${ROOM_LIBRARIES}
    PRIVATE $<BUILD_INTERFACE:grove_warnings> ${ROOM_PRIVATE_LIBRARIES})
  set_target_properties(grove_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  grove_precompile_headers(grove_${name} rooms precompiled.h)
endfunction()
