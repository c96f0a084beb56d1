// What the panel shows: an image file, elemental images of a model, or a test pattern. Floor 5.
#pragma once
#include "base/job.h"
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "content/content.h"
#include "display/display.h"
#include "image/texels.h"

#include <memory>
#include <string>

namespace lfdsim::cli {

/// --panel-image.
class PanelImageOption {
  public:
    explicit PanelImageOption(Command command);
    bool given() const { return option_.count() > 0; }
    /// Throws InputError if it is given without a name.
    void check() const;
    const std::string& path() const { return path_; }
    /// Says on standard error if the image is marked as that of an interrupted run, and so returns true, or if it was made for
    /// another display. Throws InputError.
    bool warn(const Display&) const;
    struct Read {
        Texels texels;
        bool incomplete;
    };
    /// Warns, too. Throws InputError.
    Read read(const Display&, Job&) const;

  private:
    std::string path_;
    Option option_;
};

/// --model, which stands in for content.model and objects.
class ModelOption {
  public:
    explicit ModelOption(Command command);
    bool given() const { return option_.count() > 0; }
    /// Puts the option's file, if it is given, into the display in place of what that shows; no output may replace either. Throws
    /// InputError if it is given without a name.
    void apply(Display&) const;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
    Option option_;
};

/// The display's model, or its objects, in place; says on standard error what was dropped or repaired. Throws InputError.
ContentScene load_scene(const Display&, const Geometry&);

/// --pattern and the options that belong to it.
class PatternOption {
  public:
    explicit PatternOption(Command command);
    bool given() const { return option_.count() > 0; }
    /// Reads the values strictly. Throws InputError for those that are wrong.
    PatternOptions read() const;
    const std::string& name() const { return name_; }

  private:
    std::string name_, cell_, view_, edge_, depth_;
    Option option_;
};

}  // namespace lfdsim::cli
