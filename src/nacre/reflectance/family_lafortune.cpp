// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/lafortune.h"

namespace nacre {

template const Evaluator& evaluator_of<Lafortune>();

}  // namespace nacre
