// Reading scene files: what each element of the format becomes.
#include "nacre/spectrum/color.h"
#include "nacre/text/names.h"
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

const SceneNode& child(const SceneNodePtr& node, std::size_t i) {
    return *node->children.at(i).node;
}

void expect_point(const Transform& t, const Point3f& from, const Point3f& to) {
    const Point3f p = t.point(from);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(p[i], to[i], 1e-5f) << "coordinate " << i;
}

class SceneXml : public SceneFiles {};

TEST_F(SceneXml, ReadsEveryKindOfValue) {
    const SceneNodePtr scene = read(R"(
        <shape type="sphere" id="ball">
            <float name="f" value=" -1.5e2 "/>
            <integer name="i" value="+7"/>
            <boolean name="b" value="True"/>
            <string name="s" value="a b, c"/>
            <string name="empty" value=""/>
            <point name="p" x="1" z="3"/>
            <vector name="v" value="1, 2 3"/>
            <vector name="same" value="4"/>
        </shape>)");
    const SceneNode& n = child(scene, 0);
    EXPECT_EQ(n.tag, "shape");
    EXPECT_EQ(n.type, "sphere");
    EXPECT_EQ(n.id, "ball");
    EXPECT_EQ(n.get_float("f"), -150.0);
    EXPECT_EQ(n.get_int("i", 0), 7);
    EXPECT_EQ(n.get_float("i"), 7.0);  // integers do where floats are asked for
    EXPECT_TRUE(n.get_bool("b", false));
    EXPECT_EQ(n.get_string("s"), "a b, c");
    EXPECT_EQ(n.get_string("empty"), "");
    EXPECT_EQ(n.get_vector("p", {}), Vec3d(1, 0, 3));
    EXPECT_EQ(n.get_vector("v", {}), Vec3d(1, 2, 3));
    EXPECT_EQ(n.get_vector("same", {}), Vec3d(4, 4, 4));
    EXPECT_EQ(n.get_float("absent", 2.5), 2.5);
    EXPECT_EQ(n.get_choice("absent", {"one", "two"}), "one");
    EXPECT_NO_THROW(n.check_all_used());
}

TEST_F(SceneXml, ReadsColours) {
    write("two.spd", "# nm value\n400 0.25\n\n500, 0.75 # end\n");
    const SceneNodePtr scene = read(R"(
        <bsdf type="x">
            <rgb name="three" value="0.1 0.2, 0.3"/>
            <rgb name="one" value="0.5"/>
            <rgb name="hex" value="#ff8000"/>
            <spectrum name="constant" value="2"/>
            <spectrum name="table" value="400:0.5, 500: 1 700 : 0"/>
            <spectrum name="file" filename="two.spd"/>
            <blackbody name="hot" temperature="5000K" scale="2"/>
            <spectrum name="hot3" type="blackbody"><float name="temperature" value="3000"/></spectrum>
            <spectrum name="d65" type="d65"/>
            <float name="number" value="0.7"/>
        </bsdf>)");
    const SceneNode& n = child(scene, 0);
    EXPECT_EQ(n.get_color("three")->rgb, Vec3f(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(n.get_color("one")->rgb, Vec3f(0.5f, 0.5f, 0.5f));
    const Vec3f hex = n.get_color("hex")->rgb;
    EXPECT_EQ(hex.x, 1.f);
    EXPECT_NEAR(hex.y, 0.21586f, 1e-5f);  // IEC 61966-2-1: ((128/255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(hex.z, 0.f);
    EXPECT_EQ(n.get_color("constant")->kind, ColorValue::Kind::constant);
    EXPECT_EQ(n.get_color("constant")->value, 2.f);
    EXPECT_EQ(n.get_color("table")->nm, (std::vector<float>{400, 500, 700}));
    EXPECT_EQ(n.get_color("table")->values, (std::vector<float>{0.5f, 1, 0}));
    EXPECT_EQ(n.get_color("file")->nm, (std::vector<float>{400, 500}));
    EXPECT_EQ(n.get_color("file")->values, (std::vector<float>{0.25f, 0.75f}));
    EXPECT_EQ(n.get_color("hot")->kelvin, 5000.f);
    EXPECT_EQ(n.get_color("hot")->value, 2.f);
    EXPECT_EQ(n.get_color("hot3")->kelvin, 3000.f);
    EXPECT_EQ(n.get_color("d65")->rgb, Vec3f(1, 1, 1));
    EXPECT_EQ(n.get_color("number")->kind, ColorValue::Kind::constant);
    EXPECT_EQ(n.get_color("number")->value, 0.7f);
    EXPECT_EQ(n.get_color("absent"), nullptr);
}

/// Steps of a transform and where they take (1, 2, 3), by hand.
TEST_F(SceneXml, AppliesTransformStepsInOrder) {
    const struct {
        const char* steps;
        Point3f to;
    } cases[] = {
        {R"(<translate x="1"/>)", {2, 2, 3}},
        {R"(<translate value="1, 2, 3"/>)", {2, 4, 6}},
        {R"(<scale value="2"/>)", {2, 4, 6}},
        {R"(<scale y="3"/>)", {1, 6, 3}},
        {R"(<scale value="2"/><translate x="1"/>)", {3, 4, 6}},   // scaled first, then moved
        {R"(<translate x="1"/><scale value="2"/>)", {4, 4, 6}},   // moved first, then scaled
        {R"(<rotate z="1" angle="90"/>)", {-2, 1, 3}},            // counter-clockwise about z
        {R"(<rotate value="0, 2, 0" angle="90"/>)", {3, 2, -1}},  // the axis has any length
        {R"(<rotate x="1" angle="-90"/>)", {1, 3, -2}},
        {R"(<rotate z="1" angle="90"/><rotate x="1" angle="90"/>)", {-2, -3, 1}},
        {R"(<matrix value="1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1"/>)", {6, 8, 10}},
        {R"(<matrix value="0 1 0, 1 0 0, 0 0 2"/>)", {2, 1, 6}},  // three by three
        // Looking along -z with y up, the camera's left is -x: local x goes to -x, z to -z.
        {R"(<lookat origin="0 0 10" target="0 0 0" up="0 1 0"/>)", {-1, 2, 7}},
        {R"(<scale value="2"/><lookat origin="1, 0, 0" target="2, 0, 0" up="0, 0, 1"/>)",
         {7, 2, 4}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.steps);
        const SceneNodePtr scene = read(fmt::format(
            R"(<sensor type="s"><transform name="to_world">{}</transform></sensor>)", c.steps));
        expect_point(child(scene, 0).get_transform("to_world"), {1, 2, 3}, c.to);
    }
}

TEST_F(SceneXml, LookAtWithoutUpStillLooks) {
    const SceneNodePtr scene = read(R"(<sensor type="s"><transform name="to_world">
        <lookat origin="0, 5, 0" target="0, 0, 0"/></transform></sensor>)");
    const Transform t = child(scene, 0).get_transform("to_world");
    expect_point(t, {0, 0, 0}, {0, 5, 0});
    expect_point(t, {0, 0, 5}, {0, 0, 0});
    EXPECT_FALSE(t.swaps_handedness());
}

TEST_F(SceneXml, SubstitutesParameters) {
    const char* body = R"(
        <default name="n" value="2"/>
        <default name="name" value="x"/>
        <default name="both" value="$n$name"/>
        <bsdf type="$name">
            <string name="s" value="a${n}b"/>
        </bsdf>)";
    // Braces are not part of the format: `$` is followed by the name at once.
    EXPECT_EQ(error_of([&] { read(body); }),
              "scene.xml:7:13: the parameter '$' is not defined; a name must follow the '$'");
    const char* good = R"(
        <default name="n" value="2"/>
        <default name="name" value="x"/>
        <default name="n" value="3"/>
        <bsdf type="$name"><string name="s" value="$n-$name$n"/></bsdf>)";
    // The first default holds, and the longer name wins: $name is not $n followed by "ame".
    EXPECT_EQ(child(read(good), 0).get_string("s"), "2-x2");
    EXPECT_EQ(child(read(good), 0).type, "x");
    EXPECT_EQ(child(read(good, {{"n", "9"}}), 0).get_string("s"), "9-x9");
}

TEST_F(SceneXml, IncludesFilesWithTheirDefaults) {
    write("parts/inner.xml", R"(<scene version="3.0.0"><default name="a" value="1"/>
        <bsdf type="diffuse" id="grey"/></scene>)");
    write("parts/outer.xml", R"(<scene version="3.0.0"><include filename="inner.xml"/></scene>)");
    write("single.xml", R"(<bsdf type="mirror"/>)");
    const SceneNodePtr scene = read(R"(
        <include filename="parts/outer.xml"/>
        <include filename="single.xml"/>
        <shape type="sphere"><integer name="i" value="$a"/><ref id="grey"/></shape>)");
    ASSERT_EQ(scene->children.size(), 3u);
    EXPECT_EQ(child(scene, 1).type, "mirror");
    EXPECT_EQ(child(scene, 2).get_int("i", 0), 1);
    EXPECT_EQ(child(scene, 2).children[0].node, scene->children[0].node);
}

TEST_F(SceneXml, SearchesTheFoldersOfPathElements) {
    write("sub/deep/part.xml", R"(<bsdf type="diffuse"/>)");
    const SceneNodePtr scene = read(R"(
        <path value="../no/such/folder"/>
        <path value="sub"/>
        <include filename="deep/part.xml"/>)");
    EXPECT_EQ(scene->children.size(), 1u);
    ASSERT_EQ(search_path_.size(), 3u);
    EXPECT_EQ(search_path_[0], folder_);
    EXPECT_EQ(search_path_[2], folder_ / "sub");
}

TEST_F(SceneXml, ReferencesShareTheObject) {
    const SceneNodePtr scene = read(R"(
        <medium type="homogeneous" id="milk"/>
        <alias id="milk" as="liquid"/>
        <shape type="sphere">
            <ref name="interior" id="milk"/>
            <ref name="exterior" id="liquid"/>
        </shape>)");
    const SceneNode& shape = child(scene, 1);
    EXPECT_EQ(shape.child("interior")->node, scene->children[0].node);
    EXPECT_EQ(shape.child("exterior", "medium")->node, scene->children[0].node);
    EXPECT_EQ(shape.child("interior", "bsdf"), nullptr);
}

TEST_F(SceneXml, UpgradesOldNames) {
    std::vector<std::filesystem::path> path;
    const SceneNodePtr scene = read_scene_xml(write("old.xml", R"(<scene version="0.6.0">
        <sensor type="perspective">
            <string name="fovAxis" value="smallerSide"/>
            <transform name="toWorld"><lookAt origin="0,0,1" target="0,0,0" up="0,1,0"/></transform>
            <film type="hdrfilm"><boolean name="banner" value="false"/></film>
        </sensor>
        <medium type="homogeneous" id="myMedium"><rgb name="sigmaS" value="1"/></medium>
        <shape type="sphere"><ref name="interior" id="myMedium"/></shape>
        <bsdf type="diffuse" id="b"><float name="intIOR" value="1.5"/>
            <rgb name="diffuseReflectance" value="1"/>
            <texture type="bitmap" name="t">
                <float name="uscale" value="2"/><float name="voffset" value="3"/></texture>
        </bsdf></scene>)"),
                                              {}, path);
    const SceneNode& sensor = child(scene, 0);
    EXPECT_EQ(sensor.get_string("fov_axis"), "smallerSide");  // values stay as they are
    EXPECT_FALSE(sensor.get_transform("to_world").is_identity());
    EXPECT_TRUE(sensor.children[0].node->values.empty());
    EXPECT_NE(child(scene, 1).get_color("sigma_s"), nullptr);
    // A boundary between media without a material did nothing to light.
    EXPECT_EQ(child(scene, 2).children_of("bsdf").at(0)->node->type, "null");
    EXPECT_EQ(child(scene, 3).get_float("int_ior"), 1.5);
    EXPECT_TRUE(child(scene, 3).has("reflectance"));
    const Transform uv = child(scene, 3).children[0].node->get_transform("to_uv");
    expect_point(uv, {1, 1, 0}, {2, 4, 0});
}

TEST_F(SceneXml, IgnoresCommentsAndTheMarkOfUtf8) {
    std::vector<std::filesystem::path> path;
    const SceneNodePtr scene =
        read_scene_xml(write("marked.xml",
                             "\xEF\xBB\xBF<?xml version=\"1.0\"?><!-- <shape> --><scene "
                             "version=\"2.1.0\"><!-- a --><bsdf type=\"x\"/></scene>"),
                       {}, path);
    EXPECT_EQ(scene->children.size(), 1u);
    EXPECT_EQ(child(scene, 0).location.column, 71);
}

TEST_F(SceneXml, KnowsWhereThingsStand) {
    const SceneNodePtr scene =
        read("  <bsdf type=\"x\">\n   <float name=\"f\"\n value=\"1\"/></bsdf>");
    EXPECT_EQ(child(scene, 0).location.line, 2);
    EXPECT_EQ(child(scene, 0).location.column, 3);
    EXPECT_EQ(child(scene, 0).values[0].location.line, 3);
    EXPECT_EQ(child(scene, 0).values[0].location.column, 4);
}

}  // namespace
}  // namespace nacre
