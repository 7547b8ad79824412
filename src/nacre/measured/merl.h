#pragma once
// The measured BRDFs of MERL: isotropic, tabulated over half-angle coordinates.
//
//   W. Matusik, H. Pfister, M. Brand, L. McMillan 2003, A Data-Driven Reflectance Model, ACM
//   Transactions on Graphics 22(3).
//
// A .binary file is three 32-bit whole numbers, 90 90 180, and three planes (red, green, blue) of
// 64-bit numbers, all little-endian, with phi_d running fastest, then theta_d, then theta_h. Node i
// of theta_h stands at (i/90)^2 90 degrees, so that highlights are finely sampled; those of theta_d
// and phi_d stand at whole degrees. Stored values times 1/1500, 1.15/1500 and 1.66/1500 are sr^-1;
// a negative one says that there is no measurement.
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

enum class MerlLookup {
    linear,   ///< between the eight nodes around, in index space
    nearest,  ///< the node below, as the reader that comes with the data does it
};

/// The node of a file that `nearest` takes, and where it stands in a plane.
struct MerlNode {
    int theta_h, theta_d, phi_d;
    std::size_t position;
};

class MerlBrdf {
  public:
    static constexpr int theta_h_count = 90, theta_d_count = 90, phi_d_count = 180;
    /// What stored values of red, green and blue are multiplied by.
    static constexpr double scale[3] = {1. / 1500., 1.15 / 1500., 1.66 / 1500.};

    /// BRDF in sr^-1 in linear red, green and blue; nothing below the horizon and where the file
    /// has no measurement. `linear` leaves out nodes without one and scales the others' weights up;
    /// where they hold less than half, there is nothing. Beyond the last nodes of theta_h and
    /// theta_d their values hold.
    std::optional<Vec3d> eval(const Vec3d& wi, const Vec3d& wo,
                              MerlLookup lookup = MerlLookup::linear) const;
    /// The same in single precision, linear.
    std::optional<Vec3f> eval_float(const Vec3f& wi, const Vec3f& wo) const;
    /// The same for many: a row of three in `out` and whether there is anything; else `out` stays.
    void eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                   std::span<bool> known) const;
    /// The node below the half-angle coordinates of two unit vectors that are not opposite.
    static MerlNode node_below(const Vec3d& wi, const Vec3d& wo);
    /// A node's value; nothing if not measured.
    std::optional<Vec3d> node(int theta_h, int theta_d, int phi_d) const;
    /// How many nodes have no measurement.
    std::size_t missing() const { return missing_; }

  private:
    friend MerlBrdf parse_merl(std::string_view bytes, const std::filesystem::path& path);
    /// sr^-1, and 1; all 0 where not measured, so that sums need not ask.
    std::vector<Lanes<float, 4>> values_;
    std::size_t missing_ = 0;
};

/// Reads a .binary file. Throws InputError "FILE: what is wrong; how to mend it": a file that
/// cannot be read, another header, one byte too few or too many, a value that is not finite, no
/// measurement at all.
MerlBrdf read_merl(const std::filesystem::path& path);
/// The same from memory; `path` is the name in messages.
MerlBrdf parse_merl(std::string_view bytes, const std::filesystem::path& path);

}  // namespace nacre
