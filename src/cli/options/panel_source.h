// The options for what the panel shows: an image file, elemental images of a model, or a test pattern. Floor 5.
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

/// The option --panel-image.
class PanelImageOption {
  public:
    explicit PanelImageOption(Command command)
        : image_(command.option("--panel-image", "FILE", "Picture that the panel shows: .png .exr .npy of its size")) {}
    bool given() const { return image_.given(); }
    /// Throws InputError if it is given without a name.
    void check() const;
    const std::string& path() const { return image_.text(); }
    /// Warns if the image is marked as that of an interrupted run, or if it was made for another display; returns whether it is so
    /// marked. Throws InputError.
    bool warn(const Display&) const;
    struct Read {
        Texels texels;
        bool incomplete;  // marked as that of an interrupted run
    };
    /// Reads the image, with the same warnings and one about light above white. Throws InputError.
    Read read(const Display&, Job&) const;

  private:
    Option image_;
};

/// The option --model, which replaces the description's model and objects.
class ModelOption {
  public:
    explicit ModelOption(Command command)
        : model_(command.option("--model", "FILE",
                                "Mesh file to show (any format Assimp reads), or built-in:spheres; default: the description's "
                                "content.model or its objects, or the spheres if it has none")) {}
    bool given() const { return model_.given(); }
    /// Replaces the display's model and objects by the option's file, if it is given. The files of both are remembered as inputs,
    /// which no output may replace. Throws InputError if the option is given without a name.
    void apply(Display&) const;
    const std::string& path() const { return model_.text(); }

  private:
    Option model_;
};

/// Reads the display's model or objects and places them; warns about what was dropped or repaired. Throws InputError.
ContentScene load_scene(const Display&, const Geometry&);

/// Adds the option --pattern alone.
Option pattern_name(Command);
/// Throws InputError if the option --pattern has a name that is not known.
void check_pattern(const Option&);

/// The option --pattern and those that belong to it.
class PatternOption {
  public:
    explicit PatternOption(Command command) : command_(command) {}
    bool given() const { return pattern_.given(); }
    /// Returns the values of the options. Throws InputError with all faults.
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
