# What nacre needs from Debian 12; `./dev` installs it. Building needs more than using the library.
include(NacreNeeds)
foreach(need CLI11 Eigen3 Spectra)
    find_package(${need} QUIET)
    if(NOT ${need}_FOUND)
        list(APPEND NACRE_MISSING ${need})
    endif()
endforeach()
if(NACRE_MISSING)
    list(JOIN NACRE_MISSING ", " NACRE_MISSING)
    message(FATAL_ERROR "nacre needs these packages, which CMake does not find: ${NACRE_MISSING}. "
                        "On Debian 12, `./dev build` installs them; docs/building.md lists them.")
endif()
