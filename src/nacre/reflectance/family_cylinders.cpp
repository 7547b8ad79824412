// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/poulin_fournier.h"

namespace nacre {

template const Evaluator& evaluator_of<PoulinFournier>();

}  // namespace nacre
