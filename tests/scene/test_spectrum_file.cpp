// Spectra in files of their own, written by any system.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "nacre/math/error.h"
#include "nacre/scene/xml_values.h"

namespace nacre {
namespace {

class SpectrumFile : public testing::Test {
  protected:
    ~SpectrumFile() override { std::filesystem::remove(path_); }

    ColorValue read(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_spectrum_file(path_);
    }
    std::string error(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& e) {
            return std::string(e.what()).substr(path_.parent_path().string().size() + 1);
        }
        return "accepted";
    }

    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / "nacre_test_spectrum_file.spd";
};

TEST_F(SpectrumFile, LinesOfAnySystem) {
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const std::string mark : {"", "\xef\xbb\xbf"}) {
            const ColorValue c = read(mark + "400 +0.25 # C:\\" + end + "# b" + end + end +
                                      "500,\t.5" + end + "600 1e-999" + end);
            EXPECT_EQ(c.nm, (std::vector<float>{400, 500, 600}));
            EXPECT_EQ(c.values, (std::vector<float>{0.25f, 0.5f, 0}));
        }
}

TEST_F(SpectrumFile, WrongOnes) {
    for (const char* word :
         {"1.2.3", "1e", "nan", "-nan(ind)", "1.#IND", "inf", "1e999", "0x1", "1 2", ""})
        EXPECT_EQ(error(std::string("400 1\r500 ") + word + "\r"),
                  "nacre_test_spectrum_file.spd:2: expected a wavelength in nm and a value")
            << word;
    EXPECT_EQ(
        error(std::string("\xff\xfe"
                          "4\0",
                          4)),
        "nacre_test_spectrum_file.spd: is text in UTF-16, which is not read; save it as UTF-8 "
        "or ASCII");
}

}  // namespace
}  // namespace nacre
