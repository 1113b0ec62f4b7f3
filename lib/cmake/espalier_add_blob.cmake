# espalier_add_blob: a blob that is baked when the project is built, as a library to link.
#
#     espalier_add_blob(level MESH level.glb TOLERANCE 0.5mm PROFILE balanced)
#     target_link_libraries(game PRIVATE level)
#
# and in C or C++: #include "level.h", which declares the array level, level_size and, in C++20, level_bytes(), a span.
# docs/embedding.md has the whole list of options. In the order in which they are tried, the command that bakes is
# ESPALIER_EXECUTABLE, the target espalier::espalier, one on the path, one that the build makes of ESPALIER_SOURCES.

cmake_policy(PUSH)
cmake_policy(VERSION 3.25) # ours, whatever the surrounding project sets: it decides how depfiles are read

set(ESPALIER_EXECUTABLE "" CACHE FILEPATH
  "The espalier command that bakes; empty: that of the package, one on the path, or one made of ESPALIER_SOURCES")
set(ESPALIER_SOURCES "" CACHE PATH
  "Espalier's source folder, of which the build makes a command when there is none; empty: where this file lies in one")
set(ESPALIER_HOST_OPTIONS "" CACHE STRING
  "For CMake when it makes that command, a list with semicolons, as in -DCMAKE_CXX_COMPILER=g++;-DCMAKE_BUILD_TYPE=Debug")
mark_as_advanced(ESPALIER_HOST_OPTIONS)
set_property(GLOBAL PROPERTY ESPALIER_BLOB_VERSION "${espalier_VERSION}")

# Each is an option of `espalier bake` by the same name: MAX_BYTES is --max-bytes. But MESH_FORMAT is --format, since FORMAT is that
# of the array.
set_property(GLOBAL PROPERTY ESPALIER_BAKE_FLAGS IDS MATERIALS DEFORMABLE DROP_BAD_TRIANGLES STRICT ALLOW_EMPTY)
set_property(GLOBAL PROPERTY ESPALIER_BAKE_VALUES TOLERANCE BITS STEP LATTICE_OF MAX_BYTES FASTEST_UNDER MAX_ERROR PROFILE LEAF_SIZE
  BYTE_PRICE BUILDER DUPLICATE_BUDGET MESH_FORMAT UNIT SCALE UP ORIGIN FLAT_ANGLE BOUNDS EFFORT THREADS MAX_DROPPED EXPECT_SIZE IMPORT_MEMORY IMPORT_SECONDS
  REMAP REORDER INSTANCES)
set_property(GLOBAL PROPERTY ESPALIER_BAKE_LISTS RANGE POSES) # of several values

function(espalier_add_blob target)
  get_property(bake_flags GLOBAL PROPERTY ESPALIER_BAKE_FLAGS)
  get_property(bake_values GLOBAL PROPERTY ESPALIER_BAKE_VALUES)
  get_property(bake_lists GLOBAL PROPERTY ESPALIER_BAKE_LISTS)
  set(headers_of_c assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign stdarg
    stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype)
  set(lists MESH DEPENDS ${bake_lists})
  set(embed_values SYMBOL SECTION ALIGNMENT)
  cmake_parse_arguments(PARSE_ARGV 1 blob "${bake_flags}" "${bake_values};${embed_values};FORMAT;OUTPUT" "${lists}")
  set(choices MESH DEPENDS ${bake_values} ${bake_lists} ${bake_flags} FORMAT ${embed_values} OUTPUT)
  list(JOIN choices ", " choices)
  foreach(word IN LISTS blob_UNPARSED_ARGUMENTS blob_MESH blob_DEPENDS blob_POSES)
    # what is misspelt after MESH would be one more mesh
    if(word IN_LIST blob_UNPARSED_ARGUMENTS OR (word MATCHES "^[A-Z][A-Z_]+$" AND NOT TARGET ${word}))
      message(FATAL_ERROR "espalier_add_blob(${target}): '${word}' is no option; the options are ${choices}")
    endif()
  endforeach()
  foreach(option IN LISTS lists bake_values embed_values ITEMS FORMAT OUTPUT)
    if(option IN_LIST ARGN AND NOT DEFINED blob_${option}) # an empty value, too: it may come of a misspelt variable
      message(FATAL_ERROR "espalier_add_blob(${target}): ${option} needs a value")
    endif()
  endforeach()
  if(NOT blob_MESH)
    message(FATAL_ERROR "espalier_add_blob(${target}): MESH and at least one mesh file are needed")
  endif()

  if(NOT blob_DEFORMABLE AND (blob_RANGE OR blob_POSES))
    message(FATAL_ERROR "espalier_add_blob(${target}): RANGE and POSES need DEFORMABLE")
  endif()
  list(LENGTH blob_RANGE range_numbers)
  if(DEFINED blob_RANGE AND NOT range_numbers EQUAL 6)
    message(FATAL_ERROR "espalier_add_blob(${target}): RANGE has ${range_numbers} numbers; six are needed, X0 Y0 Z0 X1 Y1 Z1")
  endif()

  if(target IN_LIST headers_of_c)
    message(FATAL_ERROR "espalier_add_blob(${target}): its header would hide <${target}.h>; give the target another name")
  endif()
  if(NOT blob_SYMBOL)
    string(MAKE_C_IDENTIFIER "${target}" blob_SYMBOL)
  endif()
  get_property(symbols GLOBAL PROPERTY ESPALIER_BLOB_SYMBOLS)
  if(blob_SYMBOL IN_LIST symbols)
    message(FATAL_ERROR "espalier_add_blob(${target}): another blob has the symbol ${blob_SYMBOL}; give SYMBOL another name")
  endif()
  set_property(GLOBAL APPEND PROPERTY ESPALIER_BLOB_SYMBOLS ${blob_SYMBOL})

  espalier_blob_command(command made_by)
  # What CMake's Makefiles once read in a depfile they add to for ever: a side file that goes away would be missed in every
  # build. Without this file, which they keep that in, they read the depfiles anew.
  set(forget "")
  if(CMAKE_GENERATOR MATCHES "Makefiles")
    set(forget COMMAND ${CMAKE_COMMAND} -E rm -f ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/compiler_depend.internal)
  endif()
  # A folder for each blob, so that what is included by name is found in one place only.
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/espalier_blobs/${target})
  set(blob ${folder}/${target}.espl)
  if(blob_INSTANCES AND NOT blob_INSTANCES STREQUAL "off")
    set(blob ${folder}/${target}.esps) # a scene
  endif()
  if(blob_OUTPUT)
    cmake_path(ABSOLUTE_PATH blob_OUTPUT BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE OUTPUT_VARIABLE blob)
  endif()
  espalier_blob_source_ending("${target}" "${blob_FORMAT}" ending)
  set(source ${folder}/${target}${ending})
  set(header ${folder}/${target}.h)
  cmake_path(GET blob PARENT_PATH blob_folder)
  file(MAKE_DIRECTORY ${folder} ${blob_folder})

  set(meshes "")
  foreach(mesh IN LISTS blob_MESH)
    cmake_path(ABSOLUTE_PATH mesh BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    list(APPEND meshes ${mesh})
  endforeach()
  set(poses "")
  foreach(pose IN LISTS blob_POSES)
    cmake_path(ABSOLUTE_PATH pose BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    list(APPEND poses ${pose})
  endforeach()
  if(poses)
    set(blob_POSES ${poses})
  endif()
  if(blob_LATTICE_OF) # a target of this function, or a blob as a file
    if(TARGET ${blob_LATTICE_OF})
      get_target_property(neighbour ${blob_LATTICE_OF} ESPALIER_BLOB)
      if(NOT neighbour)
        message(FATAL_ERROR "espalier_add_blob(${target}): LATTICE_OF ${blob_LATTICE_OF} is a target without a blob")
      endif()
      set(blob_LATTICE_OF ${neighbour})
    else()
      cmake_path(ABSOLUTE_PATH blob_LATTICE_OF BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
    endif()
  endif()
  set(bake_outputs ${blob})
  foreach(option IN ITEMS REMAP REORDER) # files beside the blob
    if(blob_${option})
      cmake_path(ABSOLUTE_PATH blob_${option} BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE)
      cmake_path(GET blob_${option} PARENT_PATH option_folder)
      file(MAKE_DIRECTORY ${option_folder})
      list(APPEND bake_outputs ${blob_${option}})
    endif()
  endforeach()
  set(bake_options "")
  foreach(option IN LISTS bake_values bake_lists bake_flags)
    if(DEFINED blob_${option} AND NOT (option IN_LIST bake_flags AND NOT blob_${option}))
      string(TOLOWER "--${option}" name)
      string(REPLACE "_" "-" name ${name})
      string(REPLACE "--mesh-format" "--format" name ${name})
      list(APPEND bake_options ${name})
      if(NOT option IN_LIST bake_flags)
        list(APPEND bake_options ${blob_${option}})
      endif()
    endif()
  endforeach()
  set(embed_options --symbol ${blob_SYMBOL})
  if(DEFINED blob_SECTION)
    list(APPEND embed_options --section ${blob_SECTION})
  endif()
  if(DEFINED blob_ALIGNMENT)
    list(APPEND embed_options --alignment ${blob_ALIGNMENT})
  endif()

  add_custom_command(OUTPUT ${bake_outputs}
    COMMAND ${command} bake ${meshes} -o ${blob} --depfile ${folder}/${target}.d --quiet ${bake_options} ${forget}
    DEPENDS ${meshes} ${poses} ${blob_DEPENDS} ${blob_LATTICE_OF} ${made_by} DEPFILE ${folder}/${target}.d
    COMMENT "Baking ${target}" VERBATIM)
  # The header keeps its time while it stays the same, so it is a byproduct: who includes it is compiled again only then.
  add_custom_command(OUTPUT ${source} BYPRODUCTS ${header}
    COMMAND ${command} embed ${blob} -o ${source} --header ${header} --quiet ${embed_options}
    DEPENDS ${blob} ${made_by}
    COMMENT "Embedding ${target}" VERBATIM)

  add_library(${target} STATIC ${source})
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${folder}>) # nothing of it when installed
  set_target_properties(${target} PROPERTIES ESPALIER_BLOB ${blob})
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  if(ending STREQUAL ".S")
    set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "ESPALIER_BLOB_FILE=\"${blob}\"")
  endif()
endfunction()

# The ending of the source, of which there is one for each language.
function(espalier_blob_source_ending target format ending_variable)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(format STREQUAL "assembler")
    set(ending .S)
    if(NOT "ASM" IN_LIST languages)
      message(FATAL_ERROR "espalier_add_blob(${target}): FORMAT assembler needs ASM among the LANGUAGES of project()")
    endif()
  elseif(NOT format STREQUAL "" AND NOT format STREQUAL "c")
    message(FATAL_ERROR "espalier_add_blob(${target}): FORMAT '${format}' is neither c nor assembler")
  elseif("C" IN_LIST languages)
    set(ending .c)
  elseif("CXX" IN_LIST languages)
    set(ending .cpp)
  else()
    message(FATAL_ERROR "espalier_add_blob(${target}): FORMAT c needs C or CXX among the LANGUAGES of project()")
  endif()
  set(${ending_variable} ${ending} PARENT_SCOPE)
endfunction()

# The command to call, and the files that a blob depends on in addition to its meshes: another command may bake other bytes.
function(espalier_blob_command command_variable depends_variable)
  get_property(version GLOBAL PROPERTY ESPALIER_BLOB_VERSION)
  set(sources "${ESPALIER_SOURCES}")
  if(NOT sources AND EXISTS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../tools/commands/bake.cpp)
    cmake_path(SET sources NORMALIZE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../..)
  endif()
  find_program(ESPALIER_ON_PATH espalier NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(ESPALIER_ON_PATH)
  set(runs_here FALSE)
  if(TARGET espalier::espalier)
    get_target_property(is_imported espalier::espalier IMPORTED)
    if(is_imported OR NOT CMAKE_CROSSCOMPILING)
      set(runs_here TRUE)
    endif()
  endif()

  if(ESPALIER_EXECUTABLE)
    espalier_command_version("${ESPALIER_EXECUTABLE}" found)
    if(NOT found)
      message(FATAL_ERROR "ESPALIER_EXECUTABLE is ${ESPALIER_EXECUTABLE}, which does not run here as espalier --version")
    endif()
    if(version AND NOT found STREQUAL version)
      message(FATAL_ERROR "ESPALIER_EXECUTABLE is ${ESPALIER_EXECUTABLE}, of version '${found}'; this is ${version}")
    endif()
    set(command ${ESPALIER_EXECUTABLE})
    set(depends ${ESPALIER_EXECUTABLE})
  elseif(runs_here)
    set(command espalier::espalier)
    set(depends espalier::espalier)
  else()
    set(found "")
    if(ESPALIER_ON_PATH)
      espalier_command_version("${ESPALIER_ON_PATH}" found)
    endif()
    if(found AND (NOT version OR found STREQUAL version))
      set(command ${ESPALIER_ON_PATH})
      set(depends ${ESPALIER_ON_PATH})
    elseif(sources)
      espalier_command_of_sources("${sources}" command)
      set(depends ${command} espalier_for_this_machine)
    else()
      message(FATAL_ERROR "espalier_add_blob: there is no command ${version} to bake with. Set ESPALIER_EXECUTABLE to one, \
install the component 'tools', or set ESPALIER_SOURCES to the source folder, of which the build then makes one")
    endif()
  endif()
  set(${command_variable} ${command} PARENT_SCOPE)
  set(${depends_variable} ${depends} PARENT_SCOPE)
endfunction()

function(espalier_command_version executable version_variable)
  execute_process(COMMAND ${executable} --version OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE result)
  string(REGEX MATCH "^espalier ([0-9.]+)" matched "${output}")
  set(${version_variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# A command for the machine that builds, made by a build of its own: with another compiler in a cross build, and optimised
# whatever the project around is.
function(espalier_command_of_sources sources executable_variable)
  set(folder ${CMAKE_BINARY_DIR}/espalier_for_this_machine)
  set(executable ${folder}/tools/espalier)
  set(${executable_variable} ${executable} PARENT_SCOPE)
  if(TARGET espalier_for_this_machine)
    return()
  endif()
  message(STATUS "espalier: the build makes a command for this machine in ${folder}")
  set(environment "")
  set(options -DCMAKE_BUILD_TYPE=Release -DESPALIER_TOOLS=ON -DESPALIER_TESTS=OFF -DESPALIER_BENCH=OFF
    -DESPALIER_PRECOMPILE_HEADERS=ON)
  if(DEFINED ESPALIER_COMMAND_PARTS) # also none
    list(JOIN ESPALIER_COMMAND_PARTS "$<SEMICOLON>" parts) # one word of a command
    list(APPEND options "-DESPALIER_COMMAND_PARTS=${parts}")
  endif()
  if(CMAKE_CROSSCOMPILING)
    foreach(variable IN ITEMS CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CMAKE_TOOLCHAIN_FILE PKG_CONFIG_PATH
        PKG_CONFIG_LIBDIR PKG_CONFIG_SYSROOT_DIR)
      list(APPEND environment --unset=${variable})
    endforeach()
  elseif(CMAKE_CXX_COMPILER)
    list(APPEND options -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER})
  endif()
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    list(APPEND options "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  set(build ${CMAKE_COMMAND} --build ${folder} --target espalier_command)
  set(generator ${CMAKE_GENERATOR})
  if(CMAKE_GENERATOR MATCHES "Makefiles")
    set(build $(MAKE) -C ${folder} espalier_command) # shares the jobs of the make around
  elseif(CMAKE_GENERATOR MATCHES "Ninja")
    set(generator Ninja)
  endif()
  include(ExternalProject)
  # Built always: only that build finds whether its sources have changed. It takes minutes, so Ninja shows its output.
  ExternalProject_Add(espalier_for_this_machine EXCLUDE_FROM_ALL TRUE BUILD_ALWAYS TRUE USES_TERMINAL_BUILD TRUE
    PREFIX ${folder}/steps SOURCE_DIR ${sources} BINARY_DIR ${folder}
    CONFIGURE_COMMAND ${CMAKE_COMMAND} -E env ${environment}
      ${CMAKE_COMMAND} -S ${sources} -B ${folder} -G ${generator} ${options} ${ESPALIER_HOST_OPTIONS}
    BUILD_COMMAND ${CMAKE_COMMAND} -E env ${environment} ${build}
    BUILD_BYPRODUCTS ${executable} INSTALL_COMMAND "")
endfunction()

cmake_policy(POP)
