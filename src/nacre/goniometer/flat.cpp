#include "nacre/goniometer/microgeometry.h"

namespace nacre {

const MicrogeometryDescription flat_geometry{
    .name = "flat",
    .title = "Flat surface",
    .meaning = "no microgeometry: what is measured is the material itself",
    .parameters = {},
    .make =
        [](const ParameterValues&) {
            return extruded_profile({{0., 0.}, {0.5, 0.}}, 1.);
        },
};

}  // namespace nacre
