// The evaluators of this family's models.
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/schlick.h"
#include "nacre/reflectance/schlick_ct.h"

namespace nacre {

template const Evaluator& evaluator_of<Schlick>();
template const Evaluator& evaluator_of<SchlickCt>();

}  // namespace nacre
