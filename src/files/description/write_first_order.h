// Writes a first design, of lenses in rows and columns or of a lenticular sheet, as a description. Floor 2.
#pragma once
#include "checks/first_order.h"
#include "checks/lenticular.h"

#include <string>

namespace lfdsim {

/// Returns TOML that reads back as the design's display, with the formula and the value of every choice as comments (docs/model.md,
/// "First designs"). `made_by`: the command line, written in the first comment.
std::string write_first_order(const FirstOrder&, const std::string& made_by);
std::string write_lenticular(const Lenticular&, const std::string& made_by);

}  // namespace lfdsim
