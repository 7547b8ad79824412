// The evaluators of this family's models.
#include "nacre/reflectance/blinn_phong.h"
#include "nacre/reflectance/evaluator_of.h"
#include "nacre/reflectance/phong.h"

namespace nacre {

template const Evaluator& evaluator_of<Phong>();
template const Evaluator& evaluator_of<BlinnPhong>();

}  // namespace nacre
