// The model of docs/adding-a-model.md in a project of its own: evaluated by its name's settings, and
// put through the checks that nacre's own models face.
#include <nacre/reflectance/check.h>
#include <nacre/reflectance/evaluator_of.h>
#include <nacre/reflectance/registry.h>

#include <cstdio>

#include "minnaert.h"

int main() {
    const nacre::Evaluator& minnaert = nacre::evaluator_of<nacre::Minnaert>();
    const nacre::AnyModel moon(minnaert, nacre::parse_settings("rho=0.6 k=2"));
    const double f = moon.eval(nacre::Vec3d{0.6, 0., 0.8}, nacre::Vec3d{0., -0.8, 0.6});
    std::printf("minnaert rho=0.6 k=2: %.6f sr^-1\n", f);
    bool good = std::abs(f - 0.6 * 3. / 6.283185307 * 0.8 * 0.6) < 1e-9;
    for (const nacre::CheckOutcome& c : nacre::check_model(minnaert, {.samples = 10000})) {
        if (!c.passed) std::printf("failed: %s: %s\n", c.name.c_str(), c.detail.c_str());
        good = good && c.passed;
    }
    return good ? 0 : 1;
}
