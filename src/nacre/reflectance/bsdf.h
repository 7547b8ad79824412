#pragma once
// What a surface does to light at one point, for the four wavelengths of a path: prepared once,
// then asked as often as the path needs it.
//
// Directions are unit vectors in the local shading frame (z along the shading normal, on the
// outside of the surface) and point away from the surface: wi to the light, where the path goes;
// wo to the viewer, where it came from. They are always given in this order, (wi, wo).
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "nacre/math/lanes.h"
#include "nacre/math/vec.h"

namespace nacre {

struct BsdfSample {
    Vec3f wi;
    Spectral weight;  ///< f |cos| / pdf; for delta components the power that they carry over their
                      ///< probability
    float pdf = 0.f;  ///< per solid angle, of choosing wi by any smooth component; discrete
                      ///< probability if `delta`
    float eta = 1.f;  ///< index on the side of wi over index on the side of wo (1 unless refracted)
    bool delta = false;
    bool null = false;  ///< went straight through (wi = -wo): the surface was not there for this
                        ///< path
    bool single_wavelength = false;  ///< wi holds for lane 0 only: the other lanes of the path end
                                     ///< here
};

/// The answer of `Bsdf::eval_pdf`.
struct BsdfValue {
    Spectral f;  ///< as `Bsdf::eval`
    float pdf;   ///< as `Bsdf::pdf`
};

/// Lives in a `BsdfScratch` or with its material, and is never deleted by itself.
class Bsdf {
  public:
    /// BSDF times |cos theta_i|, sr^-1, without delta components. Radiance is transported:
    /// refraction scales by 1/eta^2.
    virtual Spectral eval(const Vec3f& wi, const Vec3f& wo) const = 0;
    /// Solid-angle density with which `sample` draws wi through its smooth components, all of them
    /// together.
    virtual float pdf(const Vec3f& wi, const Vec3f& wo) const = 0;
    /// Both, where both are wanted.
    virtual BsdfValue eval_pdf(const Vec3f& wi, const Vec3f& wo) const {
        return {eval(wi, wo), pdf(wi, wo)};
    }
    /// Draws wi; empty when the path is absorbed. `u1` chooses the component, `u2` the direction.
    virtual std::optional<BsdfSample> sample(const Vec3f& wo, float u1, Vec2f u2) const = 0;
    /// Share of light that passes straight through towards -wo: what a shadow ray keeps. Zero
    /// unless the material has_null.
    virtual Spectral null_transmission(const Vec3f& wo) const {
        (void)wo;
        return Spectral(0.f);
    }

  protected:
    ~Bsdf() = default;
};

/// A BSDF all of whose components are delta.
class DeltaBsdf : public Bsdf {
  public:
    Spectral eval(const Vec3f&, const Vec3f&) const final { return Spectral(0.f); }
    float pdf(const Vec3f&, const Vec3f&) const final { return 0.f; }
    BsdfValue eval_pdf(const Vec3f&, const Vec3f&) const final { return {Spectral(0.f), 0.f}; }

  protected:
    ~DeltaBsdf() = default;
};

/// The place of the BSDFs of a path's vertex: meant to be a local variable. What is made in it is
/// valid until it is reset or dies; nothing is destroyed, so it must need no destruction. Nested
/// materials take a few hundred bytes a level; what does not fit the stack goes to the heap.
class BsdfScratch {
  public:
    static constexpr std::size_t inline_size = 4096;

    BsdfScratch() {}  // NOLINT: the bytes stay as they are
    BsdfScratch(const BsdfScratch&) = delete;
    BsdfScratch& operator=(const BsdfScratch&) = delete;

    template <class T, class... Args>
    T& make(Args&&... args) {
        static_assert(std::is_trivially_destructible_v<T>);
        return *new (allocate(sizeof(T), alignof(T))) T(std::forward<Args>(args)...);
    }
    void reset() {
        heap_.clear();
        next_ = inline_;
        left_ = inline_size;
    }

  private:
    void* allocate(std::size_t size, std::size_t alignment) {
        void* at = next_;
        if (!std::align(alignment, size, at, left_)) {
            left_ = size + alignment > inline_size ? size + alignment : inline_size;
            heap_.push_back(std::make_unique_for_overwrite<std::byte[]>(left_));
            at = heap_.back().get();
            std::align(alignment, size, at, left_);
        }
        next_ = static_cast<std::byte*>(at) + size;
        left_ -= size;
        return at;
    }

    alignas(32) std::byte inline_[inline_size];
    std::byte* next_ = inline_;
    std::size_t left_ = inline_size;
    std::vector<std::unique_ptr<std::byte[]>> heap_;
};

}  // namespace nacre
