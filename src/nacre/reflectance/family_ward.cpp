// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/ward.h"

namespace nacre {

template const Evaluator& evaluator_of<Ward>();

}  // namespace nacre
