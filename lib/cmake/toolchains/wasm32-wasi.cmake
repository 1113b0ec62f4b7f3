# WebAssembly with WASI's C library and LLVM's C++ library, which has neither threads nor exceptions: code that throws
# needs lib/wasm/src/no_exceptions.cpp. Debian: clang, lld, llvm, wasi-libc, libclang-rt-14-dev-wasm32 (of clang's
# version), libc++-16-dev-wasm32 and libc++abi-16-dev-wasm32 (or later); nodejs runs it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# The system's archiver writes no index of WebAssembly's objects.
find_program(CMAKE_AR llvm-ar REQUIRED)
find_program(CMAKE_RANLIB llvm-ranlib REQUIRED)
set(CMAKE_CXX_FLAGS_INIT "-fexceptions")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
