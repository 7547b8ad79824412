// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/he_torrance.h"

namespace nacre {

template const Evaluator& evaluator_of<HeTorrance>();

}  // namespace nacre
