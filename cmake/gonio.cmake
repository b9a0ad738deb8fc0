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
  # Without being told so it does not keep what was compiled from a precompiled header.  Paths below the project count as
  # relative: a second clone finds what the first compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${GONIO_CCACHE})
endif()

# The same objects make the program and modules that other programs load.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

add_library(gonio_flags INTERFACE)
target_compile_features(gonio_flags INTERFACE cxx_std_20)
target_compile_options(gonio_flags INTERFACE
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wdouble-promotion;-Wold-style-cast>"
  -ffp-contract=off             # the same bits for a scalar and for a lane of a batch
  -fno-semantic-interposition   # a function may be inlined although a library could be asked for another of its name
  -fno-math-errno               # nobody asks errno after a square root, and loops with one can be vectors
  # g++ 12 raises these for std::string code that is fine
  "$<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow>>"
  $<BUILD_INTERFACE:$<$<CONFIG:Release>:-O3>>
  $<BUILD_INTERFACE:$<$<BOOL:${GONIO_WERROR}>:-Werror>>)
install(TARGETS gonio_flags EXPORT gonio)
set_target_properties(gonio_flags PROPERTIES EXPORT_NAME flags)

# gonio_room(ROOM USES rooms… LIBRARIES what its headers show… PRIVATE what they do not…): the folder ROOM, as
# "brdf/formula", as a target with its own include root.  Its sources are all .cpp files in it; its headers are
# included as "brdf/formula/ndf.h"; those of a room that is not in USES, nor used by one that is, are not found.
function(gonio_room room)
  cmake_parse_arguments(room "" "" "SOURCES;USES;LIBRARIES;PRIVATE" ${ARGN})
  string(REPLACE / _ name gonio_${room})
  list(TRANSFORM room_USES REPLACE / _)
  list(TRANSFORM room_USES PREPEND gonio_)
  set(here ${PROJECT_SOURCE_DIR}/${room})
  if(NOT IS_DIRECTORY ${here})
    set(here ${PROJECT_SOURCE_DIR}/src/${room})
  endif()

  # A link for each header, not one for the folder: through that, the rooms within would be found, too.
  set(include_root ${PROJECT_BINARY_DIR}/include/${name})
  file(REMOVE_RECURSE ${include_root})
  file(MAKE_DIRECTORY ${include_root}/${room})
  file(GLOB headers CONFIGURE_DEPENDS ${here}/*.h ${here}/*.inc)
  foreach(header ${headers})
    get_filename_component(file ${header} NAME)
    file(CREATE_LINK ${header} ${include_root}/${room}/${file} SYMBOLIC)
  endforeach()

  file(GLOB sources CONFIGURE_DEPENDS ${here}/*.cpp)
  if(room_SOURCES)
    set(sources ${room_SOURCES})
  endif()
  if(sources)
    add_library(${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${name} PRIVATE ${room_PRIVATE})
    if(fmt::fmt IN_LIST room_LIBRARIES)
      set(headers_of gonio_headers)
      if(nlohmann_json::nlohmann_json IN_LIST room_LIBRARIES)
        set(headers_of gonio_json_headers)
      endif()
      target_link_libraries(${name} PRIVATE ${gonio_headers_libraries})
      target_precompile_headers(${name} REUSE_FROM ${headers_of})
    endif()
  else()
    add_library(${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${name} ${scope} $<BUILD_INTERFACE:${include_root}> $<INSTALL_INTERFACE:include/gonio>)
  target_link_libraries(${name} ${scope} gonio_flags ${room_USES} ${room_LIBRARIES})
  if(NOT room MATCHES "^(reports|validate|cli)")  # pages and words are the program's own
    string(REGEX REPLACE "^gonio_" "" exported ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${exported})
    install(TARGETS ${name} EXPORT gonio ARCHIVE COMPONENT development)
    install(FILES ${headers} DESTINATION include/gonio/${room} COMPONENT development)
  endif()
endfunction()

# gonio_per_instruction_set(ROOM SOURCES…): the same sources, one set of objects per instruction set, which a source of the
# room finds by instruction_sets.inc.  "scalar" is the plain reference that the lanes of every other set must equal bit
# for bit, and what runs where no other set does.
function(gonio_per_instruction_set room)
  string(REPLACE / _ name gonio_${room})
  foreach(set scalar ${GONIO_INSTRUCTION_SETS})
    add_library(${name}_${set} OBJECT ${ARGN})
    target_include_directories(${name}_${set} PRIVATE $<TARGET_PROPERTY:${name},INCLUDE_DIRECTORIES>)
    target_link_libraries(${name}_${set} PRIVATE gonio_flags)
    target_compile_definitions(${name}_${set} PRIVATE GONIO_ARCH=${set})
    target_compile_options(${name}_${set} PRIVATE ${gonio_flags_${set}})
    if(set MATCHES "^(scalar|shaken)$")
      target_compile_definitions(${name}_${set} PRIVATE GONIO_SCALAR)
      target_compile_options(${name}_${set} PRIVATE -fno-tree-vectorize)
    endif()
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${name}_${set}>)
    string(APPEND sets "GONIO_SET(${set})\n")
  endforeach()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}/instruction_sets.inc CONTENT "${sets}")
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${name})
endfunction()
