// Spectra in files of their own, written by any system.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "nacre/math/error.h"
#include "nacre/scene/xml/values.h"

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
            const std::string text = e.what(), path = path_.string();
            return text.starts_with(path) ? "FILE" + text.substr(path.size()) : text;
        }
        return "accepted";
    }

    // Tests run side by side: each process has a file of its own.
    std::filesystem::path path_ =
        std::filesystem::path(testing::TempDir()) / fmt::format("nacre_spectrum_{}.spd", getpid());
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
                  "FILE:2: expected a wavelength in nm and a value")
            << word;
    EXPECT_EQ(error(std::string("\xff\xfe"
                                "4\0",
                                4)),
              "FILE: is text in UTF-16, which is not read; save it as UTF-8 "
              "or ASCII");
}

}  // namespace
}  // namespace nacre
