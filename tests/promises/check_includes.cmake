# Who may include what: the walls of the house (docs/architecture.md).
# cmake -D root=<project> -P check_includes.cmake
cmake_minimum_required(VERSION 3.25)
set(problems "")

# check(<what> <allowed> <files...>): every include of the files matches the regular expression.
function(check what allowed)
  foreach(file IN LISTS ARGN)
    file(STRINGS ${file} includes REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*([<\"][^>\"]*[>\"]).*" "\\1" name "${line}")
      if(NOT name MATCHES "^(${allowed})$")
        file(RELATIVE_PATH shown ${root} ${file})
        list(APPEND problems "${shown} includes ${name}: ${what}")
      endif()
    endforeach()
  endforeach()
  set(problems "${problems}" PARENT_SCOPE)
endfunction()

set(plain_headers "<(array|bit|cfloat|climits|compare|concepts|cstddef|cstdint|limits|span|type_traits|utility)>")
set(machine_headers "<(immintrin|nmmintrin|x86gprintrin|avxintrin|avx2intrin|fmaintrin|arm_neon|wasm_simd128|arm_acle|cpuid)\\.h>")
set(standard_headers "<[a-z_0-9]+(\\.h)?>")

file(GLOB public_headers ${root}/lib/espalier/*.hpp ${root}/lib/espalier/format/*.hpp ${root}/lib/espalier/scenes/*.hpp ${root}/lib/espalier/batches/*.hpp)
set(baker_headers ${root}/lib/espalier/bake.hpp)
list(REMOVE_ITEM public_headers ${baker_headers})
check("a public header of the runtime includes public headers and freestanding ones only"
  "<espalier/((base|format|scenes|batches)/)?[a-z_]+\\.hpp>|${plain_headers}" ${public_headers})
check("a public header of the baker includes public and standard headers only"
  "<espalier/((base|scenes)/)?[a-z_]+\\.hpp>|${standard_headers}" ${baker_headers})
file(GLOB_RECURSE c_headers ${root}/lib/espalier/*.h)
check("a header for C includes headers for C and freestanding ones only" "<espalier/c/((scenes|batches)/)?[a-z_]+\\.h>|<std(bool|def|int)\\.h>" ${c_headers})
foreach(header IN LISTS public_headers)
  file(STRINGS ${header} baking REGEX "include.*espalier/bake\\.hpp")
  if(baking)
    list(APPEND problems "${header} includes a header of the baker")
  endif()
endforeach()

file(GLOB_RECURSE runtime ${root}/lib/runtime/*.hpp ${root}/lib/runtime/*.inl ${root}/lib/runtime/*.cpp)
check("the runtime includes public headers, its own and freestanding ones only"
  "<espalier/[a-ac-z_][a-z_]*\\.hpp>|<espalier/(blob|bounds|(base|scenes|batches)/[a-z_]+)\\.hpp>|<espalier/espalier\\.h>|<runtime/[a-z_0-9/]+\\.(hpp|inl)>|${plain_headers}|${machine_headers}" ${runtime})

# check_layers(<library> <others> <row>...): a row is "<folder>: <folder>...", the folders of lib/<library> whose files those of the
# first may include in addition to their own. It names folders of earlier rows only, so that no two folders need each other.
# <others>, a regular expression, is what all of them may also include.
function(check_layers library others)
  set(earlier "")
  foreach(row IN LISTS ARGN)
    if(NOT row MATCHES "^([^:]+):(.*)$")
      message(FATAL_ERROR "not a row: ${row}")
    endif()
    set(folder ${CMAKE_MATCH_1})
    string(REGEX MATCHALL "[^ ]+" allowed "${CMAKE_MATCH_2}")
    foreach(other IN LISTS allowed)
      if(NOT other IN_LIST earlier)
        list(APPEND problems "the row of lib/${library}/${folder} names ${other}, which has no earlier row")
      endif()
    endforeach()
    list(APPEND earlier ${folder})
    set(folder_and_allowed ${folder} ${allowed})
    set(folder_files ${root}/lib/${library}/${folder})
    file(GLOB files ${folder_files}/*.hpp ${folder_files}/*.inl ${folder_files}/*.cpp)
    if(NOT files)
      list(APPEND problems "check_includes.cmake has a row of lib/${library}/${folder}, where no sources are")
    endif()
    list(JOIN folder_and_allowed "|" folders)
    check("the row of lib/${library}/${folder} in check_includes.cmake does not allow that"
      "<${library}/(${folders})/[a-z_0-9]+\\.(hpp|inl)>|${others}" ${files})
  endforeach()
  file(GLOB_RECURSE files RELATIVE ${root}/lib/${library} ${root}/lib/${library}/*.hpp ${root}/lib/${library}/*.inl
    ${root}/lib/${library}/*.cpp)
  foreach(file IN LISTS files)
    cmake_path(GET file PARENT_PATH folder)
    if(NOT folder STREQUAL "" AND NOT folder IN_LIST earlier)
      list(APPEND problems "lib/${library}/${folder} has no row in check_includes.cmake")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES problems)
  set(problems "${problems}" PARENT_SCOPE)
endfunction()

# The runtime's folders, from numbers to the families of queries.
set(walks "base lattice kernels blob lanes answers traversal")
check_layers(runtime "<espalier/((base|scenes|batches)/)?[a-z_]+\\.h(pp)?>|${plain_headers}|${machine_headers}"
  "base:"
  "lattice: base"
  "kernels: base lattice"
  "blob: base lattice"
  "lanes: base lattice blob"
  "answers: base lattice kernels blob"
  "traversal: base lattice kernels blob lanes answers"
  "open: base blob traversal"
  "rays: ${walks}"
  "rays/batch: ${walks} rays"
  "rays/small_code: ${walks} rays"
  "proximity: ${walks}"
  "overlap: ${walks} proximity"
  "sweeps: ${walks} rays proximity"
  "transforms: base"
  "pairs: ${walks} transforms"
  "scenes: ${walks} open rays proximity sweeps transforms"
  "moving_scenes/box_tree: base blob lanes traversal transforms"
  "moving_scenes: base lattice lanes proximity scenes pairs transforms moving_scenes/box_tree"
  "deformation: base lattice blob"
  "asset: base lattice blob traversal"
  "contacts: ${walks} transforms pairs asset"
  "instruction_sets: ${walks} rays rays/batch proximity overlap sweeps pairs scenes moving_scenes moving_scenes/box_tree"
  "batches: base"
  "c: moving_scenes")

# The baker's folders, in the order of its stages.
check_layers(baker "<espalier/((base|scenes)/)?[a-z_]+\\.hpp>|<espalier/c/bake\\.h>|<runtime/(base|lattice|blob)/[a-z_0-9]+\\.hpp>|${standard_headers}"
  "base:"
  "input: base"
  "quantise: base input"
  "build: base input quantise"
  "error: base input quantise build"
  "deformation: base input quantise build error"
  "optimise: base input quantise build"
  "collapse: base input quantise build"
  "sections: base input quantise build collapse"
  "encode: base input quantise build collapse sections"
  "verify: base input quantise build collapse sections"
  "scenes: base build optimise collapse encode verify"
  "c: base")

file(GLOB baker ${root}/lib/baker/*.hpp ${root}/lib/baker/*.cpp)
check("a file of the baker's root includes public and standard headers and the baker's own only"
  "<espalier/((base|scenes)/)?[a-z_]+\\.hpp>|<baker/([a-z]+/)?[a-z_0-9]+\\.hpp>|${standard_headers}" ${baker})
# The baker's own reader testifies to what the rest of it writes and the runtime reads.
file(GLOB witness ${root}/lib/baker/verify/decode_*.?pp ${root}/lib/baker/verify/check_tree.?pp ${root}/lib/baker/verify/field_reader.hpp)
check("the baker's own reader includes the format and its own files only"
  "<espalier/(format|base/function_ref)\\.hpp>|<baker/verify/(check_tree|decode_tree|field_reader)\\.hpp>|${standard_headers}" ${witness})
list(LENGTH witness witness_count)
if(witness_count LESS 6)
  list(APPEND problems "only ${witness_count} files of the baker's own reader found")
endif()

foreach(folder IN ITEMS lib tests fuzz bench)
  file(GLOB_RECURSE files ${root}/${folder}/*.hpp ${root}/${folder}/*.inl ${root}/${folder}/*.cpp)
  # The benchmark of loading compares with meshoptimizer's codec itself.
  list(REMOVE_ITEM files ${root}/bench/load/meshopt_file.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} strangers REGEX "^[ \t]*#[ \t]*include[ \t]*<(assimp/|draco/|meshoptimizer)")
    if(strangers)
      list(APPEND problems "${file} includes an importer's library: only tools/ may")
    endif()
  endforeach()
endforeach()
foreach(folder IN ITEMS lib tools fuzz bench)
  file(GLOB_RECURSE files ${root}/${folder}/*.hpp ${root}/${folder}/*.inl ${root}/${folder}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} strangers REGEX "^[ \t]*#[ \t]*include[ \t]*<(Eigen/|gmp)")
    if(strangers)
      list(APPEND problems "${file} includes Eigen or GMP: only tests/ may")
    endif()
  endforeach()
endforeach()
# Headers that take seconds to compile stand behind narrow ones of the command.
file(GLOB_RECURSE files RELATIVE ${root}/tools ${root}/tools/*.hpp ${root}/tools/*.cpp)
list(REMOVE_ITEM files command_line/verb.cpp command_line/usage_error.cpp report/json.cpp import/gltf/data/json.cpp)
foreach(file IN LISTS files)
  file(STRINGS ${root}/tools/${file} heavy REGEX "^[ \t]*#[ \t]*include[ \t]*<(CLI/|nlohmann/json\\.hpp)")
  if(heavy)
    list(APPEND problems "tools/${file} includes CLI11 or JSON: only verb.cpp, usage_error.cpp and the two json.cpp may")
  endif()
endforeach()
# The oracle is a second opinion: it must not know the code that it judges.
file(GLOB oracle ${root}/tests/oracle/big_integer.* ${root}/tests/oracle/rational.* ${root}/tests/oracle/exact_geometry.*)
foreach(file IN LISTS oracle)
  file(STRINGS ${file} strangers REGEX "^[ \t]*#[ \t]*include[ \t]*<(espalier|runtime)/")
  if(strangers)
    list(APPEND problems "${file} includes the code that it is the oracle for")
  endif()
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/folder_includes.cmake)

list(LENGTH runtime runtime_count)
if(runtime_count LESS 150)
  list(APPEND problems "only ${runtime_count} files seen in lib/runtime: is ${root} the project?")
endif()
if(problems)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "includes through walls:\n  ${text}")
endif()
message(STATUS "every include respects the walls")
