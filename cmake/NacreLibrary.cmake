# The library that others link: all rooms in one archive, with a package that find_package(nacre) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(nacre STATIC)
add_library(nacre::nacre ALIAS nacre)
set_target_properties(nacre PROPERTIES LINKER_LANGUAGE CXX)
foreach(room IN LISTS NACRE_ROOMS)
    target_sources(nacre PRIVATE $<TARGET_OBJECTS:nacre_${room}>)
endforeach()
target_include_directories(nacre PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# Packs of lanes go through the interface in registers, whose width the processor's instruction set decides: whoever
# calls the library must be compiled for the same one.
target_compile_features(nacre PUBLIC cxx_std_20)
target_compile_options(nacre PUBLIC ${NACRE_ARCH_OPTIONS})
list(REMOVE_DUPLICATES NACRE_ROOM_LIBS)
target_link_libraries(nacre PUBLIC fmt::fmt PRIVATE Threads::Threads TBB::tbb ${NACRE_ROOM_LIBS})

if(NACRE_INSTALL)
    set(package ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
    install(TARGETS nacre EXPORT nacre ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    nacre_installed_headers(headers)
    foreach(header IN LISTS headers)
        cmake_path(GET header PARENT_PATH folder)
        install(FILES src/nacre/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nacre/${folder})
    endforeach()
    install(EXPORT nacre NAMESPACE nacre:: FILE nacre-targets.cmake DESTINATION ${package})
    configure_package_config_file(cmake/nacre-config.cmake.in nacre-config.cmake INSTALL_DESTINATION ${package})
    write_basic_package_version_file(nacre-config-version.cmake COMPATIBILITY SameMinorVersion)
    install(FILES cmake/NacreNeeds.cmake ${CMAKE_CURRENT_BINARY_DIR}/nacre-config.cmake
            ${CMAKE_CURRENT_BINARY_DIR}/nacre-config-version.cmake DESTINATION ${package})
endif()
