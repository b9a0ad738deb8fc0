# The flags every file is compiled with, the shape of a room, and the instruction sets.

option(GONIO_WERROR "Treat warnings as errors (the test presets do; a newer compiler must not stop a user)" OFF)

# OPTION, which may be ON, OFF or AUTO, as RESULT for all folders. AUTO is what was found, anew by each configuration: what the first lacks the
# next may have.
function(gonio_option_if_found OPTION RESULT FOUND WORDS)
  set(${OPTION} AUTO CACHE STRING "${WORDS}: ON, OFF, or AUTO where that is found")
  set(value ${${OPTION}})
  if(value STREQUAL AUTO)
    set(value ${FOUND})
  endif()
  set(${RESULT} ${value} CACHE INTERNAL "What ${OPTION} comes to")
endfunction()

# The kernels are compiled for each of these; the best one that the machine has runs. "all" is what packages have. By default they
# are the plainest one and this machine's best, which is all that it can run and half of the work.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
  set(gonio_known_sets sse2 avx2 avx512)
else()
  set(gonio_known_sets native)
endif()
if(NOT DEFINED CACHE{GONIO_INSTRUCTION_SETS} AND NOT DEFINED GONIO_INSTRUCTION_SETS)
  set(gonio_sets_here ${gonio_known_sets})
  if("avx2" IN_LIST gonio_known_sets AND NOT CMAKE_CROSSCOMPILING)
    try_run(gonio_best gonio_asked ${CMAKE_BINARY_DIR}/best_set ${CMAKE_CURRENT_LIST_DIR}/best_set.cpp)
    if(gonio_asked AND gonio_best MATCHES "^[0-2]$")
      list(GET gonio_known_sets ${gonio_best} gonio_sets_here)
      list(PREPEND gonio_sets_here sse2)
      list(REMOVE_DUPLICATES gonio_sets_here)
    endif()
  endif()
endif()
set(GONIO_INSTRUCTION_SETS "${gonio_sets_here}" CACHE STRING
  "Vector units to compile the column kernels for, or all; the best one present is chosen at run time")
if(GONIO_INSTRUCTION_SETS STREQUAL "all")
  set(GONIO_INSTRUCTION_SETS ${gonio_known_sets})
endif()
set(gonio_flags_avx2 -mavx2 -mfma)
set(gonio_flags_avx512 -mavx2 -mfma -mavx512f -mavx512dq -mavx512bw -mavx512cd -mavx512vl
  -Wno-uninitialized -Wno-maybe-uninitialized)  # g++ 12 warns inside its own AVX-512 headers

find_program(GONIO_CCACHE ccache)
if(GONIO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without being told so it does not keep what was compiled from a precompiled header.  What a file includes it takes from the
  # compiler's own list, for running the preprocessor first costs half a second a file.  Paths below the project count as
  # relative: a second clone finds what the first compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${GONIO_CCACHE})
endif()

# What costs is reading headers: the files of a room are compiled together, so names in their anonymous namespaces are the
# room's.
option(GONIO_UNITY "Compile the files of a room together" ON)

# gonio_together(NAME COUNT FILES): replaces the files in the variable FILES by files that include COUNT of them each. CMake's own
# UNITY_BUILD writes absolute paths, which keep a second clone from finding in the compiler's cache what the first compiled.
function(gonio_together name count files)
  list(LENGTH ${files} all)
  if(NOT GONIO_UNITY OR all LESS 2)
    return()
  endif()
  set(at ${PROJECT_BINARY_DIR}/together/${name})
  set(together)
  math(EXPR last "${all} - 1")
  foreach(begin RANGE 0 ${last} ${count})
    list(SUBLIST ${files} ${begin} ${count} part)
    set(content)
    foreach(source ${part})
      file(RELATIVE_PATH path ${at} ${source})
      string(APPEND content "#include \"${path}\"\n")
    endforeach()
    file(CONFIGURE OUTPUT ${at}/${begin}.cpp CONTENT "${content}")
    list(APPEND together ${at}/${begin}.cpp)
  endforeach()
  set(${files} ${together} PARENT_SCOPE)
endfunction()

# The same objects make the program and modules that other programs load.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# A defect that a stranger's file reaches ends the program: writes past an array, and, where system and libraries have it, jumps to where none leads.
set(gonio_hardening -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fstack-protector-strong)
if("avx2" IN_LIST gonio_known_sets)
  list(APPEND gonio_hardening -fcf-protection)
endif()

add_library(gonio_flags INTERFACE)
target_compile_features(gonio_flags INTERFACE cxx_std_20)
target_compile_options(gonio_flags INTERFACE
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wdouble-promotion;-Wold-style-cast>"
  -ffp-contract=off             # the same bits for a scalar and for a lane of a batch
  -fno-semantic-interposition   # a function may be inlined although a library could be asked for another of its name
  -fno-math-errno               # nobody asks errno after a square root, and loops with one can be vectors
  # g++ 12 raises the first three for std::string code that is fine, the last for files that are compiled together
  "$<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-subobject-linkage>>"
  $<BUILD_INTERFACE:$<$<BOOL:${GONIO_WERROR}>:-Werror>>
  # From 128 MB on g++ looks again and again for memory of its own that it may use anew: a tenth of its time, for a tenth of the memory.
  "$<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>>"
  "$<BUILD_INTERFACE:$<$<CONFIG:Release>:${gonio_hardening}>>")
install(TARGETS gonio_flags EXPORT gonio)
set_target_properties(gonio_flags PROPERTIES EXPORT_NAME flags)

# gonio_room(ROOM [APART] [COLD] USES rooms… LIBRARIES what its headers show… PRIVATE what they do not…): the folder ROOM, as
# "brdf/formula", as a target with its own include root.  Its sources are all .cpp files in it; its headers are
# included as "brdf/formula/ndf.h"; those of a room that is not in USES, nor used by one that is, are not found.  APART: its files are compiled one by one, because formulas cost more than headers.
# COLD: they show what others compute, or ask for it a few times; -O1 compiles them in two thirds of the time.
function(gonio_room room)
  cmake_parse_arguments(room "APART;COLD" "" "SOURCES;USES;LIBRARIES;PRIVATE" ${ARGN})
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
    if(NOT room_APART AND NOT room_SOURCES)
      gonio_together(${name} 8 sources)
    endif()
    add_library(${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${name} PRIVATE ${room_PRIVATE})
    if(room_COLD)
      target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
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

# gonio_per_instruction_set(ROOM SOURCES…): the same sources, one set of objects per instruction set, which the room's own
# sources find by instruction_sets.inc.  Beside the room stands ROOM_reference, the same with the set "scalar": one number at
# a time, which the lanes of every other set must equal bit for bit. It is compiled for tests only, which link it first.
function(gonio_per_instruction_set room)
  string(REPLACE / _ name gonio_${room})
  get_target_property(finders ${name} SOURCES)
  foreach(set ${GONIO_INSTRUCTION_SETS} scalar)
    add_library(${name}_${set} OBJECT EXCLUDE_FROM_ALL ${ARGN})
    target_include_directories(${name}_${set} PRIVATE $<TARGET_PROPERTY:${name},INCLUDE_DIRECTORIES>)
    target_link_libraries(${name}_${set} PRIVATE gonio_flags)
    target_compile_definitions(${name}_${set} PRIVATE GONIO_ARCH=${set})
    target_compile_options(${name}_${set} PRIVATE ${gonio_flags_${set}})
    if(set MATCHES "^(scalar|shaken)$")
      target_compile_definitions(${name}_${set} PRIVATE GONIO_SCALAR)
      target_compile_options(${name}_${set} PRIVATE -fno-tree-vectorize)
    endif()
    if(NOT set STREQUAL "scalar")
      target_sources(${name} PRIVATE $<TARGET_OBJECTS:${name}_${set}>)
      string(APPEND sets "GONIO_SET(${set})\n")
    endif()
  endforeach()
  set(at ${CMAKE_CURRENT_BINARY_DIR}/${name})
  file(GENERATE OUTPUT ${at}/instruction_sets.inc CONTENT "${sets}")
  target_include_directories(${name} PRIVATE ${at})
  file(GENERATE OUTPUT ${at}/reference/instruction_sets.inc CONTENT "GONIO_SET(scalar)\n${sets}")
  add_library(${name}_reference OBJECT EXCLUDE_FROM_ALL ${finders})
  target_include_directories(${name}_reference BEFORE PRIVATE ${at}/reference)
  target_link_libraries(${name}_reference PRIVATE ${name})
endfunction()
