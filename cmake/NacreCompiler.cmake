# Compiler settings that hold everywhere.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")

add_library(nacre_compiler INTERFACE)
# errno and floating-point traps forbid vectorisation and buy nothing here. -ffast-math stays off:
# it would let the compiler assume that there are no NaNs, which the film must find.
target_compile_options(nacre_compiler INTERFACE -Wall -Wextra -Werror -fno-math-errno -fno-trapping-math)
# The compiler's note that packs wider than the registers are passed differently than in g++ 4 concerns nobody here.
if(NACRE_PORTABLE)
    set(NACRE_ARCH_OPTIONS -march=x86-64-v3 -Wno-psabi)
else()
    set(NACRE_ARCH_OPTIONS -march=native -Wno-psabi)
endif()
target_compile_options(nacre_compiler INTERFACE ${NACRE_ARCH_OPTIONS})
if(NACRE_SANITIZE)
    target_compile_options(nacre_compiler INTERFACE -fsanitize=${NACRE_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(nacre_compiler INTERFACE -fsanitize=${NACRE_SANITIZE})
endif()

# The program and its tests spend their time in the library: they are compiled for the time that compiling takes (six
# files of the program as one: 8.5 s, for 11 to 13 at -O1).
set(NACRE_QUICK_OPTIONS $<$<CONFIG:Release>:-Og>)
