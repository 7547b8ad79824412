#include <epoxy/gl.h>

#include "apps/viewer/save_scene.h"
#include "nacre/text/whole_file.h"
#include "tests/support/error_of.h"
#include "tests/viewer/device.h"
#include "tests/viewer/scenes.h"

namespace nacre::test {
namespace {

using viewer::deformed;
using viewer::is_realtime;
using viewer::Patience;
using viewer::set_option;
using viewer::ViewerFrames;
using viewer::ViewerScene;
using viewer::ViewerState;

constexpr int size = 32;

class ViewerFrame : public OnDevice {};

Image picture_of(const Film& film) {
    Image image(film.width(), film.height());
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f c = film.mean(x, y);
            for (int k = 0; k < 3; ++k) image.at(x, y, k) = c[k];
        }
    return image;
}

/// As `nacre render --technique` makes it.
Image rendered(const Scene& scene, const TechniqueChoice& choice, int samples) {
    FrameSettings frame = FrameSettings::of(scene);
    frame.sampler.samples = samples;
    return picture_of(render(scene, plan_of(scene, choice), frame).film);
}

class LongViewerFrame : public OnDevice {};

TEST_F(LongViewerFrame, AreThePictureThatRenderMakesOfTheSameTechnique) {
    const ViewerScene scene = ball(size);
    const ViewerState state = scene.state();  // with the quality that frames of render have
    ASSERT_TRUE(is_realtime(state.technique));
    const Image reference = rendered(scene.scene, state.technique, 3);
    EXPECT_LT(difference(reference, frames_of(scene, state, size, size, 3)), 1e-5);
    EXPECT_GT(difference(reference, frames_of(scene, state, size, size, 1)), 1e-2);
}

TEST_F(LongViewerFrame, OfWhatChangedAreThoseOfWhoNeverSawItOtherwise) {
    const ViewerScene scene = ball(size);
    const ViewerState first = quick(scene.state());
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(first, size, size);
    frames.render(first, size, size);
    Image last = frames.image();
    ViewerState state = first;
    const struct {
        const char* what;
        std::function<void()> change;
    } cases[] = {
        {"light", [&] { state.lights[scene.key_light].azimuth += 60; }},
        {"brightness", [&] { state.lights[0].brightness = 3; }},
        {"material",
         [&] {
             state.material = {.kind = viewer::MaterialEdit::Kind::measured, .name = "ketchup"};
         }},
        {"form",
         [&] {
             state.deformation = {Deformation::Kind::bend, 0.5f, 0.f};
         }},
        {"more of it", [&] { state.deformation.amount = 0.8f; }},
        {"option", [&] { set_option(state.technique, "taps", "7"); }},
        {"camera", [&] { state.camera.turn(40, 10); }},
        {"places on lamps", [&] { state.quality.light_points = 2; }},
        {"at rest", [&] { state.deformation = {}; }},
        {"all of it", [&] { state = first; }},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        c.change();
        frames.render(state, size, size);
        const Image now = frames.image();
        EXPECT_GT(difference(last, now), 1e-3);
        EXPECT_LT(difference(frames_of(scene, state, size, size), now), 1e-6);
        EXPECT_EQ(frames.sides().at(0).samples, 1);
        last = now;
    }
}

TEST_F(ViewerFrame, OfOtherMatterAreThoseOfWhoNeverSawItOtherwise) {
    const ViewerScene scene = ball(16);
    ViewerState state = quick(scene.state());
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(state, 16, 16);
    const Image before = frames.image();
    state.material = {.kind = viewer::MaterialEdit::Kind::measured, .name = "ketchup"};
    frames.render(state, 16, 16);
    EXPECT_GT(difference(before, frames.image()), 1e-2);
    EXPECT_LT(difference(frames_of(scene, state, 16, 16), frames.image()), 1e-6);
}

TEST_F(ViewerFrame, OfALightThatMovesComeAtOnceAndAreWholeOnceItStays) {
    const ViewerScene scene = ball(16);
    ViewerState state = quick(scene.state());
    state.quality.light_points = 24;  // one place on a lamp is another before and after
    ViewerFrames frames(*gpu_, scene, Patience::none);
    frames.render(state, 16, 16);
    const Image before = frames.image();
    state.lights[scene.key_light] = {200, 50, 3};
    frames.render(state, 16, 16);
    const Image at_once = frames.image(), whole = frames_of(scene, state, 16, 16);
    EXPECT_TRUE(frames.goes_on());
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    frames.render(state, 16, 16);
    EXPECT_LT(difference(whole, frames.image()), 1e-6);
    // In the object's middle. Far away on the floor few places on a lamp are no good mean of its
    // light, wherever they are; and mirrors show lamps where they were.
    double missed = 0, moved = 0;
    for (int y = 6; y < 12; ++y)
        for (int x = 5; x < 9; ++x)
            for (int c = 0; c < 3; ++c) {
                missed += std::abs(double(at_once.at(x, y, c)) - double(whole.at(x, y, c)));
                moved += std::abs(double(before.at(x, y, c)) - double(whole.at(x, y, c)));
            }
    EXPECT_LT(missed, 0.2 * moved);
}

TEST_F(ViewerFrame, AverageWhileNothingChangesAndOtherwiseStayTheFirst) {
    const ViewerScene scene = ball(size);
    ViewerState state = quick(scene.state());
    ViewerFrames frames(*gpu_, scene, Patience::none);
    for (int i = 1; i <= 3; ++i) {
        frames.render(state, size, size);
        EXPECT_EQ(frames.sides().at(0).samples, i);
    }
    // What only the screen shows otherwise leaves the average alone.
    state.display.exposure = 1;
    frames.render(state, size, size);
    EXPECT_EQ(frames.sides().at(0).samples, 4);
    EXPECT_TRUE(frames.goes_on());
    state.quality.average = false;
    frames.render(state, size, size);
    const Image first = frames.image();
    frames.render(state, size, size);
    EXPECT_EQ(difference(first, frames.image()), 0);
    EXPECT_FALSE(frames.goes_on());
}

TEST_F(ViewerFrame, SplitShowsEachTechniqueAsItIsInTheWholePicture) {
    const ViewerScene scene = ball(size);
    ViewerState state = quick(scene.state());
    const Image left = frames_of(scene, state, size, size);
    ViewerState other = state;
    set_option(other.technique, "profile", "gaussian_sum");
    const Image right = frames_of(scene, other, size, size);
    state.split = true;
    state.beside = other.technique;
    state.divider = 0.4;
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(state, size, size);
    const Image both = frames.image();
    EXPECT_EQ(frames.first_width(), 13);
    // The projection of a part of the picture rounds otherwise than that of the whole.
    EXPECT_LT(difference(left, both, 0, 13), 5e-3);
    EXPECT_LT(difference(right, both, 13), 5e-3);
    EXPECT_GT(difference(left, both, 13), 2e-2);
}

TEST_F(LongViewerFrame, BesideTheTruthAreOfTheSameCameraLightMatterAndForm) {
    const ViewerScene scene = ball(size);
    ViewerState state = quick(scene.state());
    state.split = true;
    state.beside = {"volpath"};
    state.samples = 3;
    state.camera.turn(30, 5);
    state.lights[scene.key_light] = {120, 30, 2};
    state.material = {.kind = viewer::MaterialEdit::Kind::measured, .name = "skin1"};
    state.deformation = {Deformation::Kind::twist, 1.f, 0.f};
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(state, size, size);
    EXPECT_EQ(frames.sides().at(1).technique, "volpath");
    EXPECT_EQ(frames.sides().at(1).samples, 3);
    const viewer::SceneParts parts = scene.parts_of(state);
    const Scene shown =
        rebuild(scene.scene, parts.root, deformed(scene.scene, parts.meshes, state.deformation));
    FrameSettings frame = FrameSettings::of(shown);
    frame.camera = state.camera.camera(1);
    frame.sampler.samples = 3;
    const Image truth = picture_of(render(shown, plan_of(shown, {"volpath"}), frame).film);
    EXPECT_LT(difference(truth, frames.image(), size / 2), 1e-5);
    EXPECT_GT(difference(truth, frames.image(), 0, size / 2), 1e-2);
}

TEST_F(ViewerFrame, BendTheMeshOnTheDeviceAsInTheTruth) {
    const ViewerScene scene = ball(size);
    const viewer::SceneParts parts = scene.parts_of(scene.state());
    for (const Deformation& d : {Deformation{Deformation::Kind::twist, 1.2f, 0.3f},
                                 Deformation{Deformation::Kind::bend, 0.9f, 0.5f},
                                 Deformation{Deformation::Kind::breathe, 0.2f, 1.f}}) {
        FrameRenderer renderer(*gpu_, scene.scene,
                               plan_of(scene.scene, scene.state().technique).shapes);
        renderer.deform(d);
        const GpuShape& shape = renderer.scene().shapes().at(0);
        const SceneMeshes bent = deformed(scene.scene, parts.meshes, d);
        const Mesh& mesh = *bent.at(shape.shape);
        ASSERT_EQ(mesh.positions.size(), shape.vertices);
        std::vector<std::array<float, 4>> places(shape.vertices), normals(shape.vertices);
        const std::size_t bytes = places.size() * sizeof(places[0]);
        renderer.scene().positions().read(0, bytes, places.data());
        renderer.scene().normals().read(0, bytes, normals.data());
        double moved = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_NEAR(places[i][k], mesh.positions[i][int(k)], 2e-3);
                // Normals are differences of places a thousandth of the box apart.
                EXPECT_NEAR(normals[i][k], mesh.normals[i][int(k)], 2e-3);
                moved = std::max(moved,
                                 std::abs(double(places[i][k]) -
                                          double(parts.meshes[shape.shape]->positions[i][int(k)])));
            }
        EXPECT_GT(moved, 5);
    }
}

TEST_F(ViewerFrame, OfASavedSceneAreTheSame) {
    const ViewerScene scene = ball(size);
    const SceneFolder folder;
    ViewerState state = quick(scene.state());
    state.camera.turn(30, 5);
    state.camera.zoom(0.8);
    state.lights[scene.key_light] = {120, 30, 2};
    state.material = {.kind = viewer::MaterialEdit::Kind::artist};
    state.deformation = {Deformation::Kind::twist, 1.f, 0.f};
    set_option(state.technique, "taps", "14");
    set_option(state.technique, "profile", "gaussian_sum");
    const auto saved = save_scene(scene, state, 40, size, folder.file("saved.xml"));
    EXPECT_EQ(saved.files.size(), 2u);
    EXPECT_TRUE(saved.left_out.empty());
    const ViewerScene again(load_scene(folder.file("saved.xml")), "saved.xml", {});
    EXPECT_EQ(again.scene.film.width, 40);
    // The scene's own technique and options, without anybody asking for them.
    const RenderPlan plan = plan_of(again.scene);
    const ShapeTechnique* technique = nullptr;
    for (const ShapeTechnique& s : plan.shapes)
        if (s.technique) technique = &s;
    ASSERT_TRUE(technique);
    EXPECT_EQ(technique->technique->name, state.technique.technique);
    EXPECT_EQ(technique->options.whole("taps"), 14);
    EXPECT_EQ(technique->options.word("profile"), "gaussian_sum");
    ViewerState plain = again.state();
    plain.technique = state.technique;
    plain.quality = state.quality;
    const Image shown = frames_of(scene, state, 40, size),
                loaded = frames_of(again, plain, 40, size);
    // Normals of the bent mesh differ in their last digits.
    double sum = 0, error = 0;
    for (std::size_t i = 0; i < shown.data.size(); ++i) {
        sum += double(shown.data[i]);
        error += std::abs(double(shown.data[i]) - double(loaded.data[i]));
    }
    EXPECT_LT(error, 1e-3 * sum);
}

TEST_F(ViewerFrame, RefuseWhatATechniqueRefusesAndGoOnAfterwards) {
    const ViewerScene scene = ball(size);
    const ViewerState good = quick(scene.state());
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(good, size, size);
    const Image before = frames.image();
    ViewerState bad = good;
    bad.technique = {"translucent_shadow_map",
                     {{"placement", "paper"}, {"profile", "gaussian_sum"}}};
    EXPECT_EQ(error_of([&] { frames.render(bad, size, size); }),
              "placement 'paper' moves the two sources of the dipole: give profile 'dipole', or "
              "placement 'distance'");
    frames.render(good, size, size);
    EXPECT_EQ(difference(before, frames.image()), 0);
}

TEST_F(ViewerFrame, ShownInFalseColoursAreLuminanceOnTheScale) {
    const ViewerScene scene = ball(size);
    ViewerState state = quick(scene.state());
    ViewerFrames frames(*gpu_, scene, Patience::all_samples);
    frames.render(state, size, size);
    state.display = {.quantity = viewer::Quantity::luminance, .low = 1e3, .high = 1e5};
    const Image image = frames.image();
    const std::vector<float> shown = frames.shown(state).read();
    for (int y = 0; y < size; y += 5)
        for (int x = 0; x < size; x += 5) {
            const Vec3f rgb{image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
            // 683 lm/W over the integral of ybar; Y of linear sRGB.
            const double cd = (0.2127 * rgb.x + 0.7151 * rgb.y + 0.0722 * rgb.z) * 683 * 106.857;
            const Vec3f want = viewer::false_color(float((std::log10(cd) - 3) / 2));
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(shown[std::size_t(4 * (y * size + x) + k)], want[k], 0.012);
        }
}

/// Megabytes of this process that are in memory.
double resident() {
    std::ifstream in("/proc/self/statm");
    double total = 0, pages = 0;
    in >> total >> pages;
    return pages * double(sysconf(_SC_PAGESIZE)) * 1e-6;
}
/// Textures, buffers and programs that there are. Names are looked through up to a fresh one, since
/// drivers need not give those again that came back.
std::array<int, 3> objects() {
    GLuint texture = 0, buffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glCreateBuffers(1, &buffer);
    const GLuint program = glCreateProgram();
    glDeleteTextures(1, &texture);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
    std::array<int, 3> count{};
    for (GLuint name = 1; name < std::max({texture, buffer, program}); ++name) {
        count[0] += glIsTexture(name);
        count[1] += glIsBuffer(name);
        count[2] += glIsProgram(name);
    }
    return count;
}

TEST_F(LongViewerFrame, LeaveNothingBehindIn1000SwitchesAndResizes) {
    const ViewerScene scene = ball(size);
    ViewerState state = quick(scene.state());
    std::vector<TechniqueChoice> choices;
    for (const TechniqueDescription* t : viewer::viewer_techniques())
        if (t->realtime) choices.push_back({std::string(t->name)});
    choices.push_back({"translucent_shadow_map", {{"taps", "7"}}});
    ViewerFrames frames(*gpu_, scene, Patience::none);
    const auto go = [&](int from, int to) {
        for (int i = from; i < to; ++i) {
            state.technique = choices[std::size_t(i) % choices.size()];
            state.split = i % 3 == 0;
            state.beside = choices[std::size_t(i + 1) % choices.size()];
            frames.render(state, 8 + i % 7, 8 + i % 5);
            frames.shown(state);
        }
    };
    // All combinations of techniques, sides and sizes have come by then, and come again at the end.
    const int round = 105 * int(choices.size());
    go(0, round);
    const auto before = objects();
    EXPECT_GT(before[0], 10);
    const double memory = resident();
    const int rounds = (1000 + round - 1) / round;
    go(round, (1 + rounds) * round);
    EXPECT_EQ(objects(), before);
    EXPECT_LT(resident(), memory + 8);
}

}  // namespace
}  // namespace nacre::test
