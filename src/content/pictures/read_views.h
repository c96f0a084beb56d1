// Grids of views from files. Floor 2.
#pragma once
#include "base/job.h"
#include "content/pictures/light_field.h"
#include "content/pictures/view_order.h"
#include "files/views/views_source.h"

#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// Views that were read, placed in front of a display.
struct ReadViews {
    LightField field;
    OrderDoubt doubt;
    int width, height;               // of a view, pixels
    std::vector<std::string> notes;  // what was assumed, or left out
};

/// Reads the pictures and depth maps of a source and places them in front of a display. Nothing if the job was cancelled. Throws
/// InputError, which names the file, if one is unreadable, of another size than the first, or a quilt that its name does not
/// divide; if there is not enough memory, before pictures are read; and as placed() does.
std::optional<ReadViews> read_views(const ViewsSource&, const ViewsWish&, const ViewsPlace&, Job&);

}  // namespace lfdsim
