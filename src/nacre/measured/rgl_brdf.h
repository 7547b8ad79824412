#pragma once
// Measured BRDFs in the adaptive parameterisation: looked up, sampled and with a density, in single
// precision and without allocation.
//
//   J. Dupuy, W. Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and
//   Rendering, ACM Transactions on Graphics 37(6). Half vectors h are mapped to the unit square by
//   x = sqrt(2 theta_h / pi), y = phi_h / 2 pi + 1/2 (isotropic: phi_h - phi_i). The distribution of
//   visible normals of a microfacet surface that was fitted to the retro-reflection warps the square
//   so that what is stored varies slowly:
//     f cos(theta_o) = spectra(warp^-1(h)) D(h) / (4 sigma(wi)).
//   The factor behind is the density with which uniform points of the square lead to wo, so the
//   mean of `spectra` over the square is the albedo.
//
// A pair of directions has a `given` one, in whose table one looks, and the `other` one, which is
// sampled. In the measurement light comes from the given one; the value includes the cosine of the
// other.
#include <optional>
#include <span>
#include <vector>

#include "nacre/math/vec.h"
#include "nacre/measured/marginal_warp.h"

namespace nacre {

/// The tables of a file.
struct RglTables {
    ParameterGrid incidence;  ///< phi_i and theta_i, radians
    BilinearTable ndf, sigma;
    MarginalWarp vndf, luminance;
    int channels = 3;
    int width = 0, height = 0;   ///< nodes of `spectra` and the luminance
    std::vector<float> spectra;  ///< by incidence, row, column, channel, the last fastest
    bool jacobian = true;        ///< false: spectra are f cos(theta_o) themselves

    bool isotropic() const { return incidence.slow().size() <= 2; }
};

class RglBrdf {
  public:
    explicit RglBrdf(RglTables tables);

    /// f times the cosine of `other`, sr^-1, one a channel; may be negative where the data are.
    /// False, and nothing in `out`, unless both are above the horizon.
    bool eval(const Vec3f& given, const Vec3f& other, std::span<float> out) const;

    struct Sample {
        Vec3f direction;
        float pdf;  ///< solid angle
    };
    /// Draws the other direction; nothing where it would be below the horizon.
    std::optional<Sample> sample(const Vec3f& given, float u, float v) const;
    /// The same with what `eval` says there, in `out` unless that is empty.
    std::optional<Sample> sample(const Vec3f& given, float u, float v, std::span<float> out) const;
    float pdf(const Vec3f& given, const Vec3f& other) const;
    /// What `pdf` says, and `eval` in `out` unless that is empty, by one look; nothing where `eval`
    /// is false.
    std::optional<float> eval_pdf(const Vec3f& given, const Vec3f& other,
                                  std::span<float> out) const;

    /// `eval` of many pairs in `out`, a row of channels each, 0 where it is false, and `pdf`; either
    /// may be empty. As single calls but for rounding, and several times as quick.
    void eval_many(std::span<const Vec3f> given, std::span<const Vec3f> other, std::span<float> out,
                   std::span<float> pdf) const;
    /// `sample` of many; 0, 0, 0 where it gives nothing.
    void sample_many(std::span<const Vec3f> given, std::span<const Vec2f> u,
                     std::span<Vec3f> other) const;

    const RglTables& tables() const { return t_; }
    /// What a node (x, y) of a slice's spectra stands for; `given` is the slice's own direction.
    struct Node {
        Vec3f direction;  ///< the other one; may be below the horizon
        float factor;     ///< spectra times this are f cos
    };
    Node node(const Vec3f& given, std::size_t slice, int x, int y) const;

  private:
    struct Given;
    struct Half;
    struct Packs;
    Given turned(const Vec3f& given) const;
    Given place(const Vec3f& given) const;
    Half place(const Vec3f& given, const Vec3f& other, Given& g) const;
    Vec3f direction_of(const Given& g, float x, float y, Vec3f& half) const;
    float factor(const Given& g, float x, float y) const;
    void look_up(const SliceMix& mix, float u, float v, float scale, std::span<float> out) const;

    RglTables t_;
    bool isotropic_;
    int reduction_ = 1;              ///< how many times the measured phi_i go into the circle
    float sign_x_ = 1, sign_y_ = 1;  ///< in which quarter or half they lie
};

}  // namespace nacre
