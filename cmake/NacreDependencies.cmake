# What nacre needs from Debian 12; `./dev` installs it.
find_package(Threads REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(fmt REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(pugixml REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(TinyGLTF REQUIRED)

# OpenVDB's find module comes with modules of its own that break other packages: its folder is removed again.
set(nacre_module_path ${CMAKE_MODULE_PATH})
find_path(NACRE_OPENVDB_MODULES FindOpenVDB.cmake
          PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB /usr/lib/cmake/OpenVDB /usr/share/cmake/OpenVDB REQUIRED)
list(APPEND CMAKE_MODULE_PATH ${NACRE_OPENVDB_MODULES})
find_package(OpenVDB REQUIRED COMPONENTS openvdb)
set(CMAKE_MODULE_PATH ${nacre_module_path})
add_library(nacre_openvdb INTERFACE)
target_link_libraries(nacre_openvdb INTERFACE OpenVDB::openvdb)
