#pragma once
// The pages of docs/models/, made from what the models say of themselves.
#include <filesystem>

#include "apps/cli/verb.h"

namespace nacre::cli {

enum class DocsPart { text, all };

/// Writes into the folder, which is made if it is not there, for every reflectance model NAME.md,
/// beside them README.md (a table of all) and sphere.xml (the scene of the pictures); and unless
/// only the text is asked for, NAME-lobe.svg and NAME-sphere.png, with the model's default
/// parameters. The text depends on nothing but the descriptions. Throws RunError if a file cannot
/// be written or gnuplot is absent.
int write_model_docs(const std::filesystem::path& folder, DocsPart part,
                     const Invocation& invocation);

}  // namespace nacre::cli
