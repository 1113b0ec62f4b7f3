# `cpack` in the build folder makes three Debian packages of what is installed: libespalier-dev, the libraries and headers, which
# depends on nothing; libespalier-import-dev, the library that reads mesh files, which depends on those that it links; and espalier, the
# command, which depends on what it is linked to.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME espalier)
set(CPACK_PACKAGE_VENDOR "The Espalier authors")
set(CPACK_PACKAGE_CONTACT "The Espalier authors <authors@espalier.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libespalier-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "espalier (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_IMPORT_PACKAGE_NAME libespalier-import-dev)
set(CPACK_DEBIAN_IMPORT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_IMPORT_PACKAGE_DEPENDS "libespalier-dev (= ${PROJECT_VERSION})")
foreach(part_and_package IN ITEMS "3mf|libexpat1-dev, zlib1g-dev" "assimp|libassimp-dev" "draco|libdraco-dev" "meshoptimizer|libmeshoptimizer-dev")
  string(REGEX MATCH "(.*)\\|(.*)" _ "${part_and_package}")
  if(CMAKE_MATCH_1 IN_LIST ESPALIER_COMMAND_PARTS)
    string(APPEND CPACK_DEBIAN_IMPORT_PACKAGE_DEPENDS ", ${CMAKE_MATCH_2}")
  endif()
endforeach()
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME espalier)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Baked collision meshes, queried straight from their bytes: libraries")
set(CPACK_COMPONENT_IMPORT_DESCRIPTION "Baked collision meshes, queried straight from their bytes: reader of mesh files")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Bakes collision meshes and queries them: the command")

# Files that only Debian packages need: the changelog, the copyright and the manual. `cmake --install` leaves them out.
find_program(ESPALIER_GZIP gzip)
mark_as_advanced(ESPALIER_GZIP)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH where it is set
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/package/changelog CONTENT
"espalier (@PROJECT_VERSION@) unstable; urgency=medium

  * The changes are in docs/changelog.md of the source.

 -- @CPACK_PACKAGE_CONTACT@  @now@
" @ONLY)

# The licence in Debian's format: each line is indented, and a dot stands for an empty one.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]+)\n\n(.+)\n$" licence "${licence}")
set(holder "${CMAKE_MATCH_1}")
string(REPLACE "\n\n" "\n.\n" licence "${CMAKE_MATCH_2}")
string(REPLACE "\n" "\n " licence "${licence}")
string(TIMESTAMP year "%Y" UTC)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/package/copyright CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: @year@ @holder@
License: Expat
 @licence@
" @ONLY)

# install_compressed(<component> <file> <destination>)
function(install_compressed component file destination)
  install(CODE "
    set(compressed \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${destination}\")
    cmake_path(GET compressed PARENT_PATH folder)
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"${ESPALIER_GZIP}\" -9nc \"${file}\" OUTPUT_FILE \"\${compressed}\" COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

foreach(package_and_component IN ITEMS libespalier-dev|dev libespalier-import-dev|import espalier|tools)
  string(REGEX MATCH "(.*)\\|(.*)" _ ${package_and_component})
  set(package ${CMAKE_MATCH_1})
  set(component debian_${CMAKE_MATCH_2})
  install(FILES ${PROJECT_BINARY_DIR}/package/copyright DESTINATION share/doc/${package}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  install_compressed(${component} ${PROJECT_BINARY_DIR}/package/changelog share/doc/${package}/changelog.gz)
endforeach()
install_compressed(debian_tools ${PROJECT_SOURCE_DIR}/tools/espalier.1 share/man/man1/espalier.1.gz)

set(CPACK_COMPONENTS_ALL runtime baker import tools debian_dev debian_import debian_tools)
set(CPACK_COMPONENT_RUNTIME_GROUP dev)
set(CPACK_COMPONENT_BAKER_GROUP dev)
set(CPACK_COMPONENT_DEBIAN_DEV_GROUP dev)
set(CPACK_COMPONENT_IMPORT_GROUP import)
set(CPACK_COMPONENT_DEBIAN_IMPORT_GROUP import)
set(CPACK_COMPONENT_TOOLS_GROUP tools)
set(CPACK_COMPONENT_DEBIAN_TOOLS_GROUP tools)
include(CPack)
