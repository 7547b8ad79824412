#pragma once
// What surfaces of random heights share: sums of waves that fit the period, and their slopes.
#include <functional>
#include <vector>

#include "nacre/math/random.h"

namespace nacre {

/// Heights at n x n points of a period, row after row: for each pair of wave numbers (a, b) up to
/// `most` along x and y a cosine and a sine wave of independent normal size, with the standard
/// deviation `amplitude(a, b)`. That of (a, b) and of (-a, -b) is one wave; (0, 0) is left out.
std::vector<double> sum_of_waves(int n, int most,
                                 const std::function<double(int a, int b)>& amplitude,
                                 Random& random);

/// sqrt(2) times the root mean square slope of triangles between neighbours along one axis.
double slope_of(const std::vector<double>& heights, int columns, int rows, double step, bool along);

/// Scales the heights of n x n points so that the slopes that they happen to have become `alpha`:
/// that of Beckmann's distribution, or the root mean square slope by steepest ascent.
void scale_to_slope(std::vector<double>& heights, int n, double step, double alpha);

}  // namespace nacre
