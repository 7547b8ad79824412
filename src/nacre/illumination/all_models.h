#pragma once
// Every illumination model, in the order of their numbers. Add a model: write its file, add it
// here.
#include <tuple>

#include "nacre/illumination/m01_bouknight_ambient.h"
#include "nacre/illumination/m02_cook_torrance_ambient.h"
#include "nacre/illumination/m03_bouknight_diffuse.h"
#include "nacre/illumination/m04_warnock_diffuse.h"
#include "nacre/illumination/m05_romney.h"
#include "nacre/illumination/m06_cook_torrance_diffuse.h"
#include "nacre/illumination/m07_inverse_square.h"
#include "nacre/illumination/m08_van_dam_diffuse.h"
#include "nacre/illumination/m09_two_inverse_squares.h"
#include "nacre/illumination/m10_foley_van_dam_diffuse.h"
#include "nacre/illumination/m11_attenuated_diffuse.h"
#include "nacre/illumination/m12_warnock_specular.h"
#include "nacre/illumination/m13_phong.h"
#include "nacre/illumination/m14_foley_van_dam_phong.h"
#include "nacre/illumination/m15_blinn_phong.h"
#include "nacre/illumination/m16_foley_van_dam_blinn.h"
#include "nacre/illumination/m17_yang.h"
#include "nacre/illumination/m18_blinn_torrance_sparrow.h"
#include "nacre/illumination/m19_cook_torrance.h"
#include "nacre/illumination/m20_he_torrance.h"
#include "nacre/illumination/m21_linear_transparency.h"
#include "nacre/illumination/m22_crow_transparency.h"
#include "nacre/illumination/m23_hall_transparency.h"

namespace nacre::illumination {

template <class D, class P = D>
using AllModels =
    std::tuple<BouknightAmbient<D, P>, CookTorranceAmbient<D, P>, BouknightDiffuse<D, P>,
               WarnockDiffuse<D, P>, Romney<D, P>, CookTorranceDiffuse<D, P>, InverseSquare<D, P>,
               VanDamDiffuse<D, P>, TwoInverseSquares<D, P>, FoleyVanDamDiffuse<D, P>,
               AttenuatedDiffuse<D, P>, WarnockSpecular<D, P>, Phong<D, P>, FoleyVanDamPhong<D, P>,
               BlinnPhong<D, P>, FoleyVanDamBlinn<D, P>, Yang<D, P>, BlinnTorranceSparrow<D, P>,
               CookTorrance<D, P>, HeTorrance<D, P>, LinearTransparency<D, P>,
               CrowTransparency<D, P>, HallTransparency<D, P>>;

}  // namespace nacre::illumination
