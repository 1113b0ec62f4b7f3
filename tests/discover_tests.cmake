# Gives ctest one test for each TEST_CASE of a program. CMakeLists.txt includes this file for the function; after each link
# the build runs it as a script, which lists the cases.

# discover_tests(<program> LABELS <label>...): the tests get the labels
function(discover_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 argument "" "" LABELS)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_list.cmake)
  add_custom_command(TARGET ${program} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D program=$<TARGET_FILE:${program}> -D "labels=${argument_LABELS}" -D list=${list}
      -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    BYPRODUCTS ${list}
    VERBATIM)
  # A program that was not built is a test that fails.
  set(include_list ${CMAKE_CURRENT_BINARY_DIR}/${program}_include.cmake)
  file(CONFIGURE OUTPUT ${include_list} CONTENT [[
if(EXISTS [==[@list@]==])
  include([==[@list@]==])
else()
  add_test(@program@_is_built @program@_is_built)
  set_tests_properties(@program@_is_built PROPERTIES LABELS [==[@argument_LABELS@]==])
endif()
]] @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include_list})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

execute_process(COMMAND ${program} --list-test-cases OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${output}")
set(tests "")
foreach(name IN LISTS lines)
  if(name MATCHES "^(\\[doctest\\]|=====)")
    continue()
  endif()
  string(REPLACE "," "\\," pattern "${name}")
  # A name that selects no test must not count as passed.
  string(APPEND tests "add_test([==[${name}]==] [==[${program}]==] [==[--test-case=${pattern}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES LABELS [==[${labels}]==] SKIP_REGULAR_EXPRESSION SKIPPED:"
    " FAIL_REGULAR_EXPRESSION [==[test cases: +0 ]==] TIMEOUT 1200)\n")
endforeach()
if(tests STREQUAL "")
  message(FATAL_ERROR "${program} has no test cases")
endif()
file(WRITE ${list} "${tests}")
