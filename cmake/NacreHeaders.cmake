# The headers that the package promises, and those that they include: what is installed. All others are the library's own
# business and may change or go at any time.
set(NACRE_PROMISED_HEADERS
    math/*.h text/names.h spectrum/*.h catalogue/{parameter,settings,catalogue}.h image/image.h optics/*.h reflectance/*.h illumination/*.h
    measured/{merl,half_angle,fit,cuts}.h measured/factor/{factorise,textures,spheres}.h
    layers/{layer,kubelka_munk,hanrahan_krueger,adding_doubling,slab_monte_carlo,mcml_io,skin}.h
    bssrdf/*.h metrics/{metrics,flip,pictures}.h vectors/check.h
    geometry/{mesh,mesh_io,mesh_report,transform,primitives,ray_scene,surface_points,figure}.h
    goniometer/{instrument,measurement_set,microgeometry,patch_material}.h
    scene/{load,scene,demo_scene,subsurface,texture}.h
    render/{render,render_job,film_state,output,integrator,path_tracer,volume_path_tracer}.h
    technique/*.h techniques/*.h peers/peer.h
    compare/{experiment,model_comparison,suite}.h report/{report,page}.h)

# Sets `out` to the promised headers and all that they include, relative to src/nacre.
function(nacre_installed_headers out)
    set(root ${PROJECT_SOURCE_DIR}/src/nacre)
    set(waiting "")
    foreach(pattern IN LISTS NACRE_PROMISED_HEADERS)
        if(pattern MATCHES "^(.*){(.*)}(.*)$")
            set(before ${CMAKE_MATCH_1})
            set(after ${CMAKE_MATCH_3})
            string(REPLACE "," ";" names "${CMAKE_MATCH_2}")
            list(TRANSFORM names PREPEND ${before})
            list(TRANSFORM names APPEND ${after})
            list(APPEND waiting ${names})
        else()
            file(GLOB found CONFIGURE_DEPENDS RELATIVE ${root} ${root}/${pattern})
            list(APPEND waiting ${found})
        endif()
    endforeach()
    set(installed "")
    while(waiting)
        list(POP_FRONT waiting header)
        if(header IN_LIST installed)
            continue()
        endif()
        list(APPEND installed ${header})
        file(STRINGS ${root}/${header} includes REGEX "^#include \"nacre/")
        foreach(include IN LISTS includes)
            string(REGEX REPLACE "^#include \"nacre/([^\"]+)\".*" "\\1" name "${include}")
            list(APPEND waiting ${name})
        endforeach()
    endwhile()
    set(${out} ${installed} PARENT_SCOPE)
endfunction()
