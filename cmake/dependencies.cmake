# From Debian (see ./quickstart for the package names); elsewhere by the usual CMake packages.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
