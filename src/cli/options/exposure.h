// The option --exposure: a factor of the picture's light before it is written. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "engine/render.h"

#include <optional>
#include <string>

namespace lfdsim::cli {

class ExposureOption {
  public:
    explicit ExposureOption(Command command)
        : exposure_(
              command.option("--exposure", "E|auto",
                             "Multiplies the picture's light by E; auto: scales the mean of a white panel over the screen to 1")) {}

    /// Throws InputError for anything but a positive number or "auto".
    void check() const;

    /// Returns the factor; nothing without the option. "auto" renders the whole frame with a white panel, and makes its mean over
    /// the screen 1. Throws InputError where that frame shows no light of the screen.
    std::optional<double> factor(const Display&, const Geometry&, RenderOptions, Job&) const;

    /// Multiplies a picture's light and its errors by a factor.
    static void apply(double factor, Rendering&);

  private:
    Option exposure_;
};

}  // namespace lfdsim::cli
