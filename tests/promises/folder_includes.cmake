# Which folders of tools and tests include which. check_includes.cmake includes this file and reports `problems`.
cmake_minimum_required(VERSION 3.25)

# check_folder_includes(<root> <row>...): a row is "<folder>: <folder>...", the folders whose files those of the first may include
# in addition to their own. It names folders of earlier rows only, so that no two folders need each other. "." is the root.
function(check_folder_includes top)
  set(earlier "")
  foreach(row IN LISTS ARGN)
    if(NOT row MATCHES "^([^:]+):(.*)$")
      message(FATAL_ERROR "not a row: ${row}")
    endif()
    set(folder ${CMAKE_MATCH_1})
    string(REGEX MATCHALL "[^ ]+" allowed "${CMAKE_MATCH_2}")
    foreach(other IN LISTS allowed)
      if(NOT other IN_LIST earlier)
        list(APPEND problems "the row of ${top}/${folder} names ${other}, which has no earlier row")
      endif()
    endforeach()
    list(APPEND earlier ${folder})
    set(allowed_in_${folder} ${folder} ${allowed})
  endforeach()

  file(GLOB_RECURSE files RELATIVE ${root}/${top} ${root}/${top}/*.hpp ${root}/${top}/*.cpp ${root}/${top}/*.inl ${root}/${top}/*.[ch])
  set(folders "")
  foreach(file IN LISTS files)
    cmake_path(GET file PARENT_PATH folder)
    if(folder STREQUAL "")
      set(folder .)
    endif()
    list(APPEND folders ${folder})
    if(NOT folder IN_LIST earlier)
      continue()
    endif()
    file(STRINGS ${root}/${top}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]*\"")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" name "${line}")
      set(found "")
      foreach(base IN ITEMS ${folder} .)
        if(found STREQUAL "" AND EXISTS ${root}/${top}/${base}/${name})
          cmake_path(SET found NORMALIZE ${base}/${name})
        endif()
      endforeach()
      cmake_path(GET found PARENT_PATH other)
      if(other STREQUAL "")
        set(other .)
      endif()
      if(found STREQUAL "")
        if(NOT name IN_LIST includes_from_elsewhere)
          list(APPEND problems "${top}/${file} includes \"${name}\", which is neither in its folder nor in ${top}")
        endif()
      elseif(NOT other IN_LIST allowed_in_${folder})
        list(APPEND problems "${top}/${file} includes \"${name}\": the row of ${folder} in folder_includes.cmake does not name ${other}")
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    if(NOT folder IN_LIST earlier)
      list(APPEND problems "${top}/${folder} has no row in folder_includes.cmake")
    endif()
  endforeach()
  foreach(folder IN LISTS earlier)
    if(NOT folder IN_LIST folders)
      list(APPEND problems "folder_includes.cmake has a row of ${top}/${folder}, where no sources are")
    endif()
  endforeach()
  set(problems "${problems}" PARENT_SCOPE)
endfunction()

# The command, from what all of it uses to the command line.
check_folder_includes(tools
  "base:"
  "demo:"
  "platform:"
  "platform/posix: platform"
  "platform/windows: platform"
  "import/base: base platform"
  "import/guards: base platform import/base"
  "import/readers: base platform import/base"
  "import/gltf/data: base platform"
  "import/gltf: base import/base import/guards import/gltf/data"
  "import/assimp: base platform import/base import/guards"
  "import: base platform import/base import/guards import/readers import/gltf import/assimp"
  "report: base platform"
  "files: base platform report"
  "layout: base report"
  "bake: base import/base import/guards import report files layout"
  "trade: base import/base report bake"
  "scenes: base import/base report layout bake"
  "query: base report files"
  "render: base files"
  "absent: base import/base import/gltf/data render"
  "commands: base platform import/base import report files layout bake trade scenes query render"
  "command_line: base platform report query commands"
  ".: base platform report commands command_line")

set(includes_from_elsewhere semihosting.hpp)  # of docs/examples/firmware
set(support support support/base support/meshes support/machine support/format support/blobs support/queries support/loops support/answers support/exercise)
list(JOIN support " " support)
check_folder_includes(tests
  "support/base:"
  "support/machine: support/base"
  ".: support/machine"
  "support/meshes: support/base"
  "support/format: support/base"
  "support/blobs: support/base support/meshes support/format"
  "support/queries: support/base support/meshes support/format support/blobs"
  "support: support/base support/machine support/meshes support/format support/blobs support/queries"
  "support/loops: support/base support/format"
  "support/answers: support/base support/machine support/format support/blobs support/queries support/loops"
  "support/exercise: support/base support/machine support/blobs support/queries"
  "oracle: support/base support/machine support/meshes support/format"
  "support/exact: support support/base support/format support/queries oracle"
  "platform:"
  "platform/microsoft:"
  "wasm/answers:"
  "firmware: platform support/base support/meshes"
  "firmware/image: platform firmware"
  "firmware/plugin:"
  "mutation:"
  "package/find_package:"
  "package/program:"
  "sections:"
  "docs: support/meshes"
  "threads: platform"
  "promises: ${support} oracle"
  "c: ${support}"
  "c/baking: ${support} c"
  "runtime/base: ${support} oracle"
  "runtime/blob: ${support}"
  "runtime/lattice: ${support} support/exact oracle platform"
  "runtime/kernels: ${support} support/exact oracle"
  "runtime/traversal: ${support} support/exact oracle platform"
  "runtime/rays: ${support} support/exact oracle platform"
  "runtime/proximity: ${support} support/exact"
  "runtime/overlap: ${support} support/exact oracle"
  "runtime/sweeps: ${support} oracle"
  "runtime/contacts: ${support} support/exact oracle"
  "runtime/transforms: ${support}"
  "runtime/pairs: ${support} support/exact"
  "runtime/scenes: ${support} platform"
  "runtime/moving_scenes: ${support} runtime/scenes"
  "runtime/deformation: ${support} runtime/moving_scenes runtime/pairs"
  "runtime/batches: ${support}"
  "runtime/asset: ${support} oracle"
  "baker: ${support}"
  "baker/base: ${support} baker"
  "baker/input: ${support} baker"
  "baker/quantise: ${support} baker oracle"
  "baker/deformation: ${support} baker"
  "baker/error: ${support} baker"
  "baker/build: ${support} baker"
  "baker/optimise: ${support} baker baker/build"
  "baker/collapse: ${support} baker"
  "baker/sections: ${support} baker oracle"
  "baker/encode: ${support} baker"
  "baker/scenes: ${support} baker"
  "baker/verify: ${support} baker"
  "tools: ${support} baker/quantise")
