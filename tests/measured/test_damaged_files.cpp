// Files that are no measured reflectance, or damaged: each is refused with what was expected and
// found.
#include <unistd.h>

#include <fstream>

#include "tests/measured/made_files.h"

namespace nacre {
namespace {

using test::MadeKlems;
using test::MadeRgl;
using test::MadeTensor;

struct Damage {
    std::string bytes, message;
};

void expect_refused(const std::vector<Damage>& cases) {
    for (const Damage& c : cases) EXPECT_EQ(test::refusal(c.bytes), "x.data" + c.message);
}

/// A file of two samples over two wavelengths.
std::string cornell(const std::string& rows, const std::string& head = "2\n400 500\n") {
    return "# num wls\n" + head + rows;
}
const std::string alta_head = "#DIM 3 1\n#PARAM_IN RUSIN_TH_TD_PD\n#PARAM_OUT INV_STERADIAN\n";
const std::string astm_head = "ASTM E 1392\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n";
const std::string csv_head = "theta_i,phi_i,theta_o,phi_o,r,g,b\n";

template <class F>
std::string tensor(F&& change) {
    MadeTensor t = MadeRgl().file();
    change(t);
    return t.bytes();
}

template <class F>
std::string klems(F&& change) {
    MadeKlems k;
    std::string numbers;
    for (int i = 0; i < 25; ++i) numbers += fmt::format("{},\n", i);
    k.blocks = {{"Reflection Front", numbers}};
    change(k);
    return k.text();
}

}  // namespace

TEST(DamagedFiles, WhatIsNoMeasuredReflectance) {
    const std::string known =
        ": holds no measured reflectance that can be read (MERL, RGL, Klems XML, Cornell, ALTA, "
        "ASTM E1392, CSV): ";
    using namespace std::string_literals;
    expect_refused({
        {"", known + "it is empty; fetch it again"},
        {" \n\t\n", known + "it holds nothing but blanks"},
        {std::string(100, '\0'),
         known + "it begins with nothing but zeros; it is damaged: fetch it again"},
        {"<!DOCTYPE html><html><body>404</body></html>",
         known + "it is a web page, saved instead of the data; fetch the file itself"},
        {"\n<HTML>\n<head><title>felt.binary</title>",
         known + "it is a web page, saved instead of the data; fetch the file itself"},
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
         known + "it is a pointer of Git LFS, not the data; fetch them with 'git lfs pull'"},
        {"\x89PNG\r\n\x1a\n", known + "it is a picture"},
        {"\x76\x2f\x31\x01\x02"s, known + "it is a picture"},
        {"ply\nformat ascii 1.0\n", known + "it is a mesh"},
        {"v 0 0 0\nv 1 0 0\n", known + "it is a mesh"},
        {"PK\x03\x04..", known + "it is compressed; unpack it first"},
        {"\x1f\x8b\x08", known + "it is compressed; unpack it first"},
        {"<?xml version=\"1.0\"?>\n<scene version=\"3.0.0\">", known + "it is a scene"},
        {"<?xml version=\"1.0\"?>\n<gbXML>", known + "it is XML of another kind"},
        {"{\"a\": 1}", known + "it is JSON"},
        {"\xff\xfet\0h\0"s, known + "it is text in UTF-16; save it as UTF-8"},
        {"dear diary\n", known + "it is text of another kind"},
        {"\x01\x02\x03\x04\x05\x06", known + "it is binary of another kind, or damaged"},
        {"tensor_fil", known + "it is text of another kind"},
    });
}

TEST(DamagedFiles, TensorFiles) {
    const std::string good = MadeRgl().file().bytes();
    EXPECT_EQ(test::refusal(good), "no error");
    expect_refused({
        {good.substr(0, 12),
         ": breaks off within the header of the tensor file; it is incomplete: fetch it again"},
        {good.substr(0, 30),
         ": breaks off within the description of field 1 of 9; it is incomplete: fetch it again"},
        {good.substr(0, 40),
         ": breaks off within the description of field 'description'; it is incomplete: fetch it "
         "again"},
        {good.substr(0, good.size() - 1),
         fmt::format(": field 'jacobian' has 1 bytes from byte {} on, but the file has {}; it is "
                     "incomplete: fetch it again",
                     good.size() - 1, good.size() - 1)},
        {tensor([](auto& t) { t.major = 2; }),
         ": is a tensor file of version 2.0; only 1.0 can be read"},
        {tensor([](auto& t) { t.count = 1000000; }),
         ": breaks off within the description of field 10 of 1000000; it is incomplete: fetch it "
         "again"},
        {tensor([](auto& t) { t["ndf"].type = 99; }),
         ": field 'ndf' holds numbers of the unknown kind 99; known are 1 (uint8) to 11 "
         "(float64)"},
        {tensor([](auto& t) { t["rgb"].offset = ~0ull; }),
         fmt::format(": field 'rgb' has 720 bytes from byte 18446744073709551615 on, but the file "
                     "has {}; it is incomplete: fetch it again",
                     good.size())},
        {tensor([](auto& t) {
             t["vndf"].shape = {1ull << 40, 1ull << 40, 4, 4};
         }),
         ": field 'vndf' claims 1099511627776 x 1099511627776 x 4 x 4 numbers, which no file can "
         "hold; it is damaged: fetch it again"},
        {tensor([](auto& t) {
             t["vndf"].shape = {1, 3, 1000000, 1000000};
         }),
         fmt::format(": field 'vndf' has 12000000000000 bytes from byte {} on, but the file has "
                     "{}; it is incomplete: fetch it again",
                     good.size() - 720 - 240 - 420 - 1, good.size())},
        {tensor([](auto& t) { t.fields.push_back(t.fields[1]); }),
         ": has two fields 'phi_i'; it is damaged: fetch it again"},
        {tensor([](auto& t) { t.remove("sigma"); }),
         ": has no field 'sigma': it is a tensor file, but no BRDF of the RGL database, or "
         "damaged"},
        {tensor([](auto& t) { t.remove("rgb"); }),
         ": has no field 'rgb': it is a tensor file, but no BRDF of the RGL database, or damaged"},
        {tensor([](auto& t) {
             t["sigma"].type = 11;
             t["sigma"].shape = {5};
         }),
         ": field 'sigma' holds float64, not float32"},
        {tensor([](auto& t) {
             t["theta_i"].shape = {1, 3};
         }),
         ": field 'theta_i' has 2 dimensions (1 x 3), not 1"},
        {tensor([](auto& t) { t["theta_i"].shape = {0}; }), ": field 'theta_i' is empty"},
        {tensor([](auto& t) { t.set("rgb", 7, std::nanf("")); }),
         ": field 'rgb': number 8 of 180 is nan; it is damaged: fetch it again"},
        {tensor([](auto& t) { t.set("vndf", 3, -1.f); }),
         ": field 'vndf' holds -1, but must not be negative; it is damaged: fetch it again"},
        {tensor([](auto& t) { t.set("theta_i", 2, 0.5f); }),
         ": field 'theta_i' must ascend, but 0.5 follows 0.7"},
        {tensor([](auto& t) { t.set("theta_i", 2, 80.f); }),
         ": field 'theta_i': 80 lies outside 0 to 1.5708"},
        {tensor([](auto& t) {
             t["vndf"].shape = {3, 1, 5, 7};
         }),
         ": field 'vndf' is 3 x 1 x 5 x 7, which does not go with 1 phi_i and 3 theta_i"},
        {tensor([](auto& t) {
             t["ndf"].shape = {10, 1};
         }),
         ": field 'ndf' is 10 x 1: each slice needs 2 to 65536 nodes along both axes"},
        {tensor([](auto& t) {
             t["luminance"].shape = {1, 3, 5, 4};
         }),
         ": fields 'rgb' (1 x 3 x 3 x 4 x 5) and 'luminance' (1 x 3 x 5 x 4) have different "
         "nodes"},
        {tensor([](auto& t) {
             t["rgb"].shape = {1, 3, 1, 12, 5};
         }),
         ": field 'rgb' is 1 x 3 x 1 x 12 x 5: the third number must be 3"},
        {tensor([](auto& t) {
             for (auto& [name, f] : t.fields)
                 if (name == "rgb") name = "spectra";
             t.add("wavelengths", {2}, {400.f, 500.f});
         }),
         ": field 'spectra' is 1 x 3 x 3 x 4 x 5, but there are 2 wavelengths"},
        {tensor([](auto& t) { t.remove("jacobian"); }),
         ": has no field 'jacobian': it is a tensor file, but no BRDF of the RGL database, or "
         "damaged"},
    });
}

TEST(DamagedFiles, Cornell) {
    EXPECT_EQ(test::refusal(cornell("0.1 0 0.2 3.1 1 2\n")), "no error");
    expect_refused({
        {"# num wls\n", ": holds no numbers; it is incomplete: fetch it again"},
        {cornell("", "2.5\n"),
         ", line 2: the number of wavelengths must be a whole number from 1 to 1024, not 2.5"},
        {cornell("", "99999\n"),
         ", line 2: the number of wavelengths must be a whole number from 1 to 1024, not 99999"},
        {cornell("", "3\n400 500\n"),
         ": breaks off after 2 of 3 wavelengths; it is incomplete: fetch it again"},
        {cornell("", "3\n400 500\n600 700\n"),
         ", line 4: 4 wavelengths stand where 3 were announced"},
        {cornell("", "2\n500 400\n"),
         ", line 3: wavelengths must be positive and ascend, but 400 follows 500"},
        {cornell(""), ": holds no samples; it is incomplete: fetch it again"},
        {cornell("0.1 0 0.2 3.1 1\n"),
         ", line 4: has 5 numbers, but a sample has 4 angles and 2 values"},
        {cornell("0.1 0 0.2 3.1 1 2\n0.1 0 0.2\n"),
         ", line 5: has 3 numbers, but a sample has 4 angles and 2 values"},
        {cornell("0.1 0 0.2 3.1 1 two\n"), ", line 4: 'two' is no number"},
        {cornell("0,1 0 0,2 3,1 1 2\n"), ", line 4: '0,1' is no number; write decimal points"},
        {cornell("0.1 0 0.2 3.1 1 inf\n"), ", line 4: 'inf' is no finite number"},
        {cornell("50 0 0.2 3.1 1 2\n"),
         ", line 4: theta_i = 50 lies outside 0 to 1.5708 radians; is it in degrees?"},
        {cornell("0.1 0 nan 3.1 1 2\n"),
         ", line 4: theta_s = nan lies outside 0 to 1.5708 radians"},
        {cornell("0.1 0 0.2 180 1 2\n"),
         ", line 4: phi_s = 180 lies outside two turns; is it in degrees?"},
        {cornell("0.1 0 0.2 3.1 nan 2\n"), ": has 1 samples, but none of them is a measurement"},
        {cornell("<html><body>Not found</body>"), ", line 4: '<html><body>Not' is no number"},
    });
}

TEST(DamagedFiles, Alta) {
    EXPECT_EQ(test::refusal(alta_head + "0.1 0.2 0.3 1\n"), "no error");
    const auto head = [](const char* dim, const char* in, const char* out) {
        return fmt::format("#DIM {}\n#PARAM_IN {}\n#PARAM_OUT {}\n0.1 0.2 0.3 1\n", dim, in, out);
    };
    expect_refused({
        {alta_head, ": holds no samples; it is incomplete: fetch it again"},
        {"#PARAM_IN COS_TH\n0.5 1\n",
         ": has no line '#DIM', which says how many coordinates and values there are"},
        {"#DIM 1 1\n0.5 1\n", ": has no line '#PARAM_IN', which says what its coordinates are"},
        {head("3 x", "COS_TH", "INV_STERADIAN"),
         ", line 1: #DIM must be a whole number from 1 to 1024, not 'x'"},
        {head("-3 1", "COS_TH", "INV_STERADIAN"),
         ", line 1: #DIM must be a whole number from 1 to 6, not '-3'"},
        {head("3 1", "STARK_3D", "INV_STERADIAN"),
         ": #PARAM_IN 'STARK_3D' cannot be read; known are COS_TH, COS_TH_TD, RUSIN_TH_TD, "
         "ISOTROPIC_TV_PROJ_DPHI, RUSIN_TH_TD_PD, ISOTROPIC_TV_TL_DPHI, "
         "ISOTROPIC_TL_TV_PROJ_DPHI, RUSIN_TH_PH_TD_PD, SPHERICAL_TL_PL_TV_PV, CARTESIAN"},
        {head("3 1", "COS_TH", "INV_STERADIAN"),
         ", line 1: #PARAM_IN COS_TH has 1 coordinates, but #DIM says 3"},
        {head("3 2", "RUSIN_TH_TD_PD", "RGB_COLOR"),
         ", line 1: #PARAM_OUT RGB_COLOR does not go with 2 values"},
        {head("3 2", "RUSIN_TH_TD_PD", "UNKNOWN_OUTPUT"),
         ", line 1: 2 values without #PARAM_OUT: it is not known what they are"},
        {head("3 1", "RUSIN_TH_TD_PD", "ENERGY"),
         ": #PARAM_OUT 'ENERGY' cannot be read; known are INV_STERADIAN, "
         "INV_STERADIAN_COSINE_FACTOR, RGB_COLOR and XYZ_COLOR"},
        {alta_head + "#FORMAT binary\n",
         ", line 4: binary files of ALTA are not read; save it as text"},
        {alta_head + "0.1 0.2 0.3\n",
         ", line 4: has 3 numbers, but a sample has 3 coordinates, 1 values"},
        {alta_head + "#VS 2\n0.1 0.2 0.3 1 1\n",
         ", line 5: has 5 numbers, but a sample has 3 coordinates, 1 values and 2 bounds"},
        {alta_head + "0.1 0.2 0.3 one\n", ", line 4: 'one' is no number"},
        {alta_head + "20 0.2 0.3 1\n",
         ", line 4: theta_h = 20 lies outside 0 to 1.5708 radians; is it in degrees?"},
        {"#DIM 1 1\n#PARAM_IN COS_TH\n1.5 1\n",
         ", line 3: the cosine of theta_h is 1.5, which no angle has"},
        {"#DIM 6 1\n#PARAM_IN CARTESIAN\n0 0 2 0 0 1 1\n",
         ", line 3: the view vector has the length 2, not 1"},
    });
}

TEST(DamagedFiles, AstmAndCsv) {
    EXPECT_EQ(test::refusal(astm_head + "0.1,0,0.2,3,1,1,1\n"), "no error");
    EXPECT_EQ(test::refusal(csv_head + "10,0,20,180,1,1,1\n"), "no error");
    expect_refused({
        {"NUM_POINTS 5\n",
         ": has no line VARS, which names the columns; it is incomplete: fetch it again"},
        {"NUM_POINTS many\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n",
         ", line 1: NUM_POINTS must be a whole number, not 'many'"},
        {"NUM_POINTS 3\nVARS theta_i,phi_i,theta_s,phi_s,Y\n0.1,0,0.2,3,1\n",
         ": holds 1 samples, but its header announces 3; it is incomplete: fetch it again"},
        {"VARS theta_i,theta_s,phi_s,R,G,B\n",
         ", line 1: VARS does not name phi_i; it must name theta_i, phi_i, theta_s and phi_s"},
        {"VARS theta_i,phi_i,theta_s,phi_s\n",
         ", line 1: names no column of values after the angles"},
        {"VARS theta_i,phi_i,theta_s,R,phi_s\n",
         ", line 1: VARS names phi_s after the values; angles come first"},
        {"VARS theta_i,phi_i,theta_s,phi_s,phi_s,R\n", ", line 1: VARS names an angle twice"},
        {"VARS theta_i,phi_i,theta_s,phi_s,R,G\n",
         ", line 1: columns of values 'R, G' are not known; write r,g,b or x,y,z or wavelengths in "
         "nm or one column of any name"},
        {astm_head + "0.1,0,0.2,3,1,1\n", ", line 3: has 6 columns, but the header names 7"},
        {astm_head + "0.1,0,0.2,3,1,,1\n", ", line 3: a number is missing between two commas"},
        {astm_head + "45,0,0.2,3,1,1,1\n",
         ", line 3: theta_i = 45 lies outside 0 to 1.5708 radians; is it in degrees?"},
        {astm_head, ": holds no samples; it is incomplete: fetch it again"},
        {"theta_i,phi_i,theta_o\n",
         ", line 1: column 4 must be 'phi_o', not ''; the names of a table are "
         "theta_i,phi_i,theta_o,phi_o and then the values"},
        {"theta_i;phi_i;theta_o;phi_o;r;g;b\n",
         ", line 1: column 1 must be 'theta_i', not 'theta_i;phi_i;theta_o;phi_o;r;g;b'; the names "
         "of a table are theta_i,phi_i,theta_o,phi_o and then the values, with commas between "
         "them"},
        {"theta_i,phi_i,theta_o,phi_o,500,400\n",
         ", line 1: wavelengths must be positive and ascend, but 400 follows 500"},
        {csv_head + "10,0,20,180,1,1\n", ", line 2: has 6 columns, but the header names 7"},
        {csv_head + "10,0,20,180,1,1,1\n10,0,20,180,1,1,a\n", ", line 3: 'a' is no number"},
        {csv_head + "95,0,20,180,1,1,1\n", ", line 2: theta_i = 95 lies outside 0 to 90 degrees"},
        {csv_head + "10,0,200,180,1,1,1\n",
         ", line 2: theta_o = 200 lies outside 0 to 180 degrees"},
        {csv_head + "10,0,20,nan,1,1,1\n", ", line 2: phi_o = nan lies outside two turns"},
        {csv_head + "10,0,20,180,nan,1,1\n", ": has 1 samples, but none of them is a measurement"},
    });
}

TEST(DamagedFiles, Klems) {
    EXPECT_EQ(test::refusal(klems([](auto&) {})), "no error");
    const std::string cut = klems([](auto&) {});
    expect_refused({
        {cut.substr(0, cut.size() / 2),
         ": the XML breaks off or is damaged (Start-end tags mismatch); fetch it again"},
        {"<?xml version=\"1.0\"?><WindowElement></WindowElement>",
         ": has no WindowElement with Optical and Layer: it holds no BSDF"},
        {klems([](auto& k) { k.structure = "TensorTree4"; }),
         ", line 7: is a tensor tree, which is not read; Radiance's bsdf2klems makes a matrix of "
         "it"},
        {klems([](auto& k) { k.structure = ""; }),
         ", line 6: IncidentDataStructure must be Columns or Rows, not ''"},
        {klems([](auto& k) { k.definition = k.ring(0, 30, 1) + k.ring(30, 80, 4); }),
         ", line 8: the angle basis 'small' does not reach 90 degrees"},
        {klems([](auto& k) { k.definition = k.ring(0, 30, 1) + k.ring(40, 90, 4); }),
         ", line 10: rings must follow each other up to 90 degrees, but 40 to 90 follows 30"},
        {klems([](auto& k) { k.definition = k.ring(0, 90, 0); }),
         ", line 9: nPhis must be a whole number from 1 to 360, not 0"},
        {klems([](auto& k) { k.definition = "<AngleBasisBlock/>"; }),
         ", line 9: nPhis of AngleBasisBlock must be a number, not ''"},
        {klems([](auto& k) { k.column_basis = "LBNL/Klems Fulll"; }),
         ", line 14: ColumnAngleBasis 'LBNL/Klems Fulll' is not defined; known are 'small', "
         "'LBNL/Klems Full', 'LBNL/Klems Half', 'LBNL/Klems Quarter'"},
        {klems([](auto& k) { k.row_basis = "LBNL/Klems Quarter"; }),
         ", line 17: 'Reflection Front' has 25 numbers, but 41 x 5 patches need 205"},
        {klems([](auto& k) { k.blocks[0].first = "Reflection Side"; }),
         ", line 14: WavelengthDataDirection 'Reflection Side' is not known; known are "
         "Transmission and Reflection, each Front and Back"},
        {klems([](auto& k) { k.blocks.push_back(k.blocks[0]); }),
         ", line 45: 'Reflection Front' stands twice"},
        {klems([](auto& k) { k.blocks.clear(); }), ": has no WavelengthData: it holds no BSDF"},
        {klems([](auto& k) { k.blocks[0].second.replace(0, 1, "x"); }),
         ", line 17: 'x' is no number"},
        {klems([](auto& k) { k.blocks[0].second.replace(0, 1, "nan"); }),
         ", line 17: 'Reflection Front': number 1 of 25 is not a number"},
    });
}

TEST(DamagedFiles, FilesOnDisk) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_damaged_{}", getpid());
    std::filesystem::create_directories(folder);
    const auto message = [](const std::filesystem::path& path, const ReadLimits& limits = {}) {
        try {
            read_measured(path, limits);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message(folder / "none.bsdf"),
              (folder / "none.bsdf").string() + ": cannot be read; check the name");
    EXPECT_EQ(message(folder), folder.string() + ": cannot be read; check the name");
    // Endings do not matter.
    const std::filesystem::path file = folder / "paint.png";
    std::ofstream(file, std::ios::binary) << MadeRgl().file().bytes();
    EXPECT_EQ(message(file), "no error");
    EXPECT_EQ(recognise_measured(file)->name, "rgl");
    EXPECT_EQ(recognise_measured(folder / "none"), nullptr);
    EXPECT_EQ(message(file, {.memory = 4000}),
              file.string() +
                  ": has 0.0 MB, and reading it as RGL takes up to 0.0 MB of memory, but only 0.0 "
                  "MB are free; free some, or read it on a larger machine");
    // A file of a terabyte, of which the disk holds one block.
    {
        std::ofstream sparse(folder / "huge.bsdf", std::ios::binary);
        sparse << MadeRgl().file().bytes();
    }
    std::filesystem::resize_file(folder / "huge.bsdf", 1000000000000);
    EXPECT_EQ(message(folder / "huge.bsdf", {.memory = 16000000000}),
              (folder / "huge.bsdf").string() +
                  ": has 1000000.0 MB, and reading it as RGL takes up to 4000000.0 MB of memory, "
                  "but only 16000.0 MB are free; free some, or read it on a larger machine");
    EXPECT_GT(available_memory(), 1000000u);
    std::filesystem::remove_all(folder);
}

}  // namespace nacre
