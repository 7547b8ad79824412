#pragma once
// What all techniques in real time say alike of themselves.
#include "nacre/technique/technique.h"

namespace nacre {

/// Completes a description that has a `realtime`: its `prepare` renders through frames on the
/// device, one a sample, all of the scene may change, and its parameters are followed by those of
/// lights (frame_options_of reads them).
TechniqueDescription realtime_description(TechniqueDescription description);

struct FrameOptions;
/// What the options of such a technique say of frames.
FrameOptions frame_options_of(const ParameterValues& options);

}  // namespace nacre
