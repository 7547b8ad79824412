#include "nacre/illumination/models.h"

#include <stdexcept>

#include "nacre/illumination/all_models.h"
#include "nacre/math/lanes_math.h"

namespace nacre::illumination {

namespace {

constexpr std::size_t count = std::tuple_size_v<AllModels<float>>;
using Indices = std::make_index_sequence<count>;

/// Calls f with a null pointer to the struct of the model's number.
template <class D, class P, class F, std::size_t... I>
void dispatch(int number, F&& f, std::index_sequence<I...>) {
    (void)((int(I) + 1 == number &&
            (f(static_cast<std::tuple_element_t<I, AllModels<D, P>>*>(nullptr)), true)) ||
           ...);
}

template <std::size_t... I>
Catalogue<Description> collect(std::index_sequence<I...>) {
    const Description* const all[] = {&std::tuple_element_t<I, AllModels<float>>::describe()...};
    return {"illumination model", all};
}

}  // namespace

const Catalogue<Description>& models() {
    static const Catalogue<Description> all = collect(Indices());
    return all;
}

template <class D, class P>
Product<D, P> intensity(const Description& model, const Values<D, P>& values,
                        const Lighting<D, P>& at) {
    Product<D, P> result(0.f);
    dispatch<D, P>(
        model.number,
        [&]<class Model>(Model*) {
            if constexpr (requires(Model m) { m.intensity(at); })
                result = Model::from(values).intensity(at);
            else
                throw std::logic_error("transparency models have no intensity");
        },
        Indices());
    return result;
}

template <class D, class P>
Product<D, P> transmittance(const Description& model, const Values<D, P>& values,
                            const Vec3<D>& wo) {
    Product<D, P> result(0.f);
    dispatch<D, P>(
        model.number,
        [&]<class Model>(Model*) {
            if constexpr (requires(Model m) { m.transmittance(wo); })
                result = Model::from(values).transmittance(wo);
            else
                throw std::logic_error("only transparency models have a transmittance");
        },
        Indices());
    return result;
}

template Spectral intensity(const Description&, const Values<float, Spectral>&,
                            const Lighting<float, Spectral>&);
template float intensity(const Description&, const Values<float>&, const Lighting<float>&);
template double intensity(const Description&, const Values<double>&, const Lighting<double>&);
template Spectral transmittance(const Description&, const Values<float, Spectral>&, const Vec3f&);
template float transmittance(const Description&, const Values<float>&, const Vec3f&);
template double transmittance(const Description&, const Values<double>&, const Vec3d&);

}  // namespace nacre::illumination
