// Wrong scene files: each says what is wrong, where, and how to mend it.
#include "tests/scene/scene_files.h"

namespace nacre {
namespace {

struct Wrong {
    const char* name;
    /// Between <scene version="3.0.0"> (line 1) and </scene>; begins on line 2.
    const char* body;
    const char* message;
};

void PrintTo(const Wrong& w, std::ostream* out) { *out << w.name; }
std::string name_of(const testing::TestParamInfo<Wrong>& info) { return info.param.name; }

class WrongScene : public SceneFiles, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongScene, IsRefused) {
    // gtest's names of such tests hold a slash, which would be a folder.
    std::filesystem::remove_all(folder_);
    folder_ = std::filesystem::path(testing::TempDir()) /
              fmt::format("nacre_wrong_{}_{}", getpid(), GetParam().name);
    const std::filesystem::path file = write(
        "scene.xml", fmt::format("<scene version=\"3.0.0\">\n{}\n</scene>\n", GetParam().body));
    EXPECT_EQ(error_of([&] { load_scene(file); }), GetParam().message);
}

// Elements, attributes and values.
const Wrong syntax[] = {
    {"UnknownElement", R"(<bsfd type="diffuse"/>)",
     "scene.xml:2:1: unknown element <bsfd>; did you mean <bsdf>?"},
    {"UnknownElementNothingNear", R"(<photonmapper/>)",
     "scene.xml:2:1: unknown element <photonmapper>"},
    {"UnknownAttribute", R"(<bsdf type="diffuse"><float name="f" valeu="1"/></bsdf>)",
     "scene.xml:2:22: <float> has no attribute 'valeu'; did you mean 'value'?"},
    {"MissingAttribute", R"(<bsdf type="diffuse"><float name="f"/></bsdf>)",
     "scene.xml:2:22: <float> needs the attribute 'value'"},
    {"MissingName", R"(<bsdf type="diffuse"><float value="1"/></bsdf>)",
     "scene.xml:2:22: <float> needs the attribute 'name'"},
    {"MissingType", R"(<shape id="x"/>)", "scene.xml:2:1: <shape> needs the attribute 'type'"},
    {"AttributeTwice", R"(<bsdf type="diffuse" type="null"/>)",
     "scene.xml:2:1: <bsdf> has the attribute 'type' twice"},
    {"FloatWithTail", R"(<float name="mm_per_unit" value="1.5mm"/>)",
     "scene.xml:2:1: '1.5mm' is not a number"},
    {"FloatNotFinite", R"(<float name="mm_per_unit" value="nan"/>)",
     "scene.xml:2:1: 'nan' is not a number"},
    {"IntegerWithTail",
     R"(<integrator type="path"><integer name="max_depth" value="3.0"/></integrator>)",
     "scene.xml:2:25: '3.0' is not an integer"},
    {"IntegerTooLarge",
     R"(<integrator type="path"><integer name="max_depth" value="99999999999999999999"/></integrator>)",
     "scene.xml:2:25: '99999999999999999999' is too large for an integer"},
    {"BooleanIsNumber",
     R"(<integrator type="path"><boolean name="hide_emitters" value="1"/></integrator>)",
     "scene.xml:2:25: '1' is neither 'true' nor 'false'"},
    {"VectorOfTwo", R"(<shape type="sphere"><point name="center" value="1, 2"/></shape>)",
     "scene.xml:2:22: <point> takes one or three numbers; got 2"},
    {"VectorBothWays", R"(<shape type="sphere"><point name="center" value="1" x="2"/></shape>)",
     "scene.xml:2:22: <point> takes 'value' or x, y, z, not both"},
    {"VectorOfNothing", R"(<shape type="sphere"><point name="center"/></shape>)",
     "scene.xml:2:22: <point> needs 'value' or x, y, z"},
    {"RgbOfTwo", R"(<bsdf type="diffuse"><rgb name="reflectance" value="1 2"/></bsdf>)",
     "scene.xml:2:22: <rgb> takes one or three numbers; got 2"},
    {"RgbBadHex", R"(<bsdf type="diffuse"><rgb name="reflectance" value="#12345g"/></bsdf>)",
     "scene.xml:2:22: '#12345g' is not a colour of the form #rrggbb"},
    {"SpectrumDecreases",
     R"(<bsdf type="diffuse"><spectrum name="reflectance" value="500:1, 400:1"/></bsdf>)",
     "scene.xml:2:22: wavelengths must increase; 400 nm follows 500 nm"},
    {"SpectrumOfOne", R"(<bsdf type="diffuse"><spectrum name="reflectance" value="500:1"/></bsdf>)",
     "scene.xml:2:22: a spectrum needs at least two wavelengths"},
    {"SpectrumNoPair",
     R"(<bsdf type="diffuse"><spectrum name="reflectance" value="400:1, 500"/></bsdf>)",
     "scene.xml:2:22: '500' is not a pair 'wavelength:value'"},
    {"SpectrumNegative",
     R"(<bsdf type="diffuse"><spectrum name="reflectance" value="400:1, 500:-1"/></bsdf>)",
     "scene.xml:2:22: a spectrum cannot be negative; got -1"},
    {"SpectrumTwoSources",
     R"(<bsdf type="diffuse"><spectrum name="reflectance" value="1" filename="a.spd"/></bsdf>)",
     "scene.xml:2:22: <spectrum> takes either 'value' or 'filename'"},
    {"SpectrumType",
     R"(<emitter type="constant"><spectrum name="radiance" type="black_body"/></emitter>)",
     "scene.xml:2:26: unknown spectrum type 'black_body'; did you mean 'blackbody'?"},
    {"BlackbodyCold",
     R"(<emitter type="constant"><blackbody name="radiance" temperature="0"/></emitter>)",
     "scene.xml:2:26: the temperature of <blackbody> must be positive"},
    {"MatrixOfFive",
     R"(<shape type="sphere"><transform name="to_world"><matrix value="1 2 3 4 5"/></transform></shape>)",
     "scene.xml:2:49: <matrix> takes 16 or 9 numbers; got 5"},
    {"RotateNoAxis",
     R"(<shape type="sphere"><transform name="to_world"><rotate x="0" angle="3"/></transform></shape>)",
     "scene.xml:2:49: the axis of <rotate> must not be zero"},
    {"LookAtItself",
     R"(<shape type="sphere"><transform name="to_world"><lookat origin="1 2 3" target="1 2 3"/></transform></shape>)",
     "scene.xml:2:49: origin and target of <lookat> are the same point"},
    {"StepUnknown",
     R"(<shape type="sphere"><transform name="to_world"><lookAt origin="0" target="1"/></transform></shape>)",
     "scene.xml:2:49: <lookAt> cannot stand in <transform>; did you mean 'lookat'?"},
    {"StepOutsideTransform", R"(<shape type="sphere"><scale value="2"/></shape>)",
     "scene.xml:2:22: <scale> must stand in a <transform>"},
    {"TextInShape", R"(<shape type="sphere">radius 3</shape>)",
     "scene.xml:2:22: text cannot stand here: 'radius 3'"},
    {"ValueHoldsValue",
     R"(<shape type="sphere"><float name="radius" value="1"><float name="a" value="1"/></float></shape>)",
     "scene.xml:2:22: <float> cannot hold anything"},
    {"DefaultInShape", R"(<shape type="sphere"><default name="a" value="1"/></shape>)",
     "scene.xml:2:22: <default> must stand directly in <scene>"},
    {"NeverClosed", "<shape type=\"sphere\">\n  <float name=\"radius\" value=\"1\">\n</shape>",
     "scene.xml:3:3: <float> is never closed; </float> is missing before </shape>"},
    {"QuoteNeverClosed", R"(<shape type="sphere/>)",
     "scene.xml:2:1: this tag is never closed: a '>' or a quote is missing"},
    {"CommentNeverClosed", "<!-- a comment",
     "scene.xml:2:1: this comment or declaration is never closed"},
};
INSTANTIATE_TEST_SUITE_P(Syntax, WrongScene, testing::ValuesIn(syntax), name_of);

// Names, references and files.
const Wrong names[] = {
    {"ReferenceUnknown", R"(<bsdf type="diffuse" id="grey"/>
<shape type="sphere"><ref id="gray"/></shape>)",
     "scene.xml:3:22: no object has the id 'gray'; did you mean 'grey'?"},
    {"ReferenceForward", R"(<shape type="sphere"><ref id="grey"/></shape>
<bsdf type="diffuse" id="grey"/>)",
     "scene.xml:2:22: 'grey' is defined only later, at scene.xml:3:1; move it up"},
    {"IdTwice", R"(<bsdf type="diffuse" id="a"/>
<bsdf type="null" id="a"/>)",
     "scene.xml:3:1: the id 'a' is taken; it was given at scene.xml:2:1"},
    {"ParameterTwice", R"(<shape type="sphere"><float name="radius" value="1"/>
<float name="radius" value="2"/></shape>)",
     "scene.xml:3:1: 'radius' is given twice; first at scene.xml:2:22"},
    {"ChildTwice", R"(<medium type="homogeneous" id="m"/><shape type="sphere">
<ref name="interior" id="m"/>
<ref name="interior" id="m"/></shape>)",
     "scene.xml:4:1: 'interior' is given twice; first at scene.xml:3:1"},
    {"UndefinedParameter", R"(<default name="spp" value="4"/>
<shape type="$ssp"/>)",
     "scene.xml:3:1: the parameter '$ssp' is not defined; did you mean '$spp'?"},
    {"UndefinedParameterNothingNear", R"(<shape type="$kind"/>)",
     "scene.xml:2:1: the parameter '$kind' is not defined; give it by <default> or -D kind=..."},
    {"IncludeMissing", R"(<path value="parts"/><include filename="a.xml"/>)",
     "scene.xml:2:22: cannot find 'a.xml'; searched in: , parts"},
    {"IncludeItself", R"(<include filename="scene.xml"/>)",
     "scene.xml:2:1: cyclic include: scene.xml includes scene.xml"},
    {"MeshMissing", R"(<shape type="obj"><string name="filename" value="a.obj"/></shape>)",
     "scene.xml:2:19: cannot find 'a.obj'; searched in: "},
    {"SpectrumMissing",
     R"(<bsdf type="diffuse"><spectrum name="reflectance" filename="a.spd"/></bsdf>)",
     "scene.xml:2:22: cannot find 'a.spd'; searched in: "},
};
INSTANTIATE_TEST_SUITE_P(Names, WrongScene, testing::ValuesIn(names), name_of);

// Objects and their parameters.
const Wrong objects[] = {
    {"Nothing", "",
     "scene.xml:1:1: the scene has neither a <shape> nor a light at infinity: there "
     "is nothing to render"},
    {"ShapeUnknown", R"(<shape type="spere"/>)",
     "scene.xml:2:1: unknown shape type 'spere'; did you mean 'sphere'?"},
    {"ShapeInstance", R"(<shape type="instance"/>)",
     "scene.xml:2:1: <shape type=\"instance\">: nacre has no instances; write every shape by "
     "itself"},
    {"ShapeWithoutFile", R"(<shape type="ply"/>)",
     "scene.xml:2:1: <shape type=\"ply\"> needs a string 'filename'"},
    {"ParameterUnknown", R"(<shape type="sphere"><float name="radios" value="1"/></shape>)",
     "scene.xml:2:22: <shape type=\"sphere\"> has no parameter 'radios'; did you mean 'radius'?"},
    {"ParameterOfWrongType", R"(<shape type="sphere"><string name="radius" value="1"/></shape>)",
     "scene.xml:2:22: 'radius' of <shape type=\"sphere\"> is a string, but a float was expected"},
    {"IntegerIsFloat",
     R"(<integrator type="path"><float name="max_depth" value="3"/></integrator>)",
     "scene.xml:2:25: 'max_depth' of <integrator type=\"path\"> is a float, but an integer was "
     "expected"},
    {"RadiusNegative", R"(<shape type="sphere"><float name="radius" value="-1"/></shape>)",
     "scene.xml:2:22: 'radius' of <shape type=\"sphere\"> must be positive; got -1"},
    {"SphereSquashed",
     R"(<shape type="sphere"><transform name="to_world"><scale x="2"/></transform></shape>)",
     "scene.xml:2:22: a sphere must stay a sphere: use the same scale along all axes, or a mesh"},
    {"CylinderFlat", R"(<shape type="cylinder"><point name="p1" value="0"/></shape>)",
     "scene.xml:2:24: the ends p0 and p1 of a cylinder must not be the same point"},
    {"TwoMaterials", R"(<shape type="sphere"><bsdf type="diffuse"/>
<bsdf type="null"/></shape>)",
     "scene.xml:3:1: a second <bsdf> in <shape type=\"sphere\">; the first is at scene.xml:2:22"},
    {"MediumUnnamed", R"(<shape type="sphere"><medium type="homogeneous"/></shape>)",
     "scene.xml:2:22: a medium of a shape is named 'interior' or 'exterior'"},
    {"EmitterInShape", R"(<shape type="sphere"><emitter type="point"/></shape>)",
     "scene.xml:2:22: <emitter type=\"point\"> cannot stand in a shape; only type 'area' can"},
    {"AreaOutsideShape", R"(<emitter type="area"/>)",
     "scene.xml:2:1: <emitter type=\"area\"> belongs into a <shape>, whose surface shines"},
    {"EmitterUnknown", R"(<emitter type="sun"/>)",
     "scene.xml:2:1: unknown emitter type 'sun'; known are: point, spot, directional, constant, "
     "envmap"},
    {"TwoEnvironments", R"(<emitter type="constant"/>
<emitter type="constant"/>)",
     "scene.xml:3:1: a second light at infinity; the first is at scene.xml:2:1"},
    {"FilmInShape", R"(<shape type="sphere"><film type="hdrfilm"/></shape>)",
     "scene.xml:2:22: <shape type=\"sphere\"> cannot hold <film type=\"hdrfilm\">"},
    {"SubsurfaceOfNothing", R"(<shape type="sphere"><subsurface type="dipole"/></shape>)",
     "scene.xml:2:22: say what the object is made of: 'material', or 'sigma_s' and 'sigma_a'"},
    {"SubsurfaceTwice",
     R"(<shape type="sphere"><subsurface type="dipole"><string name="material" value="marble"/></subsurface>
<subsurface type="dipole"><string name="material" value="marble"/></subsurface></shape>)",
     "scene.xml:3:1: a second <subsurface> in <shape type=\"sphere\">; the first is at "
     "scene.xml:2:22"},
    {"SubsurfaceAndMedium",
     R"(<shape type="sphere"><medium name="interior" type="homogeneous"/>
<subsurface type="dipole"><string name="material" value="marble"/></subsurface></shape>)",
     "scene.xml:3:1: a shape has either a <subsurface> or a medium inside, not both"},
    {"SubsurfaceNegative",
     R"(<shape type="sphere"><subsurface type="dipole"><float name="sigma_s" value="1"/>
<float name="sigma_a" value="-1"/></subsurface></shape>)",
     "scene.xml:3:1: 'sigma_a' must be finite and at least 0, but has the value -1"},
    {"SubsurfaceAlbedo",
     R"(<shape type="sphere"><subsurface type="dipole"><float name="sigma_t" value="1"/>
<float name="albedo" value="1.5"/></subsurface></shape>)",
     "scene.xml:3:1: 'albedo' must lie within [0, 1], but has the value 1.5"},
    {"SubsurfaceBoundary",
     R"(<shape type="sphere"><bsdf type="diffuse"/>
<subsurface type="dipole"><string name="material" value="marble"/></subsurface></shape>)",
     "scene.xml:3:1: the shape's <bsdf> must be a dielectric without dispersion or tint, smooth or "
     "equally rough everywhere, or be left out"},
    {"SubsurfaceIndex",
     R"(<shape type="sphere"><bsdf type="dielectric"/><subsurface type="dipole">
<string name="material" value="marble"/><float name="int_ior" value="1.3"/></subsurface></shape>)",
     "scene.xml:3:41: the shape's own <bsdf> says what its indices are; leave 'int_ior' out"},
    {"FigureUnknown", R"(<shape type="figure"><string name="name" value="teapot"/></shape>)",
     "scene.xml:2:22: 'name' of <shape type=\"figure\"> cannot be 'teapot'; known are: bust, pot, "
     "drape"},
    {"MaterialUnknown", R"(<bsdf type="difuse"/>)",
     "scene.xml:2:1: unknown bsdf type 'difuse'; did you mean 'diffuse'?"},
    {"ReflectanceAboveOne", R"(<bsdf type="diffuse"><rgb name="reflectance" value="2"/></bsdf>)",
     "scene.xml:2:22: 'reflectance' of <bsdf type=\"diffuse\"> must lie within [0, 1], lest energy "
     "appear from nowhere; got 2"},
    {"RadianceNegative",
     R"(<emitter type="constant"><rgb name="radiance" value="1 -1 1"/></emitter>)",
     "scene.xml:2:26: a colour cannot be negative; got -1"},
    {"TwoSensors", R"(<emitter type="constant"/><sensor type="perspective"/>
<sensor type="perspective"/>)",
     "scene.xml:3:1: a second <sensor>; the first is at scene.xml:2:27"},
    {"SensorUnknown", R"(<emitter type="constant"/><sensor type="perspektive"/>)",
     "scene.xml:2:27: unknown sensor type 'perspektive'; did you mean 'perspective'?"},
    {"SamplerUnknown",
     R"(<emitter type="constant"/><sensor type="perspective"><sampler type="multijitter"/></sensor>)",
     "scene.xml:2:54: unknown sampler type 'multijitter'; known are: independent, stratified, "
     "sobol"},
    {"SamplesNone",
     R"(<emitter type="constant"/><sensor type="perspective"><sampler type="sobol"><integer name="sample_count" value="0"/></sampler></sensor>)",
     "scene.xml:2:76: 'sample_count' of <sampler type=\"sobol\"> must lie within [1, 2147483647]; "
     "got 0"},
    {"FilterUnknown",
     R"(<emitter type="constant"/><sensor type="perspective"><film type="hdrfilm"><rfilter type="gauss"/></film></sensor>)",
     "scene.xml:2:75: unknown rfilter type 'gauss'; did you mean 'gaussian'?"},
    {"CropOutside",
     R"(<emitter type="constant"/><sensor type="perspective"><film type="hdrfilm"><integer name="crop_width" value="800"/></film></sensor>)",
     "scene.xml:2:75: 'crop_width' of <film type=\"hdrfilm\"> must lie within [1, 768]; got 800"},
    {"QuantityUnknown",
     R"(<emitter type="constant"/><sensor type="perspective"><film type="hdrfilm"><string name="quantity" value="luminence"/></film></sensor>)",
     "scene.xml:2:75: 'quantity' of <film type=\"hdrfilm\"> cannot be 'luminence'; did you mean "
     "'luminance'?"},
    {"IntegratorUnknown", R"(<integrator type="bdpt"/>)",
     "scene.xml:2:1: unknown integrator type 'bdpt'; known are: path, volpath, volpathmis, ray, "
     "legacy, moment"},
    {"MomentOfNothing", R"(<integrator type="moment"/>)",
     "scene.xml:2:1: <integrator type=\"moment\"> wraps exactly one <integrator>; got 0"},
    {"UnitZero", R"(<float name="mm_per_unit" value="0"/>)",
     "scene.xml:2:1: 'mm_per_unit' must be positive; got 0"},
    {"SceneParameterUnknown", R"(<float name="mm_per_units" value="1"/><emitter type="constant"/>)",
     "scene.xml:2:1: <scene> has no parameter 'mm_per_units'; did you mean 'mm_per_unit'?"},
};
INSTANTIATE_TEST_SUITE_P(Objects, WrongScene, testing::ValuesIn(objects), name_of);

class WrongFile : public SceneFiles {
  protected:
    std::string error(const std::string& name, const std::string& text) const {
        const std::filesystem::path file = write(name, text);
        return error_of([&] { load_scene(file); });
    }
};

TEST_F(WrongFile, IsNotAScene) {
    EXPECT_EQ(error_of([&] { load_scene(folder_ / "none.xml"); }),
              "none.xml: cannot be opened; is the name right and the file readable?");
    EXPECT_EQ(error_of([&] { load_scene(folder_ / "."); }), ".: is a folder; name a scene file");
    EXPECT_EQ(error("empty.xml", ""), "empty.xml:1:1: the file is empty");
    EXPECT_EQ(error("blank.xml", " \n "), "blank.xml:1:1: the file is empty");
    EXPECT_EQ(error("comment.xml", "<!-- nothing -->"),
              "comment.xml:1:17: the file holds no element");
    EXPECT_EQ(error("killeroo.pbrt", "LookAt 0 0 5"),
              "killeroo.pbrt:1:1: is a pbrt scene, not an XML scene; nacre reads Mitsuba 3's XML, "
              "so convert it first");
    EXPECT_EQ(error("a.xml", "\nhello <scene>"),
              "a.xml:2:1: is not an XML scene; nacre reads Mitsuba 3's XML, which begins with "
              "<scene");
    EXPECT_EQ(error("a.xml", std::string("<scene\0\1\2", 9)),
              "a.xml:1:1: is a binary file, not an XML scene; nacre reads Mitsuba 3's XML");
    EXPECT_EQ(error("a.xml", "<scene version='3.0.0'>"),
              "a.xml:1:1: <scene> is never closed; </scene> is missing");
    EXPECT_EQ(error("a.xml", "<scene version='3.0.0'/>\n<scene version='3.0.0'/>"),
              "a.xml:2:1: only one outermost element is allowed");
    EXPECT_EQ(error("a.xml", "<html version='3.0.0'/>"),
              "a.xml:1:1: a scene file holds one <scene>, not <html>");
    EXPECT_EQ(error("a.xml", "<scene/>"), "a.xml:1:1: <scene> needs the attribute 'version'");
    EXPECT_EQ(error("a.xml", "<scene version='4.0.0'/>"),
              "a.xml:1:1: version 4.0.0 is not known; nacre reads 0.x to 3.x");
    EXPECT_EQ(error("a.xml", "<scene version='three'/>"),
              "a.xml:1:1: 'three' is not a version such as 3.0.0");
    EXPECT_EQ(error("a.xml", "<scene version='3.0.0' a=1/>"),
              "a.xml:1:26: an attribute is malformed; write name=\"value\"");
    EXPECT_EQ(error("a.xml", "<scene version='3.0.0'></shape></scene>"),
              "a.xml:1:1: <scene> is never closed; </scene> is missing before </shape>");
    EXPECT_EQ(error("a.xml", "<scene version='3.0.0'/></scene>"),
              "a.xml:1:25: </scene> closes nothing");
}

TEST_F(WrongFile, IncludesInACircle) {
    write("a.xml", R"(<scene version="3.0.0"><include filename="b.xml"/></scene>)");
    write("b.xml", R"(<scene version="3.0.0"><include filename="c.xml"/></scene>)");
    write("c.xml", R"(<scene version="3.0.0"><include filename="b.xml"/></scene>)");
    EXPECT_EQ(error_of([&] { load_scene(folder_ / "a.xml"); }),
              "c.xml:1:24: cyclic include: b.xml includes c.xml includes b.xml");
}

TEST_F(WrongFile, MistakesInIncludedFilesAreFoundThere) {
    write("part.xml", "<scene version=\"3.0.0\">\n\n  <bsdf type=\"difuse\"/></scene>");
    EXPECT_EQ(error("a.xml", R"(<scene version="3.0.0"><include filename="part.xml"/></scene>)"),
              "part.xml:3:3: unknown bsdf type 'difuse'; did you mean 'diffuse'?");
}

TEST_F(WrongFile, UnusedDefinitionsOfTheCommandLine) {
    const auto file = write("a.xml", R"(<scene version="3.0.0"><default name="spp" value="4"/>
        <emitter type="constant"><float name="radiance" value="$spp"/></emitter></scene>)");
    EXPECT_EQ(error_of([&] {
                  load_scene(file, {.defines = {{"ssp", "3"}}});
              }),
              "command line: -D ssp: the scene does not use '$ssp'; did you mean 'spp'?");
    EXPECT_EQ(error_of([&] {
                  load_scene(file, {.defines = {{"depth", "3"}}});
              }),
              "command line: -D depth: the scene does not use '$depth'; known are: spp");
    EXPECT_EQ(error_of([&] { load_scene(file, {.defines = {{"spp", "3"}}}); }), "no error");
}

TEST_F(WrongFile, DeepNestingDoesNotOverflow) {
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; i < 20000; ++i) text += "<bsdf type=\"twosided\">";
    for (int i = 0; i < 20000; ++i) text += "</bsdf>";
    EXPECT_EQ(error("deep.xml", text + "</scene>"),
              "deep.xml:1:728: objects are nested more than 32 deep");
}

TEST_F(WrongFile, SpectrumFiles) {
    write("bad.spd", "400 1\n500 1 2\n");
    EXPECT_EQ(error("a.xml", R"(<scene version="3.0.0"><bsdf type="diffuse">
        <spectrum name="reflectance" filename="bad.spd"/></bsdf></scene>)"),
              "bad.spd:2: expected a wavelength in nm and a value");
}

}  // namespace
}  // namespace nacre
