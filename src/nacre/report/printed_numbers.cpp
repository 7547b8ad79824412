#include "nacre/report/printed_numbers.h"

namespace nacre {
namespace {

// As the authors gave them; what a paper leaves out is "not stated".
constexpr PrintedNumber numbers[] = {
    {"Jensen, Marschner, Levoy, Hanrahan 2001", "marble bust", "none",
     "5 min a picture (BRDF 2 min, complete simulation 1250 min)", "not stated", "all (offline)"},
    {"Jensen, Buhler 2002", "teapot, 150,000 samples", "about 1 min for the hierarchy",
     "40 s a picture", "Pentium III 800 MHz", "view"},
    {"Haber, Mertens, Bekaert, Van Reeth 2005", "200,000 triangles", "45 s of multigrid",
     "5 s a picture", "Pentium IV 1.7 GHz", "view"},
    {"Kniss, Premoze, Hansen, Ebert 2002", "volume", "none",
     "50 to 60 % slower than unlit volume rendering", "GeForce 3, Radeon 8500",
     "light, view, material, volume"},
    {"Lensch et al. 2002", "horse, 10,000 vertices, 512 x 512", "6 to 10 min / about 8 min",
     "2.6 / 2.3 frames a second", "Xeon 1.7 GHz, GeForce 3", "light, view"},
    {"Hao, Baby, Varshney 2003", "76,000 vertices, 1024 x 1024", "none",
     "12.7 frames a second (17.2 without)", "Pentium IV 2 GHz, GeForce 3", "light, view"},
    {"Hao, Baby, Varshney 2003", "150,000 vertices", "40 min for 200 lights", "7.5 frames a second",
     "Pentium IV 2 GHz, GeForce 3", "light, view"},
    {"Hao, Varshney 2004", "150,000 vertices, 28 bytes a vertex", "none", "8.6 frames a second",
     "Pentium IV 2 GHz, GeForce 3", "light, view"},
    {"Carr, Hall, Hart 2003", "70,000 triangles, 1024 x 1024", "9 s", "12.05 frames a second",
     "GeForce FX", "light, view, (material)"},
    {"Mertens et al. 2003, local", "132,000 triangles", "none",
     "5 frames a second (4 to 5 at 500 x 500)", "Xeon 2.4 GHz, Radeon 9700 Pro",
     "all, geometry as well"},
    {"Dachsbacher, Stamminger 2003", "70,000 triangles, 512 x 512", "none", "11.9 frames a second",
     "Pentium 4 2.4 GHz, Radeon 9700", "light, view, pose of the object"},
    {"Dachsbacher, Stamminger 2003", "100,000 vertices", "none", "5.7 frames a second",
     "Pentium 4 2.4 GHz, Radeon 9700", "light, view, pose of the object"},
};

}  // namespace

std::span<const PrintedNumber> printed_numbers() { return numbers; }

}  // namespace nacre
