# Flags that every target of the project shares. They are properties of our own targets, never global: a project that
# adds Espalier as a subdirectory keeps its own flags.

# espalier_compile_options(<target>): warnings, and arithmetic that means the same on every machine (no contraction).
function(espalier_compile_options target)
  if(NOT PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -fno-fast-math)  # which the project around may set
  endif()
  target_compile_options(${target} PRIVATE
    -ffp-contract=off -fno-math-errno
    -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow -Wcast-align -Wundef)
  if(MINGW AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC cannot align the stack to 32 bytes there, but moves registers of AVX2 to and from it as if it had (GCC bug 54412).
    target_compile_options(${target} PRIVATE -Wa,-muse-unaligned-vector-move)
  endif()
  if(ESPALIER_WARNINGS_ARE_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(ESPALIER_SANITIZE)
    set(sanitizers address)
    if(NOT ESPALIER_SANITIZE STREQUAL "address")
      string(APPEND sanitizers ,undefined,float-cast-overflow)
    endif()
    if(CMAKE_CXX_COMPILER_ID MATCHES Clang AND NOT ESPALIER_SANITIZE STREQUAL "address")
      # what narrows without a cast; other people's headers may
      string(APPEND sanitizers ,implicit-conversion)
      target_compile_options(${target} PRIVATE -fsanitize-ignorelist=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/sanitizers_ignore.txt)
    endif()
    target_compile_options(${target} PRIVATE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${sanitizers})
  endif()
endfunction()

# espalier_precompile_only(<target> <header>...): these headers, if headers are precompiled. Clang with a compiler cache
# precompiles none: its files store the path and the time of each header, so that another checkout cannot use them. With GCC, ccache
# needs CCACHE_SLOPPINESS=pch_defines,time_macros.
function(espalier_precompile_only target)
  if(ESPALIER_PRECOMPILE_HEADERS AND NOT (CMAKE_CXX_COMPILER_LAUNCHER AND CMAKE_CXX_COMPILER_ID MATCHES Clang))
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# espalier_precompile_headers(<target> [<header>...]): what nearly every file of the baker and of the tests includes, and
# these headers, which take half of the time in which such a file compiles. Off by default, since a file that
# forgets an include is not noticed then.
function(espalier_precompile_headers target)
  espalier_precompile_only(${target} <algorithm> <array> <bit> <cmath> <cstdint> <functional> <limits> <optional>
    <span> <string> <variant> <vector> ${ARGN})
endfunction()

# espalier_unity_by_folder(<target>): with ESPALIER_UNITY the files of each folder are compiled as one. They parse the same headers and
# instantiate the same templates, which takes most of the time of each. Off by default: a change of one file compiles its folder.
function(espalier_unity_by_folder target)
  if(NOT ESPALIER_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE folder)
    cmake_path(GET folder PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${folder}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A source that another one includes looks like a header, where a private type in a public one would be a mistake.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
