# Finds what the library `nacre` links and lists in NACRE_MISSING what is not there. Nacre's own build and, installed
# beside nacre-config.cmake, every project that uses the package read this: both must see the same targets, because a
# static library leaves it to its users to link what it needs.
set(NACRE_MISSING "")
# Quiet: Debian's Imath reports a library of another package (its Python module) as missing.
set(nacre_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
foreach(need Threads "TBB CONFIG" fmt "embree 3" "OpenEXR CONFIG" pugixml ZLIB nlohmann_json TinyGLTF
             Ceres)
    string(REPLACE " " ";" need "${need}")
    find_package(${need} QUIET)
    list(GET need 0 need)
    if(NOT ${need}_FOUND)
        list(APPEND NACRE_MISSING ${need})
    endif()
endforeach()
set(CMAKE_MESSAGE_LOG_LEVEL "${nacre_log_level}")

# OpenGL's and EGL's functions, loaded when first called: the program starts where there is no driver.
if(NACRE_REALTIME)
    find_path(NACRE_EPOXY_INCLUDE epoxy/egl.h)
    find_library(NACRE_EPOXY_LIBRARY epoxy)
    mark_as_advanced(NACRE_EPOXY_INCLUDE NACRE_EPOXY_LIBRARY)
    if(NOT NACRE_EPOXY_INCLUDE OR NOT NACRE_EPOXY_LIBRARY)
        list(APPEND NACRE_MISSING epoxy)
    elseif(NOT TARGET nacre_epoxy)
        add_library(nacre_epoxy INTERFACE IMPORTED)
        target_include_directories(nacre_epoxy INTERFACE ${NACRE_EPOXY_INCLUDE})
        target_link_libraries(nacre_epoxy INTERFACE ${NACRE_EPOXY_LIBRARY})
    endif()
endif()

# OpenVDB's own find module brings find modules for other packages, which then fail in place of those packages' own
# configuration (Ceres does). The library needs no more than this.
find_path(NACRE_OPENVDB_INCLUDE openvdb/openvdb.h)
find_library(NACRE_OPENVDB_LIBRARY openvdb)
mark_as_advanced(NACRE_OPENVDB_INCLUDE NACRE_OPENVDB_LIBRARY)
if(NOT NACRE_OPENVDB_INCLUDE OR NOT NACRE_OPENVDB_LIBRARY)
    list(APPEND NACRE_MISSING OpenVDB)
elseif(NOT TARGET nacre_openvdb)
    add_library(nacre_openvdb INTERFACE IMPORTED)
    target_include_directories(nacre_openvdb INTERFACE ${NACRE_OPENVDB_INCLUDE})
    target_link_libraries(nacre_openvdb INTERFACE ${NACRE_OPENVDB_LIBRARY} Imath::Imath TBB::tbb)
endif()
