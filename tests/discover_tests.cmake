# discover_tests(<program> LABELS <label>...): gives ctest one test for each folder of a program's sources, `cases: <folder>`. The
# cases of a folder run in one process, because they share blobs that take longer to bake than most cases take to run.
# `<program> -tc=NAME` runs one case.
function(discover_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 argument "" "" LABELS)
  get_target_property(sources ${program} SOURCES)
  get_target_property(base ${program} SOURCE_DIR)
  list(FILTER sources INCLUDE REGEX "_test\\.cpp$")
  set(folders "")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${base} NORMALIZE)
    cmake_path(GET source PARENT_PATH folder)
    list(APPEND folders ${folder})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE path)
    string(REGEX REPLACE "^tests/" "" words ${path})
    string(REGEX REPLACE "[/_]" " " words ${words})
    # Not those of its subfolders, which are tests of their own.
    add_test(NAME "cases: ${words}" COMMAND ${program} "--source-file=*${path}/*" "--source-file-exclude=*${path}/*/*")
    # A folder that selects no case must not count as passed.
    set_tests_properties("cases: ${words}" PROPERTIES LABELS "${argument_LABELS}" TIMEOUT 1200
      FAIL_REGULAR_EXPRESSION "test cases: +0 ")
  endforeach()
endfunction()
