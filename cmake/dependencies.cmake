# From Debian (cmake/install_missing.sh has the package names); elsewhere by the usual CMake packages, Nettle by
# pkg-config.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(pugixml REQUIRED)
find_package(embree 3 REQUIRED)
find_package(PNG REQUIRED)
find_package(TIFF 4.5 QUIET)  # the first that has handlers of its own for each file
gonio_option_if_found(GONIO_TIFF gonio_tiff ${TIFF_FOUND} "Read TIFF, which needs libtiff from 4.5 on")
if(gonio_tiff AND NOT TIFF_FOUND)
  message(FATAL_ERROR "GONIO_TIFF needs libtiff from 4.5 on: cmake/install_missing.sh has the package")
endif()
find_package(PkgConfig REQUIRED)
pkg_check_modules(nettle REQUIRED IMPORTED_TARGET nettle)

# Headers that most files read and that take long to parse, parsed once. A room that links fmt starts from them, one that
# links JSON from these and JSON (gonio_room). Every file includes what it uses all the same: clang-tidy reads without them.
set(gonio_headers_libraries fmt::fmt TBB::tbb)
set(gonio_headers
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <numbers> <optional> <set> <span> <string>
  <string_view> <variant> <vector> <fmt/format.h> <fmt/ranges.h> <tbb/parallel_for.h>)
file(CONFIGURE OUTPUT headers.cpp CONTENT "// A target needs a source.\n")
function(gonio_precompiled name)
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/headers.cpp)
  target_link_libraries(${name} PRIVATE gonio_flags ${gonio_headers_libraries} nlohmann_json::nlohmann_json)
  target_precompile_headers(${name} PRIVATE ${gonio_headers} ${ARGN})
endfunction()
gonio_precompiled(gonio_headers)
gonio_precompiled(gonio_json_headers <nlohmann/json.hpp>)
