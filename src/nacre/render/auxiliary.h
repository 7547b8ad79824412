#pragma once
// Auxiliary images: what of a picture is free of light and nearly free of noise, for filters that
// take noise out of it (render/denoised.h, and other people's).
#include "nacre/image/image.h"
#include "nacre/math/work.h"
#include "nacre/render/film.h"
#include "nacre/render/frame_settings.h"

namespace nacre {

/// Filtered over pixels, and with variances, as the picture is.
struct AuxiliaryImages {
    /// What a camera ray sees first, as a colour without light, linear RGB in [0, 1]. Of a surface
    /// the share of light that it sends on towards the viewer (an estimate from a few directions).
    /// Mirrors and clear boundaries show what is seen in and through them. A scattering medium
    /// shows its single-scattering albedo, by the share of the ray that it takes away. Lights and
    /// the background are their radiance, at most 1.
    Film albedo;
    /// Shading normal in world space, turned to the viewer, of what `albedo` shows; a translucent
    /// object's is that of its surface. Zero where only background or a medium without surface is
    /// seen.
    Film normal;
    /// Distance from the camera along the ray to the first surface of whatever kind, in all three
    /// channels. Only samples that meet one count: the mean is 0 where none does.
    Film depth;
    int samples = 0;  ///< a pixel
};

/// By camera rays alone, whatever renders the picture: each sees the same place through the same
/// part of the lens as the picture's sample of that number, of which the first 16 are taken. The
/// same bits for any number of threads. Throws InputError as RenderJob does, Stopped if `work` says
/// so.
AuxiliaryImages render_auxiliary(const Scene& scene, const FrameSettings& frame,
                                 const Work& work = {});

/// Adds channels albedo.R, .G, .B, normal.X, .Y, .Z and depth.Z to a picture of the same frame and,
/// under "variance." and these names, the variances of one sample; metadata
/// nacre.auxiliary_samples, their number.
void add_auxiliary_channels(Image& picture, const AuxiliaryImages& auxiliary);

}  // namespace nacre
