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
    explicit PanelImageOption(Command command)
        : image_(command.option("--panel-image", "FILE", "Picture that the panel shows: .png .exr .npy of its size")) {}
    bool given() const { return image_.given(); }
    /// Throws InputError if it is given without a name.
    void check() const;
    const std::string& path() const { return image_.text(); }
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
    Option image_;
};

/// --model, which stands in for content.model and objects.
class ModelOption {
  public:
    explicit ModelOption(Command command)
        : model_(command.option("--model", "FILE",
                                "Mesh file to show (any format Assimp reads), or built-in:spheres; default: the description's "
                                "content.model or its objects, or the spheres if it has none")) {}
    bool given() const { return model_.given(); }
    /// Puts the option's file, if it is given, into the display in place of what that shows; no output may replace either. Throws
    /// InputError if it is given without a name.
    void apply(Display&) const;
    const std::string& path() const { return model_.text(); }

  private:
    Option model_;
};

/// The display's model, or its objects, in place; says on standard error what was dropped or repaired. Throws InputError.
ContentScene load_scene(const Display&, const Geometry&);

/// --pattern alone, which check_pattern() reads: throws InputError for a name that is not known.
Option pattern_name(Command);
void check_pattern(const Option&);

/// --pattern and the options that belong to it.
class PatternOption {
  public:
    explicit PatternOption(Command command) : command_(command) {}
    bool given() const { return pattern_.given(); }
    /// Reads the values strictly. Throws InputError for those that are wrong.
    PatternOptions read() const;
    const std::string& name() const { return pattern_.text(); }

  private:
    Command command_;
    Option pattern_ = pattern_name(command_);
    Option cell_ = command_.option("--cell-pixels", "N", "Checkerboard: side of a square");
    Option view_ =
        command_.option("--view", "X,Y", "View: position of the white view, -0.5 .. 0.5 of the elemental image from its centre");
    Option edge_ = command_.option("--edge-deg", "A", "Edge: slant");
    Option depth_ = command_.option("--edge-depth-mm", "Z", "Edge: depth in front of the lenses' vertex plane");
};

}  // namespace lfdsim::cli
