// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/ggx_smith.h"
#include "nacre/reflectance/metallic_roughness.h"

namespace nacre {

template const Evaluator& evaluator_of<GgxSmith>();
template const Evaluator& evaluator_of<MetallicRoughness>();

}  // namespace nacre
