#pragma once
// How noisy a picture is, by what its film knows.
#include "nacre/render/film.h"

namespace nacre {

/// Relative RMS error of the picture, estimated: the root of
///
///   mean of v / (m^2 + epsilon M^2),    epsilon = 0.01,
///
/// over the values (R, G, B of each pixel) that have any noise, where m is a value, v the variance
/// of that mean, and M the mean of all values of the picture. A value is told to 1 % of itself or,
/// where it is below a tenth of the mean, of that tenth. It is the root of the relMSE of metrics.h
/// (Rousselle, Knaus and Zwicker 2011) of a picture whose mean is 1; so that lamps of twice the
/// power make the same noise, epsilon is taken relative to it, and a still background does not
/// make an object look clean.
///
/// Unbiased in the square for independent samples; too large for stratified and Sobol' points, whose
/// error is below what the variance of a sample says. Light that no sample has met yet is not in
/// it. Infinite if a pixel was given fewer than 2 samples.
double film_noise(const Film& film);

}  // namespace nacre
