// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/ggx_smith.h"

namespace nacre {

template const Evaluator& evaluator_of<GgxSmith>();

}  // namespace nacre
