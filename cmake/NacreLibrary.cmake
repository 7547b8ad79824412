# The library that others link: all rooms in one archive, with a package that find_package(nacre) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(nacre STATIC)
set_target_properties(nacre PROPERTIES LINKER_LANGUAGE CXX)
target_compile_features(nacre PUBLIC cxx_std_20)
foreach(room IN LISTS NACRE_ROOMS)
    target_sources(nacre PRIVATE $<TARGET_OBJECTS:nacre_${room}>)
endforeach()
target_include_directories(nacre PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
list(REMOVE_DUPLICATES NACRE_ROOM_LIBS)
list(REMOVE_ITEM NACRE_ROOM_LIBS nacre_openvdb)
target_link_libraries(nacre PUBLIC fmt::fmt TBB::tbb ${NACRE_ROOM_LIBS} $<BUILD_INTERFACE:nacre_openvdb>
                      $<INSTALL_INTERFACE:openvdb>)
add_library(nacre::nacre ALIAS nacre)

install(TARGETS nacre EXPORT nacre ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/nacre TYPE INCLUDE FILES_MATCHING PATTERN "*.h" PATTERN "precompiled.h" EXCLUDE)
install(EXPORT nacre NAMESPACE nacre:: FILE nacre-targets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
configure_package_config_file(cmake/nacre-config.cmake.in nacre-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
write_basic_package_version_file(nacre-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nacre-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/nacre-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
