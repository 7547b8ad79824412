// What techniques claim to keep when the scene changes, held against pictures: after each change
// the next picture is, bit by bit, that of a technique prepared for the new scene; what is claimed
// to be kept is right for it; and what is not claimed would be wrong.
#include "tests/techniques/technique_fixture.h"

namespace nacre {
namespace {

constexpr Changes light{.light = true}, material{.material = true}, geometry{.geometry = true};

/// A ball on a floor under a lamp.
std::string body(const Changes& changed) {
    const std::string matter =
        xml::rgb("sigma_s", changed.material ? Vec3d(2, 3, 1) : Vec3d(1, 2, 4)) +
        xml::number("sigma_a", 0.1);
    return xml::integrator("path") +
           "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"3, 2, 12\" "
           "target=\"0, 0, 1\" up=\"0, 1, 0\"/></transform></sensor><emitter type=\"point\"><point "
           "name=\"position\" x=\"" +
           (changed.light ? "-4" : "4") + "\" y=\"3\" z=\"9\"/></emitter>" +
           xml::constant_light(0.2) +
           xml::sphere({0, 0, changed.geometry ? 2.5 : 1.5}, changed.geometry ? 2. : 1.2,
                       xml::dielectric(1.3) + xml::medium("interior", matter)) +
           xml::shape("rectangle", "<transform name=\"to_world\"><scale value=\"9\"/></transform>");
}

class ChangingScenes : public Techniques {
  protected:
    /// Turns a scene into another in place, as its owner would.
    void change(Scene& s, const Changes& what) {
        Scene other = scene(body(what));
        // Whoever keeps what he should not would look at what is gone.
        gone_.push_back({s.lights, s.media, s.shapes});
        if (what.light) {
            s.lights = std::move(other.lights);
            s.environment = other.environment;
        }
        if (what.material) {
            for (std::size_t i = 0; i < s.shapes.size(); ++i) {
                s.shapes[i].material = other.shapes[i].material;
                s.shapes[i].interior = other.shapes[i].interior;
            }
            s.media = std::move(other.media);
        }
        if (what.geometry) s.rays = std::move(other.rays);
    }
    static Film picture(Technique& technique, const FrameSettings& frame) {
        return technique.render(frame).film;
    }
    /// Any rays, for techniques that follow rays; for frames in real time what a camera sees.
    FrameSettings frame_for(const TechniqueChoice& choice, const Scene& s,
                            const Vec3f& towards = {-3, -2, -10}) {
        const RayMaker rays = ray_bundle({3, 2, 12}, towards, 3.5f);
        FrameSettings frame = frame_of(rays, {.pixels = 40, .samples = 4});
        if (!techniques().find(choice.technique).realtime) return frame;
        frame.film.width = frame.film.height = 24;
        frame.camera = s.camera;
        return frame;
    }
    static bool same(const Film& a, const Film& b) {
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                if (!(a.mean(x, y) == b.mean(x, y))) return false;
        return true;
    }
    /// Whether a technique that was told of a change renders as one made for the new scene.
    bool follows(const TechniqueChoice& choice, const RenderPlan& plan, const Changes& what) {
        Scene s = scene(body({}));
        const FrameSettings frame = frame_for(choice, s);
        const TechniquePtr kept = prepare(s, plan);
        const Film before = picture(*kept, frame);
        change(s, what);
        kept->changed(what);
        const Film after = picture(*prepare(s, plan), frame);
        EXPECT_FALSE(same(before, after)) << "the change shows";
        return same(after, picture(*kept, frame));
    }

  private:
    struct Gone {
        std::vector<LightPtr> lights;
        std::vector<MediumPtr> media;
        std::vector<ShapeBinding> shapes;
    };
    std::vector<Gone> gone_;
};

/// All techniques that this machine can run; that there is no device is said.
std::vector<TechniqueChoice> choices(const Scene& some) {
    std::vector<TechniqueChoice> all;
    for (const TechniqueDescription* t : techniques()) {
        TechniqueChoice choice{std::string(t->name)};
        // Small pictures of few lights: software draws each of them.
        if (t->realtime) choice.options = {{"light_points", "2"}, {"light_view", "128"}};
        if (t->realtime) try {
                prepare(some, plan_of(some, choice));
            } catch (const RunError& error) {
                std::printf("without %s: %s\n", choice.technique.c_str(), error.what());
                continue;
            }
        all.push_back(choice);
    }
    all.push_back({"surface", {{"single_scattering", "on"}}});
    return all;
}

TEST_F(ChangingScenes, AreFollowed) {
    for (const TechniqueChoice& choice : choices(scene(body({}))))
        for (const Changes& what :
             {light, material, geometry,
              Changes{.view = true, .light = true, .material = true, .geometry = true}})
            EXPECT_TRUE(follows(choice, plan_of(scene(body({})), choice), what))
                << choice.technique << ": " << what.text();
}

/// What is not claimed has a reason: kept all the same, it shows a wrong picture.
TEST_F(ChangingScenes, WhatIsNotKeptWouldBeWrong) {
    for (const TechniqueDescription* t : techniques()) {
        EXPECT_TRUE(t->keeps.view) << t->name;
        if (!t->below) continue;
        for (const Changes& what : {light, material, geometry}) {
            TechniqueDescription stubborn = *t;
            stubborn.keeps = {true, true, true, true};
            RenderPlan plan = plan_of(scene(body({})), {std::string(t->name)});
            for (ShapeTechnique& s : plan.shapes)
                if (s.technique) s.technique = &stubborn;
            EXPECT_EQ(follows({std::string(t->name)}, plan, what), what.within(t->keeps))
                << t->name << ": " << what.text();
        }
    }
}

/// The view is nobody's business: nothing is told, nothing is made.
TEST_F(ChangingScenes, OtherFramesNeedNoWord) {
    const Scene s = scene(body({}));
    for (const TechniqueChoice& choice : choices(s)) {
        const TechniquePtr one = prepare(s, plan_of(s, choice)),
                           other = prepare(s, plan_of(s, choice));
        picture(*one, frame_for(choice, s));
        FrameSettings frame = frame_for(choice, s, Vec3f{-2, 1, -10});
        frame.sampler.seed = 9;
        EXPECT_TRUE(same(one->render(frame).film, other->render(frame).film)) << choice.technique;
    }
}

}  // namespace
}  // namespace nacre
