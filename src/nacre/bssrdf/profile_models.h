#pragma once
// The descriptions that profile.cpp lists, each with the adapter of its model: one function a
// model.
#include "nacre/bssrdf/profile.h"

namespace nacre {

const ProfileDescription& dipole_profile();
const ProfileDescription& better_dipole_profile();
const ProfileDescription& quantised_diffusion_profile();
const ProfileDescription& photon_beam_profile();
const ProfileDescription& normalised_profile();
const ProfileDescription& gaussian_sum_profile();
const ProfileDescription& multipole_profile();

}  // namespace nacre
