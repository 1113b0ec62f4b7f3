# The libraries that the command is built with or without, by ESPALIER_COMMAND_PARTS. Sets the sources and libraries of
# each: ESPALIER_<NAME>_SOURCES and ESPALIER_<NAME>_LIBRARIES.
set(known_parts 3mf assimp draco meshoptimizer png)
foreach(part IN LISTS ESPALIER_COMMAND_PARTS)
  if(NOT part IN_LIST known_parts)
    message(FATAL_ERROR "ESPALIER_COMMAND_PARTS names '${part}', which is none of: ${known_parts}")
  endif()
endforeach()

# espalier_part(<name> <packages> <libraries> <source>...): the sources where the command has the part, else
# absent/<name>.cpp
function(espalier_part name packages libraries_of_part)
  string(TOUPPER ${name} prefix)
  set(sources absent/${name}.cpp)
  set(libraries "")
  if(name IN_LIST ESPALIER_COMMAND_PARTS)
    foreach(package IN LISTS packages)
      find_package(${package} REQUIRED)
    endforeach()
    set(sources ${ARGN})
    set(libraries ${libraries_of_part})
  elseif(ESPALIER_TESTS)
    message(FATAL_ERROR "ESPALIER_COMMAND_PARTS lacks ${name}, which tests of the command need. Set ESPALIER_TESTS to OFF")
  endif()
  list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/)
  set(ESPALIER_${prefix}_SOURCES ${sources} PARENT_SCOPE)
  set(ESPALIER_${prefix}_LIBRARIES ${libraries} PARENT_SCOPE)
endfunction()

espalier_part(3mf "EXPAT;ZLIB" "EXPAT::EXPAT;ZLIB::ZLIB"
  import/3mf/extensions.cpp
  import/3mf/importer.cpp
  import/3mf/model.cpp
  import/3mf/package.cpp
  import/3mf/xml.cpp
  import/3mf/zip_archive.cpp)
espalier_part(assimp assimp assimp::assimp
  import/assimp/hidden_defects.cpp
  import/assimp/importer.cpp
  import/assimp/log.cpp
  import/assimp/opened_files.cpp
  import/assimp/scene.cpp)
espalier_part(draco draco draco::draco import/gltf/data/draco.cpp)
espalier_part(meshoptimizer meshoptimizer meshoptimizer::meshoptimizer import/gltf/data/meshopt.cpp)
espalier_part(png PNG PNG::PNG render/png.cpp)
