# Builds and runs the project in consumer/ against nacre:
#   cmake -DHOW=find_package|add_subdirectory -DSOURCE=<nacre> -DBUILD=<nacre's build folder> -DWORK=<folder>
#         -DCOMPILER=<c++> -P check.cmake
function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# Debug builds fastest, and that it builds is all that is asked here.
set(configure ${CMAKE_COMMAND} -S ${SOURCE}/tests/package/consumer -B ${WORK}/build -G Ninja
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug)
if(HOW STREQUAL "find_package")
    run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
    # The program finds the scenes that were installed with it.
    run(${WORK}/prefix/bin/nacre gallery phong --scale 0.05 --spp 1 --quiet -o ${WORK}/pictures)
    run(${configure} -DCMAKE_PREFIX_PATH=${WORK}/prefix)
else()
    run(${configure} -DNACRE_SOURCE=${SOURCE})
endif()
run(${CMAKE_COMMAND} --build ${WORK}/build --target all)
run(${WORK}/build/consumer)
run(${WORK}/build/everything)
run(${WORK}/build/adding_a_model)
run(${WORK}/build/adding_a_profile)
if(HOW STREQUAL "add_subdirectory" AND EXISTS ${WORK}/build/nacre/tests)
    message(FATAL_ERROR "nacre builds its tests inside another project")
endif()
file(REMOVE_RECURSE ${WORK})
