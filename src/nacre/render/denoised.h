#pragma once
// A rendered picture without its noise, from what film and scene know.
#include "nacre/denoise/denoise.h"
#include "nacre/render/auxiliary.h"
#include "nacre/render/render.h"

namespace nacre {

/// What the filter is told of a result: its halves, its variances and the auxiliary images of the
/// same frame. Throws InputError if it was rendered without halves (RenderOptions).
DenoiseInput denoise_input(const RenderResult& result, const AuxiliaryImages& auxiliary);

/// Channels R, G, B: the result's film, denoised (denoise/denoise.h). Throws as `denoise_input`, and
/// Stopped if `work` says so.
Image denoised(const RenderResult& result, const AuxiliaryImages& auxiliary, const Work& work = {});

/// Puts a denoised picture in the place of the one it was made from (render_image): the channels of
/// that, R, G, B or Y, are then called noisy.R, ..., and their variances variance.noisy.R, ....
/// Metadata: nacre.denoised, how.
void put_denoised(Image& picture, const Image& clean, const std::string& how);

}  // namespace nacre
