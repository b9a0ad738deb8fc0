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
find_package(PkgConfig REQUIRED)
pkg_check_modules(nettle REQUIRED IMPORTED_TARGET nettle)

# What most files read and what takes long to parse, parsed once: rooms that link fmt start from it (gonio_room), which
# saves a fifth of their compile time. JSON is not in it: that would cost those who do not use it half a second each.
# Every file includes what it uses all the same: clang-tidy (./check --long) reads without it.
file(CONFIGURE OUTPUT headers.cpp CONTENT "// A target needs a source.\n")
add_library(gonio_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/headers.cpp)
set(gonio_headers_libraries fmt::fmt TBB::tbb)
target_link_libraries(gonio_headers PRIVATE gonio_flags ${gonio_headers_libraries})
set(gonio_headers
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <numbers> <optional> <set> <span> <string>
  <string_view> <vector> <fmt/format.h> <tbb/parallel_for.h>)
target_precompile_headers(gonio_headers PRIVATE ${gonio_headers})
