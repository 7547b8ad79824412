// The evaluators of this family's models.
#include "nacre/reflectance/eon.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/lambert.h"
#include "nacre/reflectance/oren_nayar.h"

namespace nacre {

template const Evaluator& evaluator_of<Lambert>();
template const Evaluator& evaluator_of<OrenNayar>();
template const Evaluator& evaluator_of<Eon>();

}  // namespace nacre
