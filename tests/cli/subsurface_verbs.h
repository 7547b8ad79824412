#pragma once
// What the tests of `nacre profile` and `nacre slab` share.
#include "tests/cli/command_line.h"

namespace nacre::test {

class SubsurfaceVerbs : public CommandLine {
  protected:
    /// The columns of a CSV of numbers by their names.
    std::map<std::string, std::vector<double>> columns(const std::string& file) const {
        std::ifstream in(folder_ / file);
        std::string line, cell;
        std::vector<std::string> names;
        std::getline(in, line);
        for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
        std::map<std::string, std::vector<double>> r;
        while (std::getline(in, line)) {
            std::istringstream cells(line);
            for (const std::string& name : names) {
                std::getline(cells, cell, ',');
                r[name].push_back(std::stod(cell));
            }
        }
        return r;
    }
    void expect_refused(std::initializer_list<std::pair<const char*, const char*>> cases) const {
        const std::vector<std::string> before = written();
        for (const auto& [arguments, message] : cases) {
            const Outcome r = nacre(arguments);
            EXPECT_EQ(r.code, 2) << arguments;
            EXPECT_EQ(r.err, fmt::format("nacre: {}\n", message)) << arguments;
            EXPECT_EQ(r.out, "") << arguments;
            EXPECT_EQ(written(), before) << arguments;
        }
    }
    static bool has_gnuplot() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }
};

}  // namespace nacre::test
