#pragma once
// What all techniques in real time say alike of themselves.
#include "nacre/technique/technique.h"

namespace nacre {

/// Completes a description that has a `realtime`: its `prepare` renders through frames on the
/// device, one a sample, and all of the scene may change.
TechniqueDescription realtime_description(TechniqueDescription description);

}  // namespace nacre
