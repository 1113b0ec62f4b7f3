# What `cmake --install` puts where, in components: `runtime` needs nothing, `baker` needs the runtime and threads, `import`
# needs the baker and the libraries that read formats, `shared` is a library of runtime and baker for other languages, whose headers
# come with the others, `tools` is the command. Everything is found relative to
# where the package lies, which may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/espalier)

# install_part(<component> <target>): the target and the file that names it to find_package.
function(install_part component target)
  install(TARGETS ${target} EXPORT espalier_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT espalier_${component} NAMESPACE espalier:: FILE espalier-${component}.cmake
    DESTINATION ${package_folder} COMPONENT ${component})
endfunction()

# install_pkg_config(<component> <name>): a .pc file that finds its prefix from its own place.
function(install_pkg_config component name)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
    BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE prefix_from_here)
  cmake_path(APPEND libdir "\${prefix}" "${CMAKE_INSTALL_LIBDIR}")  # or that alone, where it is absolute
  cmake_path(APPEND includedir "\${prefix}" "${CMAKE_INSTALL_INCLUDEDIR}")
  configure_file(${PROJECT_SOURCE_DIR}/lib/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()

# What a program that reads files links too, by the parts of this build: for find_package and for pkg-config.
set(import_packages "")
set(import_requires "espalier-baker = ${PROJECT_VERSION}")
set(import_libraries "")
foreach(part IN LISTS ESPALIER_COMMAND_PARTS)
  if(part STREQUAL "3mf")
    list(APPEND import_packages EXPAT ZLIB)
    string(APPEND import_requires ", expat, zlib")
  elseif(part MATCHES "^(assimp|draco)$")
    list(APPEND import_packages ${part})
    string(APPEND import_requires ", ${part}")
  elseif(part STREQUAL "meshoptimizer")
    list(APPEND import_packages ${part})
    string(APPEND import_libraries " -lmeshoptimizer")  # it has no file for pkg-config
  endif()
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/lib/cmake/espalier-config.cmake.in
  ${PROJECT_BINARY_DIR}/package/espalier-config.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the API. The command serves builds for any machine, so the configuration file itself
# refuses libraries of another one, part by part.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/espalier-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${PROJECT_BINARY_DIR}/package/espalier-config.cmake
  ${PROJECT_BINARY_DIR}/package/espalier-config-version.cmake
  ${PROJECT_SOURCE_DIR}/lib/cmake/espalier_add_blob.cmake
  DESTINATION ${package_folder} COMPONENT runtime)

install_part(runtime espalier_runtime)
install_pkg_config(runtime espalier)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/espalier DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT runtime
  FILES_MATCHING PATTERN *.hpp PATTERN *.h PATTERN bake.hpp EXCLUDE PATTERN import.hpp EXCLUDE PATTERN c/bake.h EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

if(TARGET espalier_baker)
  install_part(baker espalier_baker)
  install_pkg_config(baker espalier-baker)
  install(FILES ${PROJECT_SOURCE_DIR}/lib/espalier/bake.hpp
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier COMPONENT baker)
  install(FILES ${PROJECT_SOURCE_DIR}/lib/espalier/scenes/bake.hpp
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier/scenes COMPONENT baker)
  install(FILES ${PROJECT_SOURCE_DIR}/lib/espalier/c/bake.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier/c COMPONENT baker)
endif()

if(TARGET espalier_import)
  install_part(import espalier_import)
  install_pkg_config(import espalier-import)
  install(FILES ${PROJECT_SOURCE_DIR}/lib/espalier/import.hpp
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier COMPONENT import)
endif()

if(TARGET espalier_shared)
  install_part(shared espalier_shared)
  install_pkg_config(shared espalier-shared)
endif()

if(TARGET espalier_command)
  install_part(tools espalier_command)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/espalier COMPONENT tools)
endif()

if(PROJECT_IS_TOP_LEVEL AND TARGET espalier_baker AND TARGET espalier_command)
  include(lib/cmake/debian.cmake)
endif()
