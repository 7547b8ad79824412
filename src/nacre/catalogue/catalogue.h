#pragma once
// A list of things that describe themselves, and the only way to find one by its name.
#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {

/// Descriptions with a `name` and perhaps `aliases` (a list of other names, which find but are not
/// listed). Lists are made once and are looked through as a range of pointers.
template <class Description>
class Catalogue {
  public:
    using value_type = const Description*;

    /// `what` says in errors what one of them is: "reflectance model". Descriptions outlive the
    /// catalogue. Throws std::logic_error if two of them have the same name.
    Catalogue(std::string_view what, std::span<const value_type> all)
        : what_(what), all_(all.begin(), all.end()) {
        for (const value_type d : all_)
            if (look(d->name) != d)
                throw std::logic_error(std::string(what) + ": two are named " +
                                       std::string(d->name));
    }
    /// Of an array of descriptions, to which it refers.
    template <std::size_t n>
    Catalogue(std::string_view what, const Description (&list)[n])
        : Catalogue(what, pointers_to(list)) {}

    std::span<const value_type> all() const { return all_; }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }
    std::size_t size() const { return all_.size(); }
    std::string_view what() const { return what_; }

    std::vector<std::string_view> names() const {
        std::vector<std::string_view> names;
        for (const value_type d : all_) names.push_back(d->name);
        return names;
    }

    /// By name, regardless of case, blanks, dashes and underscores, or by an alias as it is written
    /// (-13 is not 13); null if there is none.
    const Description* look(std::string_view name) const {
        for (const value_type d : all_)
            if (find_name(name, {d->name}) == 0) return d;
        if constexpr (requires(const Description& d) { d.aliases; })
            for (const value_type d : all_)
                if (std::find(d->aliases.begin(), d->aliases.end(), name) != d->aliases.end())
                    return d;
        return nullptr;
    }
    /// The same; throws InputError "unknown <what> 'x'; did you mean 'y'?" if there is none.
    const Description& find(std::string_view name) const {
        if (const Description* d = look(name)) return *d;
        throw InputError(unknown_name(what_, name, names()));
    }

  private:
    static std::vector<value_type> pointers_to(std::span<const Description> list) {
        std::vector<value_type> pointers;
        for (const Description& d : list) pointers.push_back(&d);
        return pointers;
    }

    std::string_view what_;
    std::vector<value_type> all_;
};

}  // namespace nacre
