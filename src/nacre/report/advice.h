#pragma once
// Which technique for which error: what the numbers of a comparison say, in sentences.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nacre/compare/experiment.h"

namespace nacre {

/// How the error of a frame falls with time: error^2 = floor^2 + noise^2 frame / t. Errors are
/// relative (0.05 is 5 %), those of `Verdict::frame`; times in seconds.
struct ErrorLaw {
    std::string name;  ///< "two_pass (error=0.2)"
    double precompute = 0, frame = 0;
    double least_frame = 0;       ///< of one sample a pixel: no picture takes less
    double time_spread = 0;       ///< (most - least) / median of the repeats' frames
    double noise = 0;             ///< of a picture that takes `frame`
    double floor = 0, sigma = 0;  ///< what stays however long it runs, and its standard error
};

enum class Reach {
    certain,  ///< floor and two of its standard errors are below the error
    unsure,   ///< the error lies within two standard errors of the floor
    never,    ///< the floor is above it by two standard errors
};
struct TimeToReach {
    Reach reach = Reach::never;
    double seconds = 0;  ///< if certain: precomputation and frame, with floor + 2 sigma
};
TimeToReach time_to_reach(const ErrorLaw& law, double error);

/// The errors that sentences speak of, and the page at first.
constexpr double advised_errors[] = {0.2, 0.1, 0.05, 0.02, 0.01};
constexpr double first_error = 0.05;

/// A sentence or more: who is fastest at which of the errors (which fall), who cannot be told from
/// it by time (10 % or the spread of the repeats), and what nobody reaches.
std::vector<std::string> advise(std::span<const ErrorLaw> laws,
                                std::span<const double> errors = advised_errors);

/// Of a row with numbers. The floor of the reference's own technique is 0 by construction.
std::optional<ErrorLaw> error_law(const ExperimentRow& row, const std::string& reference);

/// For each row the index of the first row before it whose picture has the same bits.
std::vector<std::optional<std::size_t>> identical_rows(const std::vector<ExperimentRow>& rows);

/// The sentences of an experiment: of rows with numbers that are not identical to another, with a
/// word on those that failed or were not run.
std::vector<std::string> advise(const Experiment& e, const std::string& reference);

/// "two_pass (error=0.2)" of "two_pass" and "error=0.2".
std::string name_with_setting(const std::string& name, const std::string& setting);
/// "0.41 s", "12 s", "3.5 min".
std::string time_in_words(double seconds);

}  // namespace nacre
