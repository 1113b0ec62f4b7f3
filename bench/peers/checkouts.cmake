# Peers that Debian does not package, as `git clone` names their folders: each is measured where its folder is.
set(ESPALIER_CHECKOUTS "" CACHE PATH "A folder with checkouts of embree (4), JoltPhysics, box3d and tinybvh, to measure them too")

# checkout(FOLDER): sets `checkout` to the folder, or to nothing
macro(checkout folder)
  set(checkout "")
  if(ESPALIER_CHECKOUTS AND EXISTS ${ESPALIER_CHECKOUTS}/${folder})
    set(checkout ${ESPALIER_CHECKOUTS}/${folder})
  elseif(ESPALIER_CHECKOUTS)
    message(STATUS "bench: no ${ESPALIER_CHECKOUTS}/${folder}")
  endif()
endmacro()

# Versions 3 and 4 have functions of the same names. The fourth becomes a part of a library that shows only its adapter. Of
# its geometries the scenes have triangles and instances, asked ray by ray; all of it takes two cores an hour to compile.
checkout(embree)
if(checkout)
  include(ExternalProject)
  find_package(Threads REQUIRED)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embree4)
  set(archives embree4 embree_sse42 embree_avx embree_avx2 embree_avx512 sys math simd lexers tasking)
  list(TRANSFORM archives REPLACE "(.+)" "${folder}/lib\\1.a")
  ExternalProject_Add(espalier_bench_embree4_build SOURCE_DIR ${checkout} BINARY_DIR ${folder} INSTALL_COMMAND ""
    CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DEMBREE_STATIC_LIB=ON -DEMBREE_TUTORIALS=OFF -DEMBREE_TASKING_SYSTEM=INTERNAL
      -DEMBREE_GEOMETRY_CURVE=OFF -DEMBREE_GEOMETRY_GRID=OFF -DEMBREE_GEOMETRY_POINT=OFF -DEMBREE_GEOMETRY_QUAD=OFF
      -DEMBREE_GEOMETRY_SUBDIVISION=OFF -DEMBREE_GEOMETRY_USER=OFF -DEMBREE_RAY_PACKETS=OFF -DEMBREE_MAX_ISA=AVX512
      -DCMAKE_ARCHIVE_OUTPUT_DIRECTORY=${folder} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
    BUILD_BYPRODUCTS ${archives})
  add_library(espalier_bench_embree4 SHARED peers/embree_system.cpp)
  add_dependencies(espalier_bench_embree4 espalier_bench_embree4_build)
  target_compile_definitions(espalier_bench_embree4 PRIVATE ESPALIER_BENCH_IS_EMBREE4)
  target_include_directories(espalier_bench_embree4 PRIVATE
    $<TARGET_PROPERTY:espalier_bench_program,INTERFACE_INCLUDE_DIRECTORIES>)
  target_include_directories(espalier_bench_embree4 SYSTEM PRIVATE ${checkout}/include)
  set_target_properties(espalier_bench_embree4 PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(espalier_bench_embree4 PRIVATE
    $<TARGET_PROPERTY:espalier_bench_program,INTERFACE_LINK_LIBRARIES> ${archives} Threads::Threads)
  target_link_options(espalier_bench_embree4 PRIVATE -Wl,--exclude-libs,ALL)
  espalier_compile_options(espalier_bench_embree4)
  peer(EMBREE4 TRUE "" "" espalier_bench_embree4)
endif()

checkout(tinybvh)
if(checkout)
  peer(TINYBVH TRUE "" ${checkout})
  set_source_files_properties(peers/tinybvh_system.cpp PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma" SKIP_PRECOMPILE_HEADERS ON)
endif()

checkout(JoltPhysics)
if(checkout)
  set(PROFILER_IN_DEBUG_AND_RELEASE OFF)  # Jolt's options; as its distribution is built
  set(DEBUG_RENDERER_IN_DEBUG_AND_RELEASE OFF)
  set(ENABLE_OBJECT_STREAM OFF)
  set(INTERPROCEDURAL_OPTIMIZATION OFF)
  add_subdirectory(${checkout}/Build ${CMAKE_CURRENT_BINARY_DIR}/jolt EXCLUDE_FROM_ALL SYSTEM)
  set_source_files_properties(engines/jolt.cpp engines/jolt_test.cpp peers/jolt_system.cpp ../docs/examples/engines/jolt_shape.cpp
    PROPERTIES COMPILE_OPTIONS -fno-rtti)  # as Jolt is compiled
  peer(JOLT TRUE "" "" Jolt)
  target_include_directories(espalier_bench_with_JOLT INTERFACE ${PROJECT_SOURCE_DIR}/docs/examples)
endif()

checkout(box3d)
if(checkout)
  enable_language(C)
  add_subdirectory(${checkout}/src ${CMAKE_CURRENT_BINARY_DIR}/box3d EXCLUDE_FROM_ALL SYSTEM)
  target_compile_options(box3d PRIVATE -ffp-contract=off)  # which the file above its folder says
  peer(BOX3D TRUE "" "" box3d)
endif()
