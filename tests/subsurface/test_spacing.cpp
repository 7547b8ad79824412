// How many points a spacing makes, and what is advised where they are too many.
#include <gtest/gtest.h>

#include "nacre/geometry/surface_points.h"
#include "nacre/math/error.h"
#include "nacre/subsurface/two_pass.h"

namespace nacre {
namespace {

std::string message(double spacing, const char* points, double area, double free_path) {
    TwoPassOptions options;
    options.spacing = spacing;
    options.points = points == std::string("random")      ? PointMethod::random
                     : points == std::string("repulsion") ? PointMethod::repulsion
                                                          : PointMethod::elimination;
    try {
        check_spacing(options, area, free_path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Behind "set spacing to at least ".
double advised(const std::string& text) {
    const std::string before = "set spacing to at least ";
    const std::size_t at = text.find(before);
    return at == text.npos ? 0. : std::stod(text.substr(at + before.size()));
}

// In free paths of half a unit, a square of 1e4 of them: 2 / sqrt(3) 1e8 points, one a free path.
constexpr double area = 2.5e7, free_path = 0.5;

TEST(Spacing, AdviceIsInFreePathsAndIsTakenAtTheFirstTry) {
    EXPECT_EQ(message(1., "elimination", area, free_path),
              "spacing = 1 transport mean free paths takes 1.15e+08 surface points; with points = "
              "elimination the limit is 12500000: set spacing to at least 3.04, or to 9.62, which "
              "takes a tenth of the time and memory");
    EXPECT_EQ(message(2., "elimination", area, free_path),
              "spacing = 2 transport mean free paths takes 2.89e+07 surface points; with points = "
              "elimination the limit is 12500000: set spacing to at least 3.04, or to 9.62, which "
              "takes a tenth of the time and memory; or set points to repulsion");
    EXPECT_EQ(message(2., "repulsion", area, free_path), "");
    for (const char* points : {"elimination", "repulsion", "random"}) {
        const double least = advised(message(1., points, area, free_path));
        ASSERT_GT(least, 1.) << points;
        EXPECT_EQ(message(least, points, area, free_path), "") << points;
        EXPECT_NE(message(0.99 * least, points, area, free_path), "") << points;
        // The limits of the points themselves, too.
        const std::size_t count = point_count(area, least * free_path);
        EXPECT_LE(count * (std::string(points) == "elimination" ? 4 : 1), kMaxSurfacePoints);
    }
}

TEST(Spacing, DoesNotDependOnTheUnitOfLength) {
    const std::string metres = message(1., "elimination", area * 1e-6, free_path * 1e-3);
    EXPECT_EQ(metres, message(1., "elimination", area, free_path));
}

TEST(Spacing, WhatNoSpacingCanDoIsSaid) {
    EXPECT_EQ(message(1., "elimination", area * 1e4, free_path),
              "spacing = 1 transport mean free paths takes 1.15e+12 surface points; with points = "
              "elimination the limit is 12500000: spacing would have to be 304, and 100 is the "
              "most: the object is too large for its medium; make it smaller by a factor of 3.05, "
              "or choose another technique");
}

}  // namespace
}  // namespace nacre
