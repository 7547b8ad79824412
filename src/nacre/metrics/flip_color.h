#pragma once
// Colours of FLIP, one step each: the spaces it filters and measures in, the distance of two
// colours and how distances become errors. Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom
// and Fairchild 2020, FLIP: A Difference Evaluator for Alternating Images, Proc. ACM Comput. Graph.
// Interact. Tech. 3(2): the colour pipeline.
//
// RGB is linear, with the primaries of sRGB and the white D65 at chromaticity (0.3127, 0.3290), to
// which XYZ are relative here: white is (1, 1, 1) in both.
#include "nacre/math/vec.h"

namespace nacre::flip_steps {

/// RGB to the linear opponent space YCxCz, in which contrast sensitivity was measured: (116 Y - 16,
/// 500 (X - Y), 200 (Y - Z)) (Flohr et al. 1993).
Vec3f to_ycxcz(Vec3f rgb);
Vec3f from_ycxcz(Vec3f ycxcz);

/// CIELab of RGB, with a* and b* times 0.01 L*: chroma seems to grow with lightness (Hunt 1952).
Vec3f hunt_lab(Vec3f rgb);

/// |dL| + sqrt(da^2 + db^2): the distance that suits large differences (Abasi, Amani Tehran and
/// Fairchild 2020, Distance metrics for very large color differences, Color Research and
/// Application 45(2)).
float hyab(Vec3f lab_a, Vec3f lab_b);

/// Exponent q_c of the distance.
inline constexpr float color_exponent = 0.7f;

/// c_max, the largest power of a distance: that of green and blue, 41.276.
float largest_distance_power();

/// A power of a distance as an error in [0, 1]: linear from 0 to p_t = 0.95 for powers up to
/// p_c = 0.4 of c_max, linear from there to 1 at c_max.
float redistribute(float distance_power);

}  // namespace nacre::flip_steps
