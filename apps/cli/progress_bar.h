#pragma once
// How far a render is, on standard error: a bar on a terminal, a line every tenth otherwise.
#include <string>

#include "nacre/render/render.h"

namespace nacre::cli {

class ProgressBar {
  public:
    explicit ProgressBar(bool quiet);
    /// Ends the bar's line.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(const RenderProgress& progress);

  private:
    bool quiet_, terminal_;
    bool drawn_ = false;
    int next_percent_ = 0;  ///< the first line says that the render has begun
};

/// "1:02:03", "2:03", "3.4 s".
std::string format_seconds(double seconds);

}  // namespace nacre::cli
