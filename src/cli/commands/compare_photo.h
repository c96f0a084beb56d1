// lfdsim compare with --corners: compares a photograph of a real display with a simulated view. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "image/formats/encoding.h"

#include <string>

namespace lfdsim::cli {

/// The options that `compare` has for photographs alone.
class PhotoOptions {
  public:
    explicit PhotoOptions(Command command) : command_(command) {}

    bool given() const { return corners_.given(); }

    /// Compares the files, prints the figures and writes the pictures that are asked for. `encoding`, of the photograph, and
    /// `crop`, of the view, are the command's other options. Throws InputError for wrong options and unreadable files.
    void run(const std::string& view, const std::string& photograph, const Option& encoding, const Option& crop, bool json) const;

  private:
    static constexpr const char* four = "X,Y X,Y X,Y X,Y";

    Command command_;
    List corners_ = command_
                        .list("--corners", four,
                              "B is a photograph of the display: the outer corners of its lens array there (of the lit part, where "
                              "the array extends beyond the panel), in pixels from the upper left corner of the picture as viewers "
                              "show it; top left, top right, bottom right, bottom left of the screen as its viewer sees it")
                        .expected(1, 4);
    List view_corners_ =
        command_
            .list("--view-corners", four,
                  "The same corners in A; default: from the display description stored in a picture made by lfdsim")
            .expected(1, 4);
    Flag fit_corners_ =
        command_.flag("--fit-corners", "Move each corner by up to 5 pixels of the photograph for the best agreement");
    Flag fit_blur_ = command_.flag("--fit-blur", "Blur A by the Gaussian that makes it most similar to the photograph");
    Option overlay_ =
        command_.option("-o,--overlay", "FILE", "Picture to write: both side by side, as a checkerboard and half of each");
    Option difference_ =
        command_.option("--difference", "FILE", "Picture to write: where the photograph is brighter (red) or darker (blue)");
};

/// The encoding of the option --encoding.
inline Encoding encoding_of(const Option& option) { return option.word() == "srgb" ? Encoding::srgb : Encoding::linear; }

}  // namespace lfdsim::cli
