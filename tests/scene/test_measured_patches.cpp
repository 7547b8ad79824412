// Materials of scenes on a flat patch: the virtual gonioreflectometer returns them as they are,
// what passes through them too.
#include "nacre/goniometer/measurement.h"
#include "nacre/goniometer/patch_material.h"
#include "nacre/math/quadrature.h"
#include "nacre/math/statistics.h"
#include "tests/scene/material_fixture.h"

namespace nacre {

// Radiance is measured: behind the boundary the BTDF is that of the material, which carries 1/eta^2.
TEST(MeasuredPatches, FlatTransmittingMaterialsAreThemselves) {
    using namespace test;
    const GaussLegendre nodes(8);
    for (const auto& [name, built] :
         {std::pair("rough glass", material(bsdf("roughdielectric", {number("alpha", 0.5)}))),
          std::pair("translucent", material(bsdf("difftrans", {number("transmittance", 0.6)})))}) {
        const MaterialPtr& m = built;
        const Patch patch =
            make_patch(make_microgeometry("flat"),
                       [&](const SurfacePoint& at, const Wavelengths& w,
                           BsdfScratch& s) -> const Bsdf& { return m->at(at, w, s); });
        MeasureOptions options{.bins = {9, 12}};
        options.least_rays = options.most_rays = 200'000;
        IncidenceMeasurement found(DirectionCell::at(0.7, 0.4), options.bins);
        measure(patch, options, found);
        BsdfScratch scratch;
        const Bsdf& f = m->at(SurfacePoint{}, options.wavelengths, scratch);
        const Vec3f wi(found.incidence.draw(0.5, 0.5));
        double statistic = 0.;
        int cells = 0, behind = 0;
        for (std::size_t i = 0; i < options.bins.size(); ++i)
            for (const bool below : {false, true}) {
                const DirectionCell cell = options.bins.cell(i);
                const double expected = nodes.integrate(0., 1., [&](double u) {
                    return nodes.integrate(0., 1., [&](double v) {
                        const Vec3d w = cell.draw(u, v);
                        return double(f.eval(wi, Vec3f(Vec3d{w.x, w.y, below ? -w.z : w.z}))[1] /
                                      wi.z);
                    });
                });
                const MeasuredValue v = below ? found.btdf(i, 1) : found.brdf(i, 1);
                if (expected * cell.projected_solid_angle() * double(found.rays) < 100.) continue;
                const double z = (v.value - expected) / v.error;
                statistic += z * z;
                ++cells;
                behind += below;
            }
        EXPECT_GT(behind, 20) << name;
        EXPECT_EQ(cells - behind > 20, (m->flags() & reflects) != 0) << name;
        EXPECT_GT(chi_square_probability(statistic, cells), 1e-4) << name << " " << statistic;
    }
}

}  // namespace nacre
