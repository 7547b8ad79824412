#pragma once
// What is known of a picture's noise, made fit for filters.
#include <array>

#include "nacre/denoise/planes.h"

namespace nacre::denoising {

/// A pixel that is far brighter in one half than in the other and than all around it owes that to
/// one sample or two: it becomes as bright as the brightest of these, and its variance that around
/// it.
/// Filters would smear it into a blot. What is as bright in both halves stays.
void remove_fireflies(std::array<Planes, 2>& halves, Planes& variance);

/// The variance of the mean, brought to the size that the halves' difference has around each pixel:
/// that of the samples is too large for points of low discrepancy (Rousselle, Knaus, Zwicker 2012,
/// section 5).
Planes calibrated_variance(const std::array<Planes, 2>& halves, const Planes& variance,
                           const std::array<float, 2>& share);

}  // namespace nacre::denoising
