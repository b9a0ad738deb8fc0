# clang-22 for WASI, for CMake: Ceres is built with it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-22)
set(CMAKE_CXX_COMPILER clang++-22)
set(CMAKE_AR llvm-ar-22)
set(CMAKE_RANLIB llvm-ranlib-22)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# The same bytes wherever the project lies: asserts name their file.
get_filename_component(project ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set(flags "-ffile-prefix-map=${project}/= --target=wasm32-wasi -Wno-deprecated -w -DNDEBUG -ffp-contract=off -fno-math-errno -fwasm-exceptions -DEIGEN_MPL2_ONLY")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags} -include ${CMAKE_CURRENT_LIST_DIR}/shim/one_thread.h -isystem ${CMAKE_CURRENT_LIST_DIR}/shim")
