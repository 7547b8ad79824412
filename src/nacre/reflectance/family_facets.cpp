// The evaluators of this family's models.
#include "nacre/reflectance/blinn_torrance_sparrow.h"
#include "nacre/reflectance/cook_torrance.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/torrance_sparrow.h"

namespace nacre {

template const Evaluator& evaluator_of<TorranceSparrow>();
template const Evaluator& evaluator_of<BlinnTorranceSparrow>();
template const Evaluator& evaluator_of<CookTorrance>();

}  // namespace nacre
