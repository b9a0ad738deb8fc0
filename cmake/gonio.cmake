# The flags every file is compiled with, the shape of a room, and the instruction sets.

option(GONIO_WERROR "Treat warnings as errors (the test presets do; a newer compiler must not stop a user)" OFF)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
  set(gonio_known_sets sse2 avx2 avx512)
else()
  set(gonio_known_sets native)
endif()
set(GONIO_INSTRUCTION_SETS "${gonio_known_sets}" CACHE STRING
  "Vector units to compile the column kernels for; the best one present is chosen at run time")
set(gonio_flags_avx2 -mavx2 -mfma)
set(gonio_flags_avx512 -mavx2 -mfma -mavx512f -mavx512dq -mavx512bw -mavx512cd -mavx512vl
  -Wno-uninitialized -Wno-maybe-uninitialized)  # g++ 12 warns inside its own AVX-512 headers

find_program(GONIO_CCACHE ccache)
if(GONIO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${GONIO_CCACHE})
endif()

add_library(gonio_flags INTERFACE)
target_compile_features(gonio_flags INTERFACE cxx_std_20)
target_compile_options(gonio_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Wold-style-cast
  -ffp-contract=off             # the same bits for a scalar and for a lane of a batch
  -fno-math-errno               # nobody asks errno after a square root, and loops with one can be vectors
  # g++ 12 raises these for std::string code that is fine
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow>
  $<$<CONFIG:Release>:-O3>
  $<$<BOOL:${GONIO_WERROR}>:-Werror>)

# gonio_room(NAME SOURCES … USES rooms… LIBRARIES others…): a folder as a target with its own
# include root.  Files are included as "room/file.h"; a room that is not in USES is not found.
function(gonio_room name)
  cmake_parse_arguments(room "" "" "SOURCES;USES;LIBRARIES" ${ARGN})
  set(include_root ${CMAKE_CURRENT_BINARY_DIR}/include)
  file(MAKE_DIRECTORY ${include_root})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/${name} SYMBOLIC)
  list(TRANSFORM room_USES PREPEND gonio::)
  if(room_SOURCES)
    add_library(gonio_${name} STATIC ${room_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(gonio_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(gonio_${name} ${scope} ${include_root})
  target_link_libraries(gonio_${name} ${scope} gonio_flags ${room_USES} ${room_LIBRARIES})
  add_library(gonio::${name} ALIAS gonio_${name})
endfunction()
