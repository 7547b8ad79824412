#pragma once
// A translucent ball that is quick to render, and pictures whose errors are known.
#include "nacre/compare/experiment.h"
#include "nacre/math/random.h"
#include "nacre/scene/load.h"
#include "tests/metrics/pictures_fixture.h"
#include "tests/scene/scene_files.h"

namespace nacre::test {

/// Dense, absorbing matter without a boundary in even light; `size` pixels a side. `object` goes
/// into the shape.
inline std::string ball_scene(int size, const std::string& albedo = "0.6, 0.6, 0.6",
                              const std::string& sampler = "independent") {
    return fmt::format(
        R"(<scene version="3.0.0"><integrator type="volpath"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
<float name="fov" value="24"/><sampler type="{}"><integer name="sample_count" value="4"/></sampler>
<film type="hdrfilm"><integer name="width" value="{}"/><integer name="height" value="{}"/><rfilter type="box"/></film></sensor>
<emitter type="constant"><rgb name="radiance" value="1, 1, 1"/></emitter>
<shape type="sphere" id="ball"><bsdf type="null"/><medium type="homogeneous" name="interior"><float name="sigma_t" value="8"/><rgb name="albedo" value="{}"/></medium></shape>
</scene>)",
        sampler, size, size, albedo);
}

class ExperimentTest : public SceneFiles {
  protected:
    Scene ball(int size, const std::string& albedo = "0.6, 0.6, 0.6",
               const std::string& sampler = "independent") {
        return load_scene(write("ball.xml", ball_scene(size, albedo, sampler)));
    }
    ReferenceOptions reference_options(double error) {
        ReferenceOptions o;
        o.error = error;
        o.block = 4;
        o.store = folder_ / "references";
        return o;
    }
    ExperimentOptions experiment_options(const std::string& techniques) {
        ExperimentOptions o;
        o.settings = parse_techniques(techniques, {2});
        o.reference = reference_options(0.05);
        o.block = 4;
        o.repeats = 2;
        o.folder = folder_ / "pictures";
        o.build = "test";
        return o;
    }
};

/// Normal deviates by the method of Box and Muller.
class Normal {
  public:
    explicit Normal(std::uint64_t seed) : random_(seed) {}
    double operator()() {
        const double u = 1 - double(random_.next()), v = random_.next();
        return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v);
    }

  private:
    Random random_;
};

/// What measuring would give for a technique whose pixels are `truth * (1 + bias)` with noise of
/// standard deviation `sigma` a frame.
inline Measurement made_up(int size, double truth, double bias, double sigma, int repeats,
                           std::uint64_t seed) {
    Normal normal(seed);
    std::vector<Image> frames;
    Measurement m;
    m.id = "made up";
    m.samples = 1;
    m.status = Measurement::Status::done;
    for (int r = 0; r < repeats; ++r) {
        Image f(size, size);
        for (float& v : f.data) v = float(truth * (1 + bias) + sigma * normal());
        frames.push_back(f);
        m.timings.push_back({1. + r, 2., 0.5, 0.5});
    }
    set_pictures(m, frames);
    return m;
}

}  // namespace nacre::test
