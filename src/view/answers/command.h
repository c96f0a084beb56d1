// The command that gives the same picture without a browser. Floor 5.
#pragma once
#include "view/answers/library.h"
#include "view/server/messages.h"

#include <string>

namespace lfdsim::view {

/// Returns the command for a shell in the folder where the program was started: `lfdsim render ... -o view.png`, which makes the
/// final picture, bit for bit; left.png and right.png for two eyes. Where the elemental images are held, they are made first
/// (eia.png). Throws InputError for files that do not exist.
std::string command(const Library&, const Wanted&);

}  // namespace lfdsim::view
