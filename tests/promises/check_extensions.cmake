# What compilers have beyond the standards is in one header for C++ and one for C. Assembly is left: the instructions of processors.
# cmake -D root=<project> -P check_extensions.cmake
cmake_minimum_required(VERSION 3.25)
set(problems "")
file(GLOB_RECURSE files ${root}/lib/espalier/*.h* ${root}/lib/runtime/*.hpp ${root}/lib/runtime/*.inl ${root}/lib/runtime/*.cpp)
list(REMOVE_ITEM files ${root}/lib/espalier/base/compiler.hpp ${root}/lib/espalier/c/attributes.h)
foreach(file IN LISTS files)
  # std::bit_cast is this builtin function, which all compilers have.
  file(STRINGS ${file} lines REGEX "__attribute__|__declspec|gnu::|__extension__|_Pragma|#pragma [a-np-zA-Z]|__builtin_[ac-z]|__builtin_b[a-hj-z]")
  foreach(line IN LISTS lines)
    file(RELATIVE_PATH shown ${root} ${file})
    list(APPEND problems "${shown} has an extension of a compiler, which belongs in compiler.hpp: ${line}")
  endforeach()
endforeach()
if(NOT files OR problems)
  list(JOIN problems "\n" problems)
  message(FATAL_ERROR "${problems}")
endif()
